// SPDX-License-Identifier: Apache-2.0
/// packRectangles: places for rectangles in a square image, none of which overlap.
///   In      sizes in texels; each rectangle includes its border. All are multiples of `step`, a power of two.
///   Out     the corner with the smallest coordinates of each, a multiple of `step`, and the side of the image: a
///           multiple of 4 and of `step`, as small as the search finds. Nothing if no image of `most` texels a side
///           holds them.
///   Method  rectangles by descending height; each where it ends lowest on the skyline of those before (Jylanki 2010,
///           "A Thousand Ways to Pack the Bin", section 2.4). The side is found by bisection.
///   Thread  any; pure: the same places for the same sizes.  Cost: quadratic in the rectangles at worst.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filament_core::bake {

struct Packing {
    uint32_t side = 0;         ///< texels
    std::vector<uint2> places; ///< by rectangle
};

std::optional<Packing> packRectangles(std::span<const uint2> sizes, uint32_t most, uint32_t step = 1);

} // namespace filament_core::bake
