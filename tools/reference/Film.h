// SPDX-License-Identifier: Apache-2.0
/// Film: accumulates the passes and measures how much they differ.
///   Method  passes are independent estimates of the image. The mean of their means is the result; the spread of
///           their means divided by the square root of their number is its standard error (Owen 1998, "Scrambling
///           Sobol' and Niederreiter-Xing Points": randomised quasi-Monte Carlo). This holds for any arrangement of
///           samples within a pass.
///   Order   sums of floating-point numbers depend on the order of their terms. Here passes are added in pairs, pairs
///           in pairs of pairs, and so on (pairwise summation: Higham 1993, "The Accuracy of Floating Point
///           Summation"): a node holds the sum of passes [k 2^j, (k + 1) 2^j). What a range of passes adds up to is
///           therefore made of the same nodes wherever and by whomever they were added, and parts of an image merge to
///           the same bits.
///   Thread  add(): one thread per pixel, many pixels at once; the rest: one.
///   Memory  48 bytes per pixel and node: log2(passes) nodes at most, 4 for up to 16 passes.
#pragma once

#include "tools/reference/Reference.h"

#include <vector>

namespace filament_core::reference {

/// Passes [first, first + count).
struct PassRange {
    uint32_t first = 0, count = 0;
    uint32_t end() const { return first + count; }
    friend bool operator==(PassRange const&, PassRange const&) = default;
};

/// Sums of the means of one pixel in some passes.
struct PixelSums {
    double3 sum{ 0.0 }, sumOfSquares{ 0.0 };
    PixelSums operator+(PixelSums const& later) const { return { sum + later.sum, sumOfSquares + later.sumOfSquares }; }
    friend bool operator==(PixelSums const&, PixelSums const&) = default;
};

struct FilmNode {
    PassRange passes; ///< `count` is a power of two, and `first` a multiple of it
    std::vector<PixelSums> pixels;
};

/// The nodes that the sums of `passes` consist of, ascending: the fewest.
std::vector<PassRange> nodesOf(PassRange passes);

class Film {
public:
    /// `firstPass`: this film has a part of the passes of an image.
    Film(uint32_t width, uint32_t height, uint32_t firstPass = 0)
            : mWidth(width), mHeight(height), mPasses{ firstPass, 0 } {}
    /// A film that has `passes` already: its nodes are those of nodesOf(passes), with the film's pixels.
    Film(uint32_t width, uint32_t height, PassRange passes, std::vector<FilmNode> nodes);

    uint32_t width() const { return mWidth; }
    uint32_t height() const { return mHeight; }
    /// One pass: beginPass(), add() once for every pixel, finishPass().
    void beginPass();
    /// The mean of one pixel in this pass.
    void add(size_t pixel, double3 mean);
    void finishPass();
    PassRange passes() const { return mPasses; }

    /// meanLuminance and relativeError; the error is known from two passes on.
    void measure(RenderStatistics& statistics) const;
    /// Writes colours and standard errors.
    void develop(ReferenceImage& image) const;
    /// Ends the film.
    std::vector<FilmNode> takeNodes() { return std::move(mNodes); }

private:
    size_t pixelCount() const { return size_t(mWidth) * mHeight; }
    PixelSums sums(size_t pixel) const; ///< of all passes
    double3 mean(PixelSums const& pixel) const { return pixel.sum / double(mPasses.count); }
    double3 variance(PixelSums const& pixel) const; ///< of the mean

    uint32_t mWidth, mHeight;
    PassRange mPasses;
    std::vector<FilmNode> mNodes;                // of the passes done, and that of the current pass
    size_t mMerges = 0;                          // nodes that the current pass completes a larger node with
    std::vector<std::vector<PixelSums>> mSpares; // memory of merged nodes
};

} // namespace filament_core::reference
