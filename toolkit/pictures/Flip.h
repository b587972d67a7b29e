// SPDX-License-Identifier: Apache-2.0
/// flip: how different two images look when alternated, from 0 (identical) to 1, for each pixel.
///   Source  P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. Fairchild, "FLIP: A Difference
///           Evaluator for Alternating Images", HPG 2020. Constants and equation numbers below are of that paper.
///   In      two images of one size. RGBA8: sRGB codes; RGBA16F: linear light, clamped to [0, 1]. Alpha is ignored.
///   Viewing 67 pixels per degree: a 3840 pixel wide display of 0.7 m at a distance of 0.7 m.
///   Thread  any; pure.  Cost: about 0.1 s for 256 x 256.
#pragma once

#include <filament_core/Image.h>

#include <vector>

namespace filament_core::tools {

struct FlipError {
    std::vector<float> pixels; ///< row 0 at the top
    double mean = 0, p99 = 0;  ///< 99th percentile by nearest rank
};

FlipError flip(Image const& reference, Image const& test);

} // namespace filament_core::tools
