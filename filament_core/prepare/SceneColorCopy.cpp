// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneColorCopy.h"

#include "shaders/lib/LibCpp.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::prepare {
namespace {

// A ray leaves an object of usual proportions within a quarter of its size beside it, and a blur as wide as the last
// level reaches about an eighth of the view.
constexpr float kReachOfObject = 0.25f;
constexpr float kReachOfView = 0.125f;
constexpr float kLeastReach = 8; // pixels

uint32_t log2Floor(uint32_t x) { return static_cast<uint32_t>(std::bit_width(x)) - 1; }

uint32_t wholeSteps(uint32_t pixels, uint32_t step) { return std::max((pixels + step - 1) / step, 2u) * step; }

/// The first pixel and the one behind the last, in two or more whole texels of `step` pixels.
uint2 spanOf(float least, float most, uint32_t size, uint32_t step) {
    const auto pixelAt = [=](float at) {
        return static_cast<uint32_t>(std::clamp(std::floor(at), 0.0f, static_cast<float>(size)));
    };
    const uint32_t whole = wholeSteps(size, step);
    const uint32_t first = std::min(pixelAt(least) / step * step, whole - 2 * step);
    return { first, std::min(first + wholeSteps(pixelAt(most) + 1 - first, step), whole) };
}

} // namespace

uint8_t pictureLevels(uint2 view) {
    return static_cast<uint8_t>(
            std::clamp(log2Floor(std::max(1u, std::min(view.x, view.y))), 2u, kMostPictureLevels + 1) - 1);
}

uint2 pictureTextureSize(uint2 view) {
    const uint32_t step = 1u << (pictureLevels(view) - 1);
    return { wholeSteps(view.x, step), wholeSteps(view.y, step) };
}

SceneColorCopy copyAround(PixelBox box, uint2 view) {
    const float2 size(view);
    const float2 least = glm::clamp(box.least, float2(0.0f), size), most = glm::clamp(box.most, float2(0.0f), size);
    const float2 extent = glm::max(most - least, float2(0.0f));
    const float reach = std::max(
            { kLeastReach, kReachOfObject * std::max(extent.x, extent.y), kReachOfView * std::min(size.x, size.y) });
    const float2 first = glm::max(least - reach, float2(0.0f)), end = glm::min(most + reach, size);
    const float narrow = std::max(1.0f, std::min(end.x - first.x, end.y - first.y));
    const uint8_t levels = static_cast<uint8_t>(
            std::min<uint32_t>(pictureLevels(view), std::max(1u, log2Floor(static_cast<uint32_t>(narrow)))));
    const uint32_t step = 1u << (levels - 1);
    const uint2 x = spanOf(first.x, end.x, view.x, step), y = spanOf(first.y, end.y, view.y, step);
    return { .rect = { static_cast<int32_t>(x.x), static_cast<int32_t>(y.x), x.y - x.x, y.y - y.x }, .levels = levels };
}

// What is infinitely far behind is blurred most, and between two levels both are read.
uint8_t levelsOfRoughness(float perceptualRoughness, float pixelsPerTangent) {
    if (perceptualRoughness <= 0) return 1;
    const float deviation = shader::lib::transmittedDeviation(std::min(perceptualRoughness, 1.0f));
    const float level = shader::lib::pictureLevel(deviation * pixelsPerTangent);
    return static_cast<uint8_t>(std::min(level, static_cast<float>(kMostPictureLevels)) + 2);
}

} // namespace filament_core::prepare
