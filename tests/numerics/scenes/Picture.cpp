// SPDX-License-Identifier: Apache-2.0
#include "tests/numerics/scenes/Picture.h"

#include "base/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <span>

#include <fmt/format.h>

namespace filament_core::hard {
namespace {

float4 halfPixel(Image const& image, uint32_t x, uint32_t y) {
    uint16_t bits[4];
    std::memcpy(bits, image.pixels.data() + (static_cast<size_t>(y) * image.width + x) * sizeof(bits), sizeof(bits));
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]), floatFromHalf(bits[3]) };
}

/// All exponent bits set: inf or NaN, in the two layouts of floating-point attachments.
template <class Word>
uint32_t countNotFinite(std::span<const std::byte> bytes, Word exponent, size_t& first) {
    uint32_t count = 0;
    for (size_t i = 0; i + sizeof(Word) <= bytes.size(); i += sizeof(Word)) {
        Word bits;
        std::memcpy(&bits, &bytes[i], sizeof bits);
        if ((bits & exponent) == exponent && count++ == 0) first = i;
    }
    return count;
}

uint32_t countNotFinite(backend::CapturedAttachment const& attachment, size_t& first) {
    if (attachment.format == Format::RGBA16F) return countNotFinite<uint16_t>(attachment.bytes, 0x7C00, first);
    return countNotFinite<uint32_t>(attachment.bytes, 0x7F800000, first);
}

} // namespace

float4 Picture::at(uint32_t x, uint32_t y) const { return halfPixel(linear, x, y); }

uint32_t Picture::coveredCount() const {
    uint32_t count = 0;
    forEachCovered(*this, [&](uint32_t, uint32_t, float4) { ++count; });
    return count;
}

std::string describeNotFinite(backend::CapturedFrame const& frame, uint32_t& scannedAttachments) {
    std::string text;
    for (backend::CapturedPass const& pass : frame.passes) {
        for (backend::CapturedAttachment const& attachment : pass.attachments) {
            const bool hasFloats = attachment.isDepth || attachment.format == Format::RGBA16F;
            if (!hasFloats || attachment.bytes.empty()) continue;
            ++scannedAttachments;
            size_t first = 0;
            const uint32_t bad = countNotFinite(attachment, first);
            if (bad == 0) continue;
            const size_t texel = first / (attachment.isDepth ? 4 : 8);
            text += fmt::format("pass '{}', texture '{}': {} components are not finite, first at ({}, {})\n", pass.name,
                                attachment.name, bad, texel % attachment.width, texel / attachment.width);
        }
    }
    return text;
}

Difference compare(Image const& a, Image const& b, uint32_t tolerance) {
    Difference difference;
    if (a.pixels.size() != b.pixels.size()) return { ~0u, 255 };
    for (size_t pixel = 0; pixel < a.pixels.size(); pixel += 4) {
        uint32_t largest = 0;
        for (size_t i = pixel; i < pixel + 4; ++i) {
            const int step = std::to_integer<int>(a.pixels[i]) - std::to_integer<int>(b.pixels[i]);
            largest = std::max(largest, static_cast<uint32_t>(std::abs(step)));
        }
        difference.pixels += largest > tolerance;
        difference.largest = std::max(difference.largest, largest);
    }
    return difference;
}

Image mirroredLeftRight(Image image) {
    const size_t pixelBytes = image.pixels.size() / (static_cast<size_t>(image.width) * image.height);
    const size_t rowBytes = pixelBytes * image.width;
    for (size_t row = 0; row < image.pixels.size(); row += rowBytes) {
        for (size_t left = 0, right = image.width - 1; left < right; ++left, --right) {
            std::byte* const begin = image.pixels.data() + row;
            std::swap_ranges(begin + left * pixelBytes, begin + (left + 1) * pixelBytes, begin + right * pixelBytes);
        }
    }
    return image;
}

uint32_t bytesAt(Image const& display, uint32_t x, uint32_t y) {
    uint32_t bytes = 0;
    std::memcpy(&bytes, display.pixels.data() + (static_cast<size_t>(y) * display.width + x) * 4, sizeof bytes);
    return bytes;
}

void forEachCovered(Picture const& picture, std::function<void(uint32_t, uint32_t, float4)> const& visit) {
    for (uint32_t y = 0; y < picture.linear.height; ++y) {
        for (uint32_t x = 0; x < picture.linear.width; ++x) {
            const float4 color = picture.at(x, y);
            if (color.w == 1.0f) visit(x, y, color);
        }
    }
}

} // namespace filament_core::hard
