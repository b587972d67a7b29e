// SPDX-License-Identifier: Apache-2.0
/// SliceLights: the lists of the froxels of one slice.
///   Thread  any; a pure function of its input, which writes the lists of its slice only.
///   Memory  none of its own beyond the stack. Fails: never.
#pragma once

#include "filament_core/prepare/FroxelGrid.h"
#include "filament_core/prepare/LightBounds.h"

#include <cstdint>
#include <span>

namespace filament_core::prepare {

/// The slices that a light may reach.
struct SliceRange {
    uint8_t first = 0, last = 0;
};

SliceRange slicesOf(FroxelGrid const& grid, LightBounds const& light);

struct SliceInput {
    FroxelGrid grid;
    TileAxes axes;
    std::span<const LightBounds> bounds;
    std::span<const SliceRange> slices; ///< by light
    float farthest;                     ///< depth that no limited light reaches beyond
    FroxelMargins margins;
};

struct SliceLists {
    std::span<uint32_t> counts;  ///< by tile
    std::span<uint16_t> entries; ///< by tile, `room` each
    size_t room = 0;
};

/// Overwrites the lists of `slice`. Counts may exceed the room: then the list has the first lights of `order` that
/// reach the froxel. Lists ascend. No `order`: that of the lights.
void assignSlice(SliceInput const& input, uint32_t slice, std::span<const uint16_t> order, SliceLists const& lists);

} // namespace filament_core::prepare
