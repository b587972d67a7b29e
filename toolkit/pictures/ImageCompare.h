// SPDX-License-Identifier: Apache-2.0
/// compareImages: how many pixels of two images are identical, and how far the others differ.
///   In      two images of one size and format: RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F, tightly packed.
///   Out     counts, and the largest difference of a component in steps of 1/255 (finer ones are rounded up, so that 0
///           means identical; NaN against anything else is 255).
///   Thread  any; no shared state.  Cost: about 2 ms per megapixel.
///   Fails   InvalidArgument if sizes, formats or byte counts do not match: checkPair().
#pragma once

#include "toolkit/pictures/Pixels.h"

namespace filament_core::tools {

struct ImageComparison {
    uint64_t pixels = 0;
    uint64_t identical = 0;     ///< all components have the same bits
    uint32_t maxDifference = 0; ///< [0, 255]
    std::optional<PixelDifference> first{};

    bool within(uint32_t tolerance) const { return maxDifference <= tolerance; }
    /// "99.9999 %": of identical pixels, rounded down, so that 100.0000 means every pixel.
    std::string percentage() const;
    /// "identical: 99.9999 % of pixels, max difference 1/255"
    std::string line() const;
};

Result<ImageComparison> compareImages(Image const& a, Image const& b);

/// An image of the differences, RGBA8: `a` dimmed to a quarter where the bits agree, from yellow (1/255) to red
/// (16/255 and more) where they do not. The images must be comparable (compareImages succeeded).
Image differenceImage(Image const& a, Image const& b);

} // namespace filament_core::tools
