// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/PartialFilm.h"

#include "base/Assert.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace filament_core::reference {
namespace {

constexpr uint32_t kWantedPasses = 16;      // the standard error is then accurate to a fifth
constexpr uint32_t kMaxSamplesPerPass = 64; // interval of progress and error estimates

} // namespace

// A power of two samples fills the strata of Sobol's sequence; estimating an error takes at least two passes.
PassPlan planOf(ReferenceSettings const& settings) {
    const uint32_t wanted = std::bit_floor(std::max(settings.samplesPerPixel / kWantedPasses, 1u));
    const uint32_t samples = std::min(wanted, kMaxSamplesPerPass);
    return { samples, std::max((settings.samplesPerPixel + samples - 1) / samples, 2u) };
}

std::string toString(FilmRegion const& region) {
    return fmt::format("pixels {},{},{},{}, passes {} to {}", region.offset.x, region.offset.y, region.size.x,
                       region.size.y, region.passes.first, region.passes.end() - 1);
}

FilmRegion intersection(FilmRegion const& a, FilmRegion const& b) {
    const auto overlap = [](uint32_t first, uint32_t count, uint32_t otherFirst, uint32_t otherCount) {
        const uint32_t begin = std::max(first, otherFirst), end = std::min(first + count, otherFirst + otherCount);
        return std::pair(begin, end > begin ? end - begin : 0);
    };
    const auto [x, width] = overlap(a.offset.x, a.size.x, b.offset.x, b.size.x);
    const auto [y, height] = overlap(a.offset.y, a.size.y, b.offset.y, b.size.y);
    const auto [pass, passes] = overlap(a.passes.first, a.passes.count, b.passes.first, b.passes.count);
    return { { x, y }, { width, height }, { pass, passes } };
}

FilmMerger::FilmMerger(uint2 size, PassPlan const& plan) : mSize(size), mPlan(plan) {}

std::vector<PixelSums>& FilmMerger::level(uint32_t exponent) {
    if (mLevels.size() <= exponent) mLevels.resize(exponent + 1);
    mLevels[exponent].resize(size_t(mSize.x) * mSize.y);
    return mLevels[exponent];
}

// Film::add() of whole nodes: the passes before this node are complete, so its level says what larger nodes it ends.
void FilmMerger::addNode(FilmRegion const& region, FilmNode const& node) {
    const auto begin = static_cast<uint32_t>(std::countr_zero(node.passes.count));
    uint32_t end = begin;
    while (node.passes.first >> end & 1) ++end;
    for (uint32_t exponent = begin; exponent <= end; ++exponent) level(exponent);
    for (size_t i = 0; i < node.pixels.size(); ++i) {
        const size_t pixel = (region.offset.y + i / region.size.x) * mSize.x + region.offset.x + i % region.size.x;
        PixelSums total = node.pixels[i];
        for (uint32_t exponent = begin; exponent < end; ++exponent) total = mLevels[exponent][pixel] + total;
        mLevels[end][pixel] = total;
    }
}

void FilmMerger::add(PartialFilm const& part) {
    for (FilmNode const& node : part.nodes) addNode(part.region, node);
    mStatistics.rays += part.rays;
    mStatistics.lostSamples += part.lostSamples;
    mStatistics.seconds += part.seconds;
}

ReferenceImage FilmMerger::finish() {
    std::vector<FilmNode> nodes;
    for (PassRange const& passes : nodesOf({ 0, mPlan.passes }))
        nodes.push_back({ passes, std::move(level(static_cast<uint32_t>(std::countr_zero(passes.count)))) });
    mLevels.clear();
    const Film film(mSize.x, mSize.y, { 0, mPlan.passes }, std::move(nodes));
    ReferenceImage image;
    film.develop(image);
    image.statistics.samplesPerPixel = mPlan.passes * mPlan.samplesPerPass;
    image.statistics.rays = mStatistics.rays;
    image.statistics.lostSamples = mStatistics.lostSamples;
    image.statistics.seconds = mStatistics.seconds;
    return image;
}

} // namespace filament_core::reference
