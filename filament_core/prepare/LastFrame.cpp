// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/LastFrame.h"

#include <glm/ext/matrix_transform.hpp>

namespace filament::prepare {

void LastFrame::keep(scene::SceneData const& scene, ViewInput const& view, ViewPacket const& main, bool keepsPlaces) {
    const ViewSpace space = makeViewSpace(view);
    mSeen = { space.clipFromWorld, space.cameraWorld, space.forward, main.uniforms.time };
    mScene = 0; // until all places are kept
    if (keepsPlaces) keepPlaces(scene);
}

void LastFrame::keepPlaces(scene::SceneData const& scene) {
    scene::Renderables const& renderables = scene.renderables;
    mPlacements = renderables.placement;
    mRenderables.resize(renderables.count());
    for (uint32_t i = 0; i < renderables.count(); ++i) mRenderables[i] = renderables.index.handleAt(i);
    const auto deformations = scene.deformations.all();
    mDeformed.resize(deformations.size());
    for (size_t i = 0; i < deformations.size(); ++i) {
        mDeformed[i].renderable = deformations[i].renderable;
        mDeformed[i].skin = deformations[i].skin;
        mDeformed[i].weights = deformations[i].weights;
    }
    const auto skins = scene.deformations.skins();
    mBones.resize(skins.size());
    for (size_t i = 0; i < skins.size(); ++i) mBones[i] = skins[i].bones;
    mScene = scene.serial;
}

LastView LastFrame::seenFrom(ViewSpace const& space, float4 const& time) const {
    const Seen last = mSeen.value_or(Seen{ space.clipFromWorld, space.cameraWorld, space.forward, time });
    const double3 moved = space.cameraWorld - last.cameraWorld;
    const double along = dot(double3(last.forward), moved);
    return { .clipFromWorld = float4x4(glm::translate(double4x4(last.clipFromWorld), moved)),
             .alongView = float4(last.forward, static_cast<float>(along)),
             .time = last.time,
             .isElsewhere = last.clipFromWorld != space.clipFromWorld || moved != double3(0.0) };
}

scene::Placement const* LastFrame::placement(scene::SceneData const& scene, uint32_t at) const {
    const bool isKnown = mScene == scene.serial && at < mRenderables.size() &&
                         mRenderables[at] == scene.renderables.index.handleAt(at);
    return isKnown ? &mPlacements[at] : nullptr;
}

std::optional<LastDeformation> LastFrame::deformation(scene::SceneData const& scene, uint32_t slot) const {
    if (mScene != scene.serial || slot >= mDeformed.size()) return std::nullopt;
    scene::Deformation const& now = scene.deformations.all()[slot];
    Deformed const& last = mDeformed[slot];
    if (last.renderable != now.renderable || last.skin != now.skin) return std::nullopt;
    LastDeformation found{ .weights = last.weights };
    if (now.skin) found.bones = mBones[now.skin.index()];
    if (now.skin && found.bones.size() != scene.deformations.skin(now.skin).bones.size()) return std::nullopt;
    return found;
}

} // namespace filament::prepare
