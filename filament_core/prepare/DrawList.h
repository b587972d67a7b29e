// SPDX-License-Identifier: Apache-2.0
/// From visible renderables to draw calls, one step a function; prepareFrame calls them in this order, with sortItems()
/// (SortItems.h) between the two.
///   Thread  jobs over ranges; what depends on the ranges before is a prefix sum between two loops.
///   Memory  the arena: 16 B a visible renderable, 32 B a draw call.
#pragma once

#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"

#include <span>

namespace filament::prepare {

/// The visible renderables without gaps, with their keys (SortKey.h), still in the order of the scene.
std::span<SortItem> writeKeys(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                              VisibleItems const& visible);

/// Of a sorted list, what does not blend.
std::span<const SortItem> withoutBlended(std::span<const SortItem> sorted);

struct DrawLists {
    std::span<const DrawCall> opaque, blended;
};

/// Neighbours of one draw become one instanced draw call; none crosses a window of shader::kObjectsPerWindow objects.
/// Blended neighbours merge too: instances draw in order. What has two passes is two draw calls an object.
DrawLists mergeInstances(jobs::JobSystem& jobs, Arena& arena, scene::Drawables const& drawables,
                         std::span<const SortItem> items, ViewCounts& counts);

} // namespace filament::prepare
