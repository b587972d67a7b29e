// SPDX-License-Identifier: Apache-2.0
/// Picture: linear light as floats, and how far one is from another.
///   Error   of a pixel: |test - reference| / (|reference| + 1 % of the reference's mean), lengths of RGB vectors:
///           relative, without letting the darkest pixels decide. Pixels that are black in both pictures (background)
///           do not count.
///   Thread  any; pure.
#pragma once

#include <filament/Image.h>
#include <filament/Math.h>

#include <vector>

namespace filament::accuracy {

struct Picture {
    uint32_t width = 0, height = 0;
    std::vector<float3> pixels; ///< row 0 at the top
};

/// RGBA8: sRGB codes become linear light. RGBA16F: as it is.
Picture pictureOf(Image const& image);
/// RGBA8 in sRGB codes, values above 1 clamped: to look at.
Image displayImage(Picture const& picture);
/// Each pixel the mean of `factor` x `factor` of a picture whose sides are multiples of that.
Picture boxFiltered(Picture const& picture, uint32_t factor);

/// Which pixels of two pictures of the same objects count.
enum class Edges : uint8_t {
    Count,
    Skip, ///< not those beside background: a rasteriser and a ray differ about who owns them
};

struct ErrorFigures {
    double rms = 0, max = 0; ///< relative, as above
    double flip = 0;         ///< mean FLIP, [0, 1]
};

/// Pictures of one size.
ErrorFigures compare(Picture const& reference, Picture const& test, Edges edges = Edges::Count);

} // namespace filament::accuracy
