// SPDX-License-Identifier: Apache-2.0
/// From visible renderables to draw calls, one function per step; prepareFrame calls them in this order, with
/// sortItems() (SortItems.h) in between.
///   Thread  jobs over ranges; anything that depends on earlier ranges is a prefix sum between two loops.
///   Memory  the arena: 16 B per visible renderable, 32 B per draw call.
#pragma once

#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "shaders/interface/ShaderInterface.h"

#include <span>

namespace filament::prepare {

/// Items that one job merges at a time: whole windows, so that every range begins a draw call.
inline constexpr size_t kMergeRange = 16 * shader::kObjectsPerWindow;

/// The visible renderables without gaps, with their keys (SortKey.h), still in the order of the scene.
std::span<SortItem> writeKeys(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                              VisibleItems const& visible, ViewKind kind);

/// The part of a sorted list that comes before the sky: what neither blends nor is late (SortKey.h).
std::span<const SortItem> beforeSky(std::span<const SortItem> sorted);

struct DrawLists {
    std::span<const DrawCall> opaque, blended; ///< before and after the sky
};

/// Neighbours of one draw become one instanced draw call; none crosses a window of shader::kObjectsPerWindow objects.
/// Blended neighbours merge too, because instances draw in order. Objects with two passes get two draw calls each.
DrawLists mergeInstances(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                         std::span<const SortItem> items, ViewCounts& counts);

} // namespace filament::prepare
