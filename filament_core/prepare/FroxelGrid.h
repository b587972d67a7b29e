// SPDX-License-Identifier: Apache-2.0
/// FroxelGrid: the cells (froxels: frustum voxels) into which a view's volume is cut, and where a point is in them.
///   Columns and rows  cut the screen into equal tiles.
///   Slices            cut the view depth exponentially: their borders are floats whose low bits are zero, so that a
///                     shift of the depth's bits names the slice, in the same way on all devices.
///   Coverage          a point with a depth beyond the grid belongs to the nearest slice; one off-screen or
///                     not in front of the camera belongs to no froxel, and the shader gives it all lights.
///   Thread  any; pure. Memory: none. Fails: never; a projection that is neither perspective nor parallel has no grid.
#pragma once

#include "filament_core/prepare/ViewConstants.h"

#include <bit>
#include <cstdint>
#include <optional>

namespace filament_core::prepare {

struct FroxelGrid {
    uint32_t columns = 0, rows = 0, slices = 0; ///< all 0: no grid
    uint32_t firstSlice = 0;                    ///< bits of the depth at which slice 0 begins, >> shift
    uint32_t shift = 0;                         ///< 23: a slice an octave of depth; 22: two, ...

    uint32_t tiles() const { return columns * rows; }
    uint32_t cells() const { return tiles() * slices; }
    /// Depth in metres at which a slice begins.
    float sliceBegin(uint32_t slice) const { return std::bit_cast<float>((firstSlice + slice) << shift); }
};

inline constexpr uint32_t kMaxSlices = 32;
/// Of a slice; a multiple of those of 16:9 images. bench/README.md compares others.
inline constexpr uint32_t kTiles = 144;

/// A grid for depths from `nearest` to `farthest` metres, > 0 and finite; nearer than farthest / 256 is one slice.
FroxelGrid makeFroxelGrid(uint2 size, float nearest, float farthest);

/// Tiles along one axis of the screen: of a point (x, depth) in view space,
/// tile = (scale * x + skew * depth + offset) / (slope * depth + constant) + tiles / 2.
struct TileAxis {
    float scale = 1, skew = 0, offset = 0;
    float slope = 1, constant = 0;
    float tiles = 1;

    /// The divisor: at least the smallest normal float, so that border points divide.
    float weight(float depth) const;
    float tileOf(float x, float depth, float weight) const {
        return (scale * x + skew * depth + offset) / weight + tiles / 2;
    }
    /// The inverse: x of the border `tile` at a depth.
    float borderOf(float tile, float depth) const {
        return ((tile - tiles / 2) * (slope * depth + constant) - skew * depth - offset) / scale;
    }
};

struct TileAxes {
    TileAxis x, y;
};

/// None for a projection whose screen coordinates mix x and y, or whose w is neither constant nor a multiple of depth
/// plus a constant.
std::optional<TileAxes> tileAxes(FroxelGrid const& grid, float4x4 const& clipFromView);

/// The froxel of a point relative to the camera, as lightsNear() in shaders/material/surface/light_list.glsl computes
/// it; none: all lights.
std::optional<uint32_t> froxelAt(shader::FrameUniforms const& frame, float3 point);

} // namespace filament_core::prepare
