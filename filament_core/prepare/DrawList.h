// SPDX-License-Identifier: Apache-2.0
/// From renderables to sorted draw calls, one step a function. prepareFrame calls them in this order.
#pragma once

#include "filament_core/prepare/PrepareFrame.h"
#include "filament_core/prepare/ViewConstants.h"

#include <span>

namespace filament::prepare {

/// A visible renderable with its place in the order of drawing. Equal keys keep the order of the scene.
struct SortItem {
    uint64_t key = 0;
    uint32_t renderable = 0;
};

enum class Visibility : uint8_t { Visible, OutOfView, NothingToDraw };

/// One byte a renderable; jobs write disjoint ranges.
std::span<const Visibility> cullRenderables(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                            ViewSpace const& space);

/// Opaque before blended. Opaque: coarse depth (front to back, hides work from the fragment stage), then material,
/// instance, geometry, so that equal neighbours merge. Blended: back to front, nothing else.
///   key  bit 63 blended | opaque: 53..62 depth, 39..52 material, 25..38 instance, 9..24 geometry
///                       | blended: 31..62 inverted depth
std::span<const SortItem> sortVisible(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                      std::span<const Visibility> visibility, ViewSpace const& space,
                                      PacketCounts& counts);

/// Object data in draw order, relative to the camera.
std::span<const shader::ObjectData> writeObjects(jobs::JobSystem& jobs, Arena& arena,
                                                 scene::Renderables const& renderables, std::span<const SortItem> items,
                                                 ViewSpace const& space);

struct DrawLists {
    std::span<const DrawCall> opaque, blended;
};

/// Neighbours with equal geometry, material and state become one instanced draw; draws never cross a window of
/// shader::kObjectsPerWindow objects. Blended neighbours merge too: instances draw in order.
DrawLists mergeInstances(Arena& arena, scene::Renderables const& renderables, std::span<const SortItem> items,
                         PacketCounts& counts);

} // namespace filament::prepare
