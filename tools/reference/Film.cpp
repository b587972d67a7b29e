// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Film.h"

#include "base/Assert.h"
#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::reference {

std::vector<PassRange> nodesOf(PassRange passes) {
    std::vector<PassRange> nodes;
    while (passes.count > 0) {
        const uint32_t fits = std::bit_floor(passes.count);
        const uint32_t aligned = passes.first == 0 ? fits : passes.first & (~passes.first + 1); // its lowest bit
        nodes.push_back({ passes.first, std::min(fits, aligned) });
        passes = { nodes.back().end(), passes.count - nodes.back().count };
    }
    return nodes;
}

Film::Film(uint32_t width, uint32_t height, PassRange passes, std::vector<FilmNode> nodes)
        : mWidth(width), mHeight(height), mPasses(passes), mNodes(std::move(nodes)) {
    const std::vector<PassRange> expected = nodesOf(passes);
    FILAMENT_ASSERT(std::ranges::equal(expected, mNodes, {}, {}, &FilmNode::passes), "the nodes of these passes");
    for (FilmNode const& node : mNodes) FILAMENT_ASSERT(node.pixels.size() == pixelCount(), "all pixels");
}

// The new pass is a node of one pass. Where it is the second half of a larger node whose first half is there, the
// halves are added, in place of the first; and so on with the larger node.
void Film::beginPass() {
    mMerges = 0;
    PassRange node{ mPasses.end(), 1 };
    for (size_t i = mNodes.size(); i > 0; --i) {
        PassRange const& before = mNodes[i - 1].passes;
        const bool isSecondHalf = before.count == node.count && before.first % (2 * node.count) == 0;
        if (!isSecondHalf) break;
        node = { before.first, 2 * node.count };
        ++mMerges;
    }
    if (mMerges > 0) return;
    FilmNode& added = mNodes.emplace_back(FilmNode{ node, {} });
    if (!mSpares.empty()) added.pixels = std::move(mSpares.back()), mSpares.pop_back();
    added.pixels.resize(pixelCount());
}

void Film::add(size_t pixel, double3 mean) {
    PixelSums total{ mean, mean * mean };
    for (size_t i = 0; i < mMerges; ++i) total = mNodes[mNodes.size() - 1 - i].pixels[pixel] + total;
    mNodes[mNodes.size() - std::max<size_t>(mMerges, 1)].pixels[pixel] = total;
}

void Film::finishPass() {
    ++mPasses.count;
    for (; mMerges > 1; --mMerges) {
        mSpares.push_back(std::move(mNodes.back().pixels));
        mNodes.pop_back();
    }
    PassRange& last = mNodes.back().passes;
    last.count = mPasses.end() - last.first;
}

PixelSums Film::sums(size_t pixel) const {
    PixelSums total;
    for (FilmNode const& node : mNodes) total = total + node.pixels[pixel];
    return total;
}

double3 Film::variance(PixelSums const& pixel) const {
    if (mPasses.count < 2) return double3(0.0);
    const double n = mPasses.count;
    const double3 spread = pixel.sumOfSquares - pixel.sum * pixel.sum / n;
    return glm::max(spread, 0.0) / (n * (n - 1));
}

// Assumes that the errors of the components are fully dependent, as for noise of the brightness; never underestimates
// the error.
void Film::measure(RenderStatistics& statistics) const {
    double luminance = 0, squares = 0;
    for (size_t i = 0; i < pixelCount(); ++i) {
        const PixelSums pixel = sums(i);
        luminance += shader::lib64::luminance(mean(pixel));
        const double error = shader::lib64::luminance(glm::sqrt(variance(pixel)));
        squares += error * error;
    }
    const auto count = static_cast<double>(pixelCount());
    statistics.passes = mPasses.count;
    statistics.meanLuminance = luminance / count;
    statistics.relativeError = luminance > 0 ? std::sqrt(squares / count) / statistics.meanLuminance : 0;
}

void Film::develop(ReferenceImage& image) const {
    image.width = mWidth;
    image.height = mHeight;
    image.color.reserve(pixelCount());
    image.standardError.reserve(pixelCount());
    for (size_t i = 0; i < pixelCount(); ++i) {
        const PixelSums pixel = sums(i);
        image.color.emplace_back(mean(pixel));
        image.standardError.emplace_back(glm::sqrt(variance(pixel)));
    }
    measure(image.statistics);
}

} // namespace filament_core::reference
