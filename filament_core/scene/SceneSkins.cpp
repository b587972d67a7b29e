// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SceneSkins.h"

#include <algorithm>
#include <cmath>

namespace filament_core::scene {
namespace {

void setBone(SkinRecord& skin, size_t i, Affine const& objectFromBind) {
    skin.bones[i] = boneFrom(objectFromBind);
    skin.mirrors[i] = isMirroring(skin.bones[i]);
}

void placeAll(SceneData& scene, SkinRecord const& skin) {
    for (const uint32_t deformation : skin.deformations) placeDeformed(scene, deformation);
}

} // namespace

Skin addSkin(SceneData& scene, SkinRecord data) {
    const size_t bones = data.joints.empty() ? data.bones.size() : data.joints.size();
    FILAMENT_ASSERT(bones > 0, "a skin has bones");
    FILAMENT_ASSERT(data.joints.empty() || data.joints.size() == data.jointFromBind.size(),
                    "a skin has one matrix for each of its joints");
    for (const Node joint : data.joints) scene.transforms.slotOf(joint); // asserts that it is there
    data.bones.resize(bones);
    data.mirrors.resize(bones);
    const Node node = data.node;
    const Skin skin = scene.deformations.addSkin(std::move(data));
    if (node) scene.atNodes.skins.attach(skin, scene.transforms.slotOf(node));
    return skin;
}

void removeSkin(SceneData& scene, Skin skin) {
    scene.deformations.removeSkin(skin);
    scene.atNodes.skins.detach(skin);
}

void setBones(SceneData& scene, Skin skin, std::span<const float4x4> objectFromBind) {
    SkinRecord& data = scene.deformations.skin(skin);
    FILAMENT_ASSERT(data.joints.empty(), "the bones of a skin with joints follow those");
    FILAMENT_ASSERT(objectFromBind.size() == data.bones.size(), "a skin keeps its number of bones");
    for (size_t i = 0; i < objectFromBind.size(); ++i) setBone(data, i, affineFrom(double4x4(objectFromBind[i])));
    placeAll(scene, data);
}

void setMorphWeights(SceneData& scene, Renderable renderable, std::span<const float> weights) {
    const uint32_t slot = deformationAt(scene.renderables, scene.renderables.index.at(renderable));
    if (slot == kNotDeformed || !scene.deformations[slot].morph) return;
    std::vector<float>& own = scene.deformations[slot].weights;
    for (size_t i = 0; i < own.size(); ++i) {
        own[i] = i < weights.size() && std::isfinite(weights[i]) ? weights[i] : 0.0f;
    }
    placeDeformed(scene, slot);
}

bool hasMoved(SceneData const& scene, SkinRecord const& skin) {
    Deformations const& all = scene.deformations;
    return (skin.node && all.hasMoved(skin.node)) ||
           std::ranges::any_of(skin.joints, [&](Node joint) { return all.hasMoved(joint); });
}

void updateSkin(SceneData& scene, SkinRecord& skin) {
    skin.isStale = false;
    if (!skin.joints.empty()) {
        Transforms const& transforms = scene.transforms;
        const Affine objectFromWorld =
                skin.node ? inverse(transforms.worldAt(transforms.slotOf(skin.node))) : kIdentity;
        for (size_t i = 0; i < skin.joints.size(); ++i) {
            // A joint that was removed leaves its bone where it was.
            if (!transforms.isAlive(skin.joints[i])) continue;
            const Affine objectFromJoint = compose(objectFromWorld, transforms.worldAt(skin.joints[i].index()));
            setBone(skin, i, compose(objectFromJoint, skin.jointFromBind[i]));
        }
    }
    placeAll(scene, skin);
}

void placeDeformed(SceneData& scene, uint32_t slot) {
    Deformation const& deformation = scene.deformations[slot];
    SkinRecord const* const skin = deformation.skin ? &scene.deformations.skin(deformation.skin) : nullptr;
    Renderables& renderables = scene.renderables;
    const uint32_t at = renderables.index.at(deformation.renderable);
    // Before place(), which carries the bounds into the world and compares the sides of bones and node.
    setObjectBounds(renderables, at, deformedBounds(deformation, skin), skin && bonesMirror(deformation, *skin));
    const uint32_t node = scene.atNodes.renderables.nodeOf(deformation.renderable);
    const bool isAttached = node != Attachments<RenderableObject>::kNone;
    place(renderables, at, isAttached ? scene.transforms.worldAt(node) : worldFromObject(renderables, at));
}

} // namespace filament_core::scene
