// SPDX-License-Identifier: Apache-2.0
/// Film: what the passes saw, and how far apart they were.
///   Method  passes are independent estimates of the picture: the mean of their means is the result, the spread of
///           their means over the root of their number its standard error (Owen 1998, "Scrambling Sobol' and
///           Niederreiter-Xing Points": randomised quasi-Monte Carlo). It holds for any arrangement of samples inside
///           of a pass.
///   Thread  add(): one thread a pixel, many pixels at once; the rest: one.
///   Memory  48 bytes a pixel.
#pragma once

#include "tools/reference/Reference.h"

namespace filament::reference {

class Film {
public:
    Film(uint32_t width, uint32_t height) : mWidth(width), mHeight(height), mPixels(size_t(width) * height) {}

    uint32_t width() const { return mWidth; }
    uint32_t height() const { return mHeight; }
    /// The mean of one pixel in one pass.
    void add(size_t pixel, double3 mean) {
        mPixels[pixel].sum += mean;
        mPixels[pixel].sumOfSquares += mean * mean;
    }
    void finishPass() { ++mPasses; }
    uint32_t passes() const { return mPasses; }

    /// meanLuminance and relativeError; an error is known from two passes on.
    void measure(RenderStatistics& statistics) const;
    /// Colours and standard errors.
    void develop(ReferenceImage& image) const;

private:
    struct Pixel {
        double3 sum{ 0.0 }, sumOfSquares{ 0.0 };
    };
    double3 mean(Pixel const& pixel) const { return pixel.sum / double(mPasses); }
    double3 variance(Pixel const& pixel) const; ///< of the mean

    uint32_t mWidth, mHeight, mPasses = 0;
    std::vector<Pixel> mPixels;
};

} // namespace filament::reference
