// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/DrawList.h"

#include <algorithm>
#include <bit>

namespace filament::prepare {
namespace {

constexpr size_t kGrain = 1024;
constexpr uint64_t kBlendedBit = 1ull << 63;

// Distance along the view direction; the bits of a non-negative float grow with its value.
uint32_t depthBits(double3 const& worldCenter, ViewSpace const& space) {
    const float depth = glm::dot(float3(worldCenter - space.cameraWorld), space.forward);
    return std::bit_cast<uint32_t>(std::max(depth, 0.0f));
}

uint64_t sortKey(scene::Renderables const& renderables, uint32_t i, ViewSpace const& space) {
    const uint32_t depth = depthBits(renderables.bounds.centerAt(i), space);
    scene::Drawable const& drawable = renderables.drawables[renderables.drawable[i]];
    scene::MaterialInstance const& material = *drawable.material;
    if (material.material->isBlended()) return kBlendedBit | static_cast<uint64_t>(~depth) << 31;
    const uint64_t coarseDepth = depth >> 21; // exponent and two bits of mantissa: four steps an octave
    const uint64_t geometry = (drawable.geometry.vertices.index() * 31u + drawable.geometry.firstIndex) & 0xFFFFu;
    return coarseDepth << 53 | (material.material->id & 0x3FFFull) << 39 | (material.id & 0x3FFFull) << 25 |
           geometry << 9;
}

Visibility visibilityOf(scene::Renderables const& renderables, size_t i, ViewSpace const& space) {
    if (renderables.flags[i] & (scene::kNoIndices | scene::kCollapsed)) return Visibility::NothingToDraw;
    if (!(renderables.flags[i] & scene::kCulled)) return Visibility::Visible;
    const float3 center(renderables.bounds.centerAt(i) - space.cameraWorld);
    return intersects(space.frustum, center, renderables.bounds.halfExtentAt(i)) ? Visibility::Visible
                                                                                 : Visibility::OutOfView;
}

bool sameDraw(scene::Renderables const& renderables, uint32_t a, uint32_t b) {
    return renderables.drawable[a] == renderables.drawable[b] &&
           (renderables.flags[a] & scene::kMirrored) == (renderables.flags[b] & scene::kMirrored);
}

uint64_t trianglesOf(scene::Geometry const& geometry) { return geometry.indexCount / 3; }

} // namespace

std::span<const Visibility> cullRenderables(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                            ViewSpace const& space) {
    std::span<Visibility> visibility = arena.array<Visibility>(renderables.count());
    jobs::parallelFor(jobs, visibility.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) visibility[i] = visibilityOf(renderables, i, space);
    });
    return visibility;
}

std::span<const SortItem> sortVisible(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                      std::span<const Visibility> visibility, ViewSpace const& space,
                                      PacketCounts& counts) {
    counts.renderables = static_cast<uint32_t>(visibility.size());
    std::span<SortItem> all = arena.array<SortItem>(visibility.size());
    uint32_t count = 0;
    for (uint32_t i = 0; i < visibility.size(); ++i) {
        counts.outOfView += visibility[i] == Visibility::OutOfView;
        counts.nothingToDraw += visibility[i] == Visibility::NothingToDraw;
        if (visibility[i] == Visibility::Visible) all[count++].renderable = i;
    }
    counts.visible = count;
    std::span<SortItem> items = all.first(count);
    jobs::parallelFor(jobs, items.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) items[i].key = sortKey(renderables, items[i].renderable, space);
    });
    std::sort(items.begin(), items.end(), [](SortItem const& a, SortItem const& b) {
        return a.key != b.key ? a.key < b.key : a.renderable < b.renderable;
    });
    return items;
}

std::span<const shader::ObjectData> writeObjects(jobs::JobSystem& jobs, Arena& arena,
                                                 scene::Renderables const& renderables, std::span<const SortItem> items,
                                                 ViewSpace const& space) {
    std::span<shader::ObjectData> objects = arena.array<shader::ObjectData>(items.size());
    jobs::parallelFor(jobs, items.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t at = items[i].renderable;
            scene::Placement const& placement = renderables.placement[at];
            const float3 origin(placement.translation - space.cameraWorld); // in double: the difference is small
            objects[i] = { float4(placement.rows[0], origin.x), float4(placement.rows[1], origin.y),
                           float4(placement.rows[2], origin.z), float4(placement.side, 0, 0, 0) };
        }
    });
    return objects;
}

DrawLists mergeInstances(Arena& arena, scene::Renderables const& renderables, std::span<const SortItem> items,
                         PacketCounts& counts) {
    std::span<DrawCall> draws = arena.array<DrawCall>(items.size());
    uint32_t count = 0, opaqueCount = 0;
    for (uint32_t i = 0; i < items.size(); ++i) {
        const uint32_t at = items[i].renderable;
        counts.triangles += trianglesOf(renderables.drawables[renderables.drawable[at]].geometry);
        const bool windowStarts = i % shader::kObjectsPerWindow == 0;
        const bool blended = (items[i].key & kBlendedBit) != 0;
        const bool listStarts = blended && opaqueCount == count;
        if (i > 0 && !windowStarts && !listStarts && sameDraw(renderables, items[i - 1].renderable, at)) {
            ++draws[count - 1].instanceCount;
            continue;
        }
        scene::Drawable const& drawable = renderables.drawables[renderables.drawable[at]];
        draws[count++] = { drawable.material, &drawable.geometry, i, 1,
                           (renderables.flags[at] & scene::kMirrored) != 0 };
        if (!blended) opaqueCount = count;
    }
    return { draws.first(opaqueCount), draws.subspan(opaqueCount, count - opaqueCount) };
}

} // namespace filament::prepare
