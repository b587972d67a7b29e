// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/ImageCompare.h"

#include "base/Assert.h"
#include "base/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament::tools {
namespace {

size_t bytesPerPixel(Format format) {
    const bool isFour = format == Format::RGBA8 || format == Format::RGB10A2;
    return isFour ? 4 : format == Format::RGBA16F ? 8 : 0;
}

/// In [0, 1].
float componentOf10Bits(const std::byte* pixel, int component) {
    uint32_t word = 0;
    std::memcpy(&word, pixel, sizeof word);
    return component == 3 ? static_cast<float>(word >> 30) / 3.0f
                          : static_cast<float>(word >> 10 * component & 1023) / 1023.0f;
}

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
    if (format == Format::RGBA8) {
        for (int c = 0; c < 4; ++c) largest = std::max(largest, componentDifference8(a[c], b[c]));
        return largest;
    }
    if (format == Format::RGB10A2) {
        for (int c = 0; c < 4; ++c) {
            const float difference = std::abs(componentOf10Bits(a, c) - componentOf10Bits(b, c)) * 255.0f;
            largest = std::max(largest, static_cast<uint32_t>(std::ceil(difference)));
        }
        return largest;
    }
    uint16_t halvesA[4], halvesB[4];
    std::memcpy(halvesA, a, sizeof halvesA);
    std::memcpy(halvesB, b, sizeof halvesB);
    for (int c = 0; c < 4; ++c) largest = std::max(largest, componentDifference16(halvesA[c], halvesB[c]));
    return largest;
}

uint8_t displayByte(Format format, const std::byte* pixel, int component) {
    if (format == Format::RGBA8) return std::to_integer<uint8_t>(pixel[component]);
    if (format == Format::RGB10A2) return static_cast<uint8_t>(componentOf10Bits(pixel, component) * 255.0f + 0.5f);
    uint16_t half = 0;
    std::memcpy(&half, pixel + 2 * component, sizeof half);
    const float value = floatFromHalf(half);
    return static_cast<uint8_t>(std::sqrt(value > 0 ? std::min(value, 1.0f) : 0.0f) * 255.0f);
}

} // namespace

std::string ImageComparison::line() const {
    // Counts whole steps of 0.0001 %, so that rounding cannot turn one wrong pixel into 100 %.
    const uint64_t steps = pixels ? identical * 1'000'000 / pixels : 0;
    return fmt::format("identical: {}.{:04} % of pixels, max difference {}/255", steps / 10'000, steps % 10'000,
                       maxDifference);
}

Result<ImageComparison> compareImages(Image const& a, Image const& b) {
    if (a.width != b.width || a.height != b.height) {
        return fail(ErrorCode::InvalidArgument, "cannot compare {}x{} with {}x{} pixels: make the sizes equal", a.width,
                    a.height, b.width, b.height);
    }
    const size_t stride = bytesPerPixel(a.format);
    if (a.format != b.format || stride == 0) {
        return fail(ErrorCode::InvalidArgument,
                    "cannot compare images of different formats: both RGBA8, RGB10A2 or RGBA16F");
    }
    const size_t pixels = size_t(a.width) * a.height;
    if (pixels == 0 || a.pixels.size() != pixels * stride || b.pixels.size() != pixels * stride) {
        return fail(ErrorCode::InvalidArgument, "cannot compare {} with {} bytes of pixels: {}x{} pixels take {}",
                    a.pixels.size(), b.pixels.size(), a.width, a.height, pixels * stride);
    }
    ImageComparison result{ .pixels = pixels };
    for (size_t i = 0; i < pixels; ++i) {
        const size_t at = i * stride;
        if (std::memcmp(&a.pixels[at], &b.pixels[at], stride) == 0) {
            ++result.identical;
        } else {
            result.maxDifference =
                    std::max(result.maxDifference, pixelDifference(a.format, &a.pixels[at], &b.pixels[at]));
        }
    }
    return result;
}

Image differenceImage(Image const& a, Image const& b) {
    FILAMENT_ASSERT(compareImages(a, b).ok(), "difference pictures are made of images that can be compared");
    constexpr uint32_t kRedFrom = 16; // sixteenths of the way from yellow to red
    const size_t stride = bytesPerPixel(a.format);
    Image result{ .width = a.width, .height = a.height, .format = Format::RGBA8 };
    result.pixels.resize(size_t(a.width) * a.height * 4);
    for (size_t i = 0; i < result.pixels.size() / 4; ++i) {
        const std::byte* pixelA = &a.pixels[i * stride];
        const uint32_t difference = pixelDifference(a.format, pixelA, &b.pixels[i * stride]);
        uint8_t rgb[3] = { 255, static_cast<uint8_t>(255 - 255 * std::min(difference, kRedFrom) / kRedFrom), 0 };
        if (difference == 0) {
            for (int c = 0; c < 3; ++c) rgb[c] = displayByte(a.format, pixelA, c) / 4;
        }
        for (int c = 0; c < 3; ++c) result.pixels[i * 4 + c] = std::byte{ rgb[c] };
        result.pixels[i * 4 + 3] = std::byte{ 255 };
    }
    return result;
}

} // namespace filament::tools
