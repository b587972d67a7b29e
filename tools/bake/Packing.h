// SPDX-License-Identifier: Apache-2.0
/// packRectangles: places for rectangles in square images of one size, the pages, so that none overlap.
///   In      sizes in texels; each rectangle includes its border. All are multiples of `step`, a power of two.
///   Out     the corner with the smallest coordinates of each, a multiple of `step`, and the side of the image: a
///           multiple of 4 and of `step`, as small as the search finds. Pages lie below each other: the first row of
///           page p is p * side. Nothing if `limits.pages` of `limits.side` texels do not hold them.
///   Pages   as few as hold them. Each takes the next rectangles in their order, as many as fit: those that follow each
///           other, of one surface, lie on one page or on two that follow each other.
///   Method  rectangles by descending height; each where it ends lowest on the skyline of those before (Jylanki 2010,
///           "A Thousand Ways to Pack the Bin", section 2.4). The side is found by bisection; that of
///           several pages begins with their area and grows.
///   Thread  any; pure: the same places for the same sizes.  Cost: quadratic in the rectangles at worst.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace filament_core::bake {

struct Packing {
    uint32_t side = 0; ///< texels, of each page
    uint32_t pages = 1;
    std::vector<uint2> places; ///< by rectangle
};

struct PackingLimits {
    uint32_t side = 4096; ///< texels
    uint32_t pages = 1;
};

std::optional<Packing> packRectangles(std::span<const uint2> sizes, PackingLimits limits, uint32_t step = 1);

} // namespace filament_core::bake
