// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/BlockErrors.h"

#include "base/Assert.h"

#include <cmath>

namespace filament_core::tools {
namespace {

constexpr uint32_t kBlock = 8;

/// The mean of `of(pixel)` over the block.
template <class Of>
double3 blockMean(uint32_t width, uint32_t x, uint32_t y, Of const& of) {
    double3 sum(0.0);
    for (uint32_t j = 0; j < kBlock; ++j) {
        for (uint32_t i = 0; i < kBlock; ++i) sum += of(size_t(y * kBlock + j) * width + x * kBlock + i);
    }
    return sum / double(kBlock * kBlock);
}

} // namespace

BlockErrors blockErrors(Picture const& picture, Picture const& traced, Picture const& standardError) {
    const uint32_t width = picture.width;
    FILAMENT_ASSERT(traced.width == width && standardError.width == width && traced.height == picture.height &&
                            standardError.height == picture.height,
                    "images of one size compare");
    double squares = 0, noise = 0, level = 0;
    for (uint32_t y = 0; y < picture.height / kBlock; ++y) {
        for (uint32_t x = 0; x < width / kBlock; ++x) {
            const double3 truth = blockMean(width, x, y, [&](size_t i) { return double3(traced.pixels[i]); });
            const double3 drawn = blockMean(width, x, y, [&](size_t i) { return double3(picture.pixels[i]); });
            const double3 variance = blockMean(width, x, y,
                                               [&](size_t i) {
                                                   const double3 error(standardError.pixels[i]);
                                                   return error * error;
                                               }) /
                                     double(kBlock * kBlock); // of independent pixels
            squares += glm::dot(drawn - truth, drawn - truth);
            noise += variance.x + variance.y + variance.z;
            level += glm::dot(truth, truth);
        }
    }
    return level > 0 ? BlockErrors{ std::sqrt(squares / level), std::sqrt(noise / level) } : BlockErrors{};
}

} // namespace filament_core::tools
