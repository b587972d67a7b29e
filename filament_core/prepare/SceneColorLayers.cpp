// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneColorLayers.h"

#include "filament_core/prepare/CoveredPixels.h"
#include "filament_core/prepare/DrawList.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::prepare {
namespace {

constexpr size_t kMostLayers = 8;

bool readsSceneColor(scene::Renderables const& renderables, SortItem const& item) {
    scene::Drawable const& drawable = renderables.drawables[drawableOf(item.draw)];
    return drawable.material->material->package.refractionMode == shader::RefractionMode::ScreenSpace;
}

/// The area of the refractive `items`.
PixelBox boxOf(scene::Renderables const& renderables, std::span<const SortItem> items, ViewSpace const& space,
               uint2 view) {
    PixelBox box{ float2(view), float2(0.0f) };
    for (SortItem const& item : items) {
        if (!readsSceneColor(renderables, item)) continue;
        box = unionOf(box, coveredBy(renderables, item.renderable, space, view));
    }
    return box;
}

/// What an instance's roughness does not exceed.
float mostRoughness(scene::MaterialInstance const& instance) {
    float roughness = 1;
    if (instance.material->roughnessBound)
        std::memcpy(&roughness, instance.parameters.data() + *instance.material->roughnessBound, sizeof(float));
    return roughness >= 0 ? roughness : roughness < 0 ? 0.0f : 1.0f; // NaN is rough
}

/// Levels that the refractive `items` read.
uint8_t levelsFor(scene::Renderables const& renderables, std::span<const SortItem> items, ViewSpace const& space,
                  uint2 view) {
    if (space.clipFromView[3].w != 0) return kMostPictureLevels; // parallel: blur grows with the distance behind
    float roughness = 0;
    for (SortItem const& item : items) {
        if (readsSceneColor(renderables, item))
            roughness = std::max(roughness, mostRoughness(*renderables.drawables[drawableOf(item.draw)].material));
    }
    const float pixelsPerTangent = 0.5f * std::abs(space.clipFromView[1].y) * static_cast<float>(view.y);
    return levelsOfRoughness(roughness, pixelsPerTangent);
}

} // namespace

std::span<const SceneColorCopy> sceneColorLayers(Arena& arena, scene::Renderables const& renderables,
                                                 std::span<const SortItem> order, std::span<const DrawCall> blended,
                                                 ViewSpace const& space, uint2 view, uint32_t mostLayers) {
    const size_t begin = itemsBefore(order, kPictureEndKey).size();
    const size_t end = itemsBefore(order, kRefractingEndKey).size();
    const auto layers = arena.array<SceneColorCopy>(
            std::clamp<size_t>(end - begin, 1, std::clamp<size_t>(mostLayers, 1, kMostLayers)));
    // The objects lie from back to front. The nearest have a copy each, since they are seen best; all the others share
    // the first copy.
    const auto firstItem = [&](size_t layer) { return layer == 0 ? begin : end - (layers.size() - layer); };
    for (size_t i = 0; i < layers.size(); ++i) {
        const size_t first = firstItem(i), next = i + 1 < layers.size() ? firstItem(i + 1) : order.size();
        const std::span<const SortItem> items = order.subspan(first, next - first);
        layers[i] = copyAround(boxOf(renderables, items, space, view), view);
        layers[i].levels = std::min(layers[i].levels, levelsFor(renderables, items, space, view));
        layers[i].firstDraw = static_cast<uint32_t>(drawsBefore(blended, first));
    }
    return layers;
}

} // namespace filament_core::prepare
