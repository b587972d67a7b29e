// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SceneData.h"

#include <cmath>
#include <utility>

namespace filament::scene {
namespace {

bool isFinite(double4x4 const& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) return false;
        }
    }
    return true;
}

// Moves the last element of a column into the gap and drops the last.
template <class T>
void closeGap(std::vector<T>& column, uint32_t gap) {
    if (gap + 1 != column.size()) column[gap] = std::move(column.back());
    column.pop_back();
}

void place(Renderables& renderables, uint32_t at, double4x4 const& worldFromObject) {
    const double4x4 world = isFinite(worldFromObject) ? worldFromObject : double4x4(0.0);
    CenteredBox const& bounds = renderables.objectBounds[at];
    renderables.worldFromObject[at] = world;
    renderables.worldCenter[at] = double3(world * double4(double3(bounds.center), 1.0));
    renderables.worldHalfExtent[at] = transformedHalfExtent(world, bounds.halfExtent);
    const bool mirrored = glm::determinant(double3x3(world)) < 0;
    uint8_t& flags = renderables.flags[at];
    flags = static_cast<uint8_t>(mirrored ? flags | kMirrored : flags & ~kMirrored);
}

} // namespace

uint32_t GeometryLayouts::intern(GeometryLayout const& layout) {
    for (uint32_t i = 0; i < mLayouts.size(); ++i) {
        if (mLayouts[i] == layout) return i;
    }
    mLayouts.push_back(layout);
    return static_cast<uint32_t>(mLayouts.size() - 1);
}

Renderable addRenderable(SceneData& scene, RenderableInput const& input) {
    FILAMENT_ASSERT(input.material, "a renderable needs a material instance");
    Renderables& renderables = scene.renderables;
    const Renderable handle = renderables.index.add();
    renderables.worldFromObject.emplace_back(1.0);
    renderables.worldCenter.emplace_back(0.0);
    renderables.worldHalfExtent.emplace_back(0.0f);
    renderables.objectBounds.push_back(boxFromMinMax(input.boundsMin, input.boundsMax));
    renderables.geometry.push_back(input.geometry);
    renderables.material.push_back(input.material);
    renderables.flags.push_back(input.culled ? kCulled : 0);
    renderables.name.push_back(input.name);
    place(renderables, renderables.count() - 1, input.worldFromObject);
    return handle;
}

void removeRenderable(SceneData& scene, Renderable renderable) {
    Renderables& renderables = scene.renderables;
    const uint32_t gap = renderables.index.remove(renderable);
    closeGap(renderables.worldFromObject, gap);
    closeGap(renderables.worldCenter, gap);
    closeGap(renderables.worldHalfExtent, gap);
    closeGap(renderables.objectBounds, gap);
    closeGap(renderables.geometry, gap);
    closeGap(renderables.material, gap);
    closeGap(renderables.flags, gap);
    closeGap(renderables.name, gap);
}

void setTransform(SceneData& scene, Renderable renderable, double4x4 const& worldFromObject) {
    place(scene.renderables, scene.renderables.index.at(renderable), worldFromObject);
}

Light addLight(SceneData& scene, LightRecord const& light) {
    FILAMENT_ASSERT(light.intensity >= 0 && std::isfinite(light.intensity), "a light's intensity is finite and >= 0");
    scene.lights.records.push_back(light);
    return scene.lights.index.add();
}

void removeLight(SceneData& scene, Light light) { closeGap(scene.lights.records, scene.lights.index.remove(light)); }

Box sceneBounds(SceneData const& scene) {
    Box box;
    Renderables const& renderables = scene.renderables;
    for (uint32_t i = 0; i < renderables.count(); ++i) {
        const double3 half(renderables.worldHalfExtent[i]);
        box.min = glm::min(box.min, renderables.worldCenter[i] - half);
        box.max = glm::max(box.max, renderables.worldCenter[i] + half);
    }
    return box;
}

} // namespace filament::scene
