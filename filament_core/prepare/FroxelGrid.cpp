// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/FroxelGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::prepare {
namespace {

constexpr float kSmallest = std::numeric_limits<float>::min();
// In front of the grid's finest part is one slice: near the camera, slices get thinner than anything that is lit.
constexpr float kDepthRatio = 256;

} // namespace

FroxelGrid makeFroxelGrid(uint2 size, float nearest, float farthest) {
    FroxelGrid grid;
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const auto along = [](float tiles) { return static_cast<uint32_t>(std::clamp(std::round(tiles), 1.0f, 64.0f)); };
    grid.columns = along(std::sqrt(static_cast<float>(kTiles) * aspect));
    grid.rows = along(std::sqrt(static_cast<float>(kTiles) / aspect));
    const auto begin = std::bit_cast<uint32_t>(std::max({ nearest, farthest / kDepthRatio, kSmallest }));
    const auto end = std::max(std::bit_cast<uint32_t>(std::max(farthest, kSmallest)), begin);
    constexpr uint32_t kFinest = 20, kOctave = 23; // eight slices an octave, and one
    grid.shift = kFinest;
    while (grid.shift < kOctave && (end >> grid.shift) - (begin >> grid.shift) >= kMaxSlices) ++grid.shift;
    grid.firstSlice = begin >> grid.shift;
    grid.slices = std::min((end >> grid.shift) - grid.firstSlice + 1, kMaxSlices);
    return grid;
}

float TileAxis::weight(float depth) const { return std::max(slope * depth + constant, kSmallest); }

std::optional<TileAxes> tileAxes(FroxelGrid const& grid, float4x4 const& m) {
    const auto w = float4(m[0][3], m[1][3], -m[2][3], m[3][3]);
    const bool mixes = m[1][0] != 0 || m[0][1] != 0 || w.x != 0 || w.y != 0;
    const bool divides = w.z >= 0 && w.w >= 0 && w.z + w.w > 0;
    if (mixes || !divides || !(std::abs(m[0][0]) > 0) || !(std::abs(m[1][1]) > 0)) return {};
    const auto axis = [&](int row, uint32_t tiles) {
        const float half = static_cast<float>(tiles) / 2;
        return TileAxis{ .scale = m[row][row] * half,
                         .skew = -m[2][row] * half,
                         .offset = m[3][row] * half,
                         .slope = w.z,
                         .constant = w.w,
                         .tiles = static_cast<float>(tiles) };
    };
    return TileAxes{ axis(0, grid.columns), axis(1, grid.rows) };
}

std::optional<uint32_t> froxelAt(shader::FrameUniforms const& frame, float3 point) {
    const float4 grid = frame.froxelGrid;
    const float4 clip = frame.clipFromWorld * float4(point, 1);
    const float depth = -(frame.viewFromWorld * float4(point, 1)).z;
    const float2 at = (float2(clip) / clip.w * 0.5f + 0.5f) * float2(grid);
    const bool isInside = clip.w > 0 && depth > 0 && at.x >= 0 && at.x < grid.x && at.y >= 0 && at.y < grid.y;
    if (!isInside) return {};
    const auto bits = static_cast<int>(std::bit_cast<uint32_t>(depth) >> static_cast<uint32_t>(frame.froxelPlaces.x));
    const int slice = std::clamp(bits - static_cast<int>(grid.w), 0, static_cast<int>(grid.z) - 1);
    const int tile = static_cast<int>(at.y) * static_cast<int>(grid.x) + static_cast<int>(at.x);
    return static_cast<uint32_t>(slice * static_cast<int>(grid.x) * static_cast<int>(grid.y) + tile);
}

} // namespace filament_core::prepare
