// SPDX-License-Identifier: Apache-2.0
/// Picture: linear light as floats, and the difference between two images.
///   Error   of a pixel: |test - reference| / (|reference| + 1 % of the reference's mean), as lengths of RGB vectors:
///           relative, but not dominated by the darkest pixels. Pixels that are black in both images (background) do
///           not count.
///   Thread  any; pure.
#pragma once

#include <filament_core/Image.h>
#include <filament_core/Math.h>

#include <vector>

namespace filament_core::tools {

struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<float3> pixels; ///< row 0 at the top
};

/// RGBA8: converts sRGB codes to linear light. RGBA16F: unchanged.
Picture pictureOf(Image const& image);
/// RGBA8 in sRGB codes, with values above 1 clamped, for viewing.
Image displayImage(Picture const& picture);
/// Each pixel is the mean of `factor` x `factor` pixels of an image whose sides are multiples of `factor`.
Picture boxFiltered(Picture const& picture, uint32_t factor);

/// Which pixels count when two images of the same objects are compared.
enum class Edges : uint8_t {
    Count,
    Skip, ///< not pixels beside background: a rasteriser and a ray disagree about them
};

struct ErrorFigures {
    double rms = 0, max = 0; ///< relative, as above
    double flip = 0;         ///< mean FLIP, [0, 1]
};

/// Both images have the same size.
ErrorFigures compare(Picture const& reference, Picture const& test, Edges edges = Edges::Count);

} // namespace filament_core::tools
