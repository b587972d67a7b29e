// SPDX-License-Identifier: Apache-2.0
/// SplatPacket: the splats that the main view of a frame sees, as quads in clip space, farthest first.
///   Made by prepareSplats() (PrepareSplats.h).   Memory: spans into the frame arena.   Thread: a plain value.
#pragma once

#include "base/math/Math.h"
#include "filament_core/prepare/SortKey.h"

#include <array>
#include <cstdint>
#include <span>

namespace filament_core::prepare {

/// A projected Gaussian: where it ends, in normalised device coordinates.
struct SplatQuad {
    float3 center{ 0.0f };           ///< z: the depth of the whole quad
    std::array<float2, 2> axes{};    ///< from the centre to three standard deviations
    std::array<uint16_t, 4> color{}; ///< half floats, encoded as the cloud's colours; and the opacity
};

/// Splats of one encoding of colours.
struct SplatList {
    std::span<const SplatQuad> quads;  ///< by SortItem::draw
    std::span<const SortItem> order{}; ///< of drawing

    size_t size() const { return order.size(); }
    bool empty() const { return order.empty(); }
};

struct SplatPacket {
    std::array<SplatList, 2> lists{}; ///< by SplatColors
    uint32_t inScene = 0;             ///< clouds

    uint32_t count() const { return static_cast<uint32_t>(lists[0].size() + lists[1].size()); }
};

} // namespace filament_core::prepare
