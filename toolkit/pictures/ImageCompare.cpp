// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/ImageCompare.h"

#include "base/Assert.h"
#include "base/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::tools {
namespace {

uint32_t componentDifference8(std::byte a, std::byte b) {
    const int difference = std::to_integer<int>(a) - std::to_integer<int>(b);
    return static_cast<uint32_t>(std::abs(difference));
}

uint32_t componentDifference16(uint16_t a, uint16_t b) {
    if (a == b) return 0;
    const float difference = std::abs(floatFromHalf(a) - floatFromHalf(b)) * 255.0f;
    if (!(difference < 255.0f)) return 255; // includes NaN
    return std::max(1u, static_cast<uint32_t>(std::ceil(difference)));
}

/// Largest difference of a component; 0 only for identical bits.
uint32_t pixelDifference(Format format, const std::byte* a, const std::byte* b) {
    uint32_t largest = 0;
    if (format == Format::RGBA8 || format == Format::RGBA8Srgb) {
        for (int c = 0; c < 4; ++c) largest = std::max(largest, componentDifference8(a[c], b[c]));
        return largest;
    }
    if (format == Format::RGB10A2) {
        const std::array<float, 4> x = texel(format, { a, 4 }, 0), y = texel(format, { b, 4 }, 0);
        for (size_t c = 0; c < 4; ++c)
            largest = std::max(largest, static_cast<uint32_t>(std::ceil(std::abs(x[c] - y[c]) * 255.0f)));
        return largest;
    }
    uint16_t halvesA[4], halvesB[4];
    std::memcpy(halvesA, a, sizeof halvesA);
    std::memcpy(halvesB, b, sizeof halvesB);
    for (int c = 0; c < 4; ++c) largest = std::max(largest, componentDifference16(halvesA[c], halvesB[c]));
    return largest;
}

uint8_t displayByte(Image const& image, size_t pixel, size_t component) {
    const float value = pixelAt(image, pixel)[component];
    if (image.format != Format::RGBA16F) return static_cast<uint8_t>(value * 255.0f + 0.5f);
    return static_cast<uint8_t>(std::sqrt(value > 0 ? std::min(value, 1.0f) : 0.0f) * 255.0f);
}

} // namespace

std::string ImageComparison::percentage() const {
    // Counts whole steps of 0.0001 %, so that rounding cannot turn one wrong pixel into 100 %.
    const uint64_t steps = pixels ? identical * 1'000'000 / pixels : 0;
    return fmt::format("{}.{:04} %", steps / 10'000, steps % 10'000);
}

std::string ImageComparison::line() const {
    return fmt::format("identical: {} of pixels, max difference {}/255", percentage(), maxDifference);
}

Result<ImageComparison> compareImages(Image const& a, Image const& b) {
    if (Result<void> good = checkPair(a, b); !good) return good.error();
    ImageComparison result{ .pixels = pixelCount(a), .identical = pixelCount(a) };
    result.first = firstDifference(a.format, a.width, a.pixels, b.pixels);
    if (!result.first) return result;
    result.identical -= result.first->count;
    const size_t stride = a.pixels.size() / result.pixels;
    for (size_t at = 0; at < a.pixels.size(); at += stride)
        result.maxDifference = std::max(result.maxDifference, pixelDifference(a.format, &a.pixels[at], &b.pixels[at]));
    return result;
}

Image differenceImage(Image const& a, Image const& b) {
    FILAMENT_ASSERT(compareImages(a, b).ok(), "difference pictures are made of images that can be compared");
    constexpr uint32_t kRedFrom = 16; // sixteenths of the way from yellow to red
    const size_t stride = a.pixels.size() / pixelCount(a);
    Image result{ .width = a.width, .height = a.height, .format = Format::RGBA8 };
    result.pixels.resize(size_t(a.width) * a.height * 4);
    for (size_t i = 0; i < result.pixels.size() / 4; ++i) {
        const uint32_t difference = pixelDifference(a.format, &a.pixels[i * stride], &b.pixels[i * stride]);
        uint8_t rgb[3] = { 255, static_cast<uint8_t>(255 - 255 * std::min(difference, kRedFrom) / kRedFrom), 0 };
        if (difference == 0) {
            for (size_t c = 0; c < 3; ++c) rgb[c] = displayByte(a, i, c) / 4;
        }
        for (int c = 0; c < 3; ++c) result.pixels[i * 4 + c] = std::byte{ rgb[c] };
        result.pixels[i * 4 + 3] = std::byte{ 255 };
    }
    return result;
}

} // namespace filament_core::tools
