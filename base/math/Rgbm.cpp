// SPDX-License-Identifier: Apache-2.0
#include "base/math/Rgbm.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

float nonNegative(float x) { return x > 0 ? x : 0.0f; } // NaN is not greater than 0

uint32_t byteOf(float x) { return static_cast<uint32_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 255.0f)); }

} // namespace

uint32_t packRgbm(float3 radiance) {
    float3 light(nonNegative(radiance.x), nonNegative(radiance.y), nonNegative(radiance.z));
    const float brightest = std::max({ light.x, light.y, light.z });
    if (!(brightest > 0)) return 0;
    if (brightest > kMaxRgbm) light *= kMaxRgbm / brightest;
    const float root = std::sqrt(std::min(brightest, kMaxRgbm)) / kRgbmRange;
    // Round the factor up, so that no component exceeds 1.
    const uint32_t factor = std::min(255u, static_cast<uint32_t>(std::ceil(root * 255.0f)));
    const float scale = 255.0f / (kRgbmRange * static_cast<float>(factor));
    return byteOf(std::sqrt(light.x) * scale) | byteOf(std::sqrt(light.y) * scale) << 8 |
           byteOf(std::sqrt(light.z) * scale) << 16 | factor << 24;
}

float3 unpackRgbm(uint32_t bits) {
    const auto component = [&](uint32_t shift) { return static_cast<float>(bits >> shift & 0xFFu) / 255.0f; };
    const float scale = component(24) * kRgbmRange;
    const float3 root(component(0) * scale, component(8) * scale, component(16) * scale);
    return root * root;
}

} // namespace filament_core
