// SPDX-License-Identifier: Apache-2.0
#include "tests/numerics/scenes/Picture.h"

#include "filament_core/math/Half.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

namespace filament::hard {
namespace {

float4 halfPixel(Image const& image, uint32_t x, uint32_t y) {
    uint16_t bits[4];
    std::memcpy(bits, image.pixels.data() + (static_cast<size_t>(y) * image.width + x) * sizeof(bits), sizeof(bits));
    return { floatFromHalf(bits[0]), floatFromHalf(bits[1]), floatFromHalf(bits[2]), floatFromHalf(bits[3]) };
}

bool isFinite(float4 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w); }

} // namespace

float4 Picture::at(uint32_t x, uint32_t y) const { return halfPixel(linear, x, y); }

uint32_t Picture::coveredCount() const {
    uint32_t count = 0;
    forEachCovered(*this, [&](uint32_t, uint32_t, float4) { ++count; });
    return count;
}

std::string describeNotFinite(Image const& image) {
    uint32_t bad = 0;
    std::string first;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const float4 color = halfPixel(image, x, y);
            if (isFinite(color)) continue;
            if (bad++ == 0) first = fmt::format("({}, {}): ({}, {}, {}, {})", x, y, color.x, color.y, color.z, color.w);
        }
    }
    return bad == 0
                   ? ""
                   : fmt::format("{} of {} pixels are not finite, first at {}", bad, image.width * image.height, first);
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

} // namespace filament::hard
