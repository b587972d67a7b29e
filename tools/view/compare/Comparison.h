// SPDX-License-Identifier: Apache-2.0
/// Comparison: two pictures of one frame beside each other, as pictures. compareImages() has the numbers. No window.
///   In      two images of one size and format: RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F.
///   Out     numbers; images in RGBA8.
///   Thread  any; pure.
///   Fails   InvalidArgument in one line if the two cannot be compared.
///   Cost    flipMap(): about 1.5 s per megapixel.
#pragma once

#include "toolkit/pictures/ImageCompare.h"

namespace filament_core::view {

using namespace tools; // the toolkit

/// Root mean square of the differences of red, green and blue: codes divided by the largest one, or light. 0: they look
/// the same. A component that is not a number counts as a difference of 1.
Result<double> rmsError(Image const& a, Image const& b);

/// |a - b| of red, green and blue, `amplification` > 0 times, clamped. Alpha is 1. A component that is not a number in
/// one of the two alone is 1.
Result<Image> differenceMap(Image const& a, Image const& b, float amplification = 16);

struct FlipMap {
    Image image;
    double mean = 0, p99 = 0; ///< of the error, [0, 1]
};
/// How different the two look when alternated (toolkit/pictures/Flip.h), from black over violet and orange to white.
Result<FlipMap> flipMap(Image const& reference, Image const& test);

/// The colour of an error in [0, 1]; the larger, the brighter. Not a number: white.
std::array<uint8_t, 3> errorColor(float error);

// ---- split and wipe

enum class WipeAxis : uint8_t { Vertical, Horizontal }; ///< of the line between the two

/// Where one of two pictures ends: `a` is left of (or above) the line, `b` beyond it.
struct Wipe {
    WipeAxis axis = WipeAxis::Vertical;
    float position = 0.5f; ///< of the width or height; clamped to [0, 1]
};

/// The first pixel of `b`, in [0, side].
uint32_t wipePixel(Wipe const& wipe, uint2 size);

/// `a` up to the line and `b` beyond it, in their format, without a mark: pixels are those of the two.
Result<Image> wiped(Image const& a, Image const& b, Wipe const& wipe);

/// A part of a target: View::size and Viewport::offset.
struct PictureRect {
    uint2 offset{ 0 }, size{ 0 };
};

/// For two views that are drawn into one target, each with all of its picture (a split); none: that side is empty. A
/// wipe shows a part of each picture, so it is composed of finished ones: wiped().
struct SplitRects {
    std::optional<PictureRect> a, b;
};
SplitRects splitRects(Wipe const& wipe, uint2 size);

} // namespace filament_core::view
