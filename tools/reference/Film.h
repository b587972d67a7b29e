// SPDX-License-Identifier: Apache-2.0
/// Film: accumulates the passes and measures how much they differ.
///   Method  passes are independent estimates of the picture. The mean of their means is the result; the spread of
///           their means divided by the square root of their number is its standard error (Owen 1998, "Scrambling
///           Sobol' and Niederreiter-Xing Points": randomised quasi-Monte Carlo). This holds for any arrangement of
///           samples within a pass.
///   Thread  add(): one thread per pixel, many pixels at once; the rest: one.
///   Memory  48 bytes per pixel.
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

    /// meanLuminance and relativeError; the error is known from two passes on.
    void measure(RenderStatistics& statistics) const;
    /// Writes colours and standard errors.
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
