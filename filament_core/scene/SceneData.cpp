// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SceneData.h"

#include "filament_core/scene/SceneSkins.h"

#include <cmath>

namespace filament_core::scene {

Renderable addRenderable(SceneData& scene, RenderableInput const& input) { return add(scene.renderables, input); }

Renderable addSplats(SceneData& scene, RenderableInput const& input, std::shared_ptr<const SplatData> data) {
    // Reserved first: once the renderable is there, nothing may fail.
    scene.splats.reserve(scene.splats.size() + 1);
    const Renderable renderable = addRenderable(scene, input);
    scene.splats.push_back({ renderable, std::move(data) });
    return renderable;
}

Renderable addDeformed(SceneData& scene, RenderableInput input, Deformation deformation) {
    const Skin skin = deformation.skin;
    input.deformation = scene.deformations.add(std::move(deformation));
    input.deformedAs = scene.deformations.kindOf(input.deformation);
    const Renderable renderable = addRenderable(scene, input);
    // The renderable has the number of its deformation from the start, the deformation learns its renderable
    // afterwards: handles exist only once something was added.
    scene.deformations.bind(input.deformation, renderable);
    if (skin) scene.deformations.markStale(skin); // the next update computes its bounds
    placeDeformed(scene, input.deformation);
    return renderable;
}

void removeRenderable(SceneData& scene, Renderable renderable) {
    const uint32_t deformation = deformationAt(scene.renderables, scene.renderables.index.at(renderable));
    // The deformation was looked up before, because the last renderable takes the place of the one that is removed.
    remove(scene.renderables, renderable);
    if (deformation != kNotDeformed) scene.deformations.remove(deformation);
    std::erase_if(scene.splats, [&](SplatRecord const& record) { return record.renderable == renderable; });
    scene.atNodes.renderables.detach(renderable);
}

void setTransform(SceneData& scene, Renderable renderable, double4x4 const& worldFromObject) {
    const uint32_t at = scene.renderables.index.at(renderable);
    FILAMENT_ASSERT(!scene.atNodes.renderables.isAttached(renderable),
                    "a renderable that hangs at a node is moved by its node");
    place(scene.renderables, at, worldFromObject);
}

void setBounds(SceneData& scene, Renderable renderable, MinMax const& bounds) {
    Renderables& renderables = scene.renderables;
    const uint32_t at = renderables.index.at(renderable);
    const uint32_t deformation = deformationAt(renderables, at);
    if (deformation != kNotDeformed) {
        scene.deformations[deformation].restBounds = bounds;
        return placeDeformed(scene, deformation);
    }
    setObjectBounds(renderables, at, boxFromMinMax(bounds.min, bounds.max), false);
    const uint32_t node = scene.atNodes.renderables.nodeOf(renderable);
    const bool isAttached = node != Attachments<RenderableObject>::kNone;
    place(renderables, at, isAttached ? scene.transforms.worldAt(node) : worldFromObject(renderables, at));
}

void checkIntensity(LightRecord const& light) {
    FILAMENT_ASSERT(light.intensity >= 0 && std::isfinite(light.intensity), "a light's intensity is finite and >= 0");
}

Light addLight(SceneData& scene, LightRecord const& light) {
    checkIntensity(light);
    scene.lights.records.push_back(light);
    return scene.lights.index.add();
}

void removeLight(SceneData& scene, Light light) {
    closeGap(scene.lights.records, scene.lights.index.remove(light));
    scene.atNodes.lights.detach(light);
}

Box sceneBounds(SceneData const& scene) {
    Box box;
    for (uint32_t i = 0; i < scene.renderables.count(); ++i) box.add(scene.renderables.bounds.at(i));
    return box;
}

} // namespace filament_core::scene
