// SPDX-License-Identifier: Apache-2.0
#include "base/math/Rgbd.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

float lightOf(float x) { return x > 0 ? x : 0.0f; } // NaN is not greater than 0

uint32_t codeOf(float x) { return static_cast<uint32_t>(std::lround(std::clamp(x, 0.0f, 255.0f))); }

} // namespace

uint32_t packRgbd(float3 radiance) {
    float3 light(lightOf(radiance.x), lightOf(radiance.y), lightOf(radiance.z));
    const float brightest = std::max({ light.x, light.y, light.z });
    if (brightest > kMaxRgbd) light *= kMaxRgbd / brightest;
    // Rounded down, so that no component exceeds 1.
    const float divisor = std::clamp(std::floor(255.0f / std::max(brightest, 1.0f)), 1.0f, 255.0f);
    return codeOf(light.x * divisor) | codeOf(light.y * divisor) << 8 | codeOf(light.z * divisor) << 16 |
           static_cast<uint32_t>(divisor) << 24;
}

float3 unpackRgbd(uint32_t bits) {
    const auto code = [&](uint32_t shift) { return static_cast<float>(bits >> shift & 0xFFu); };
    const float divisor = code(24); // the 255 of both unit values cancel
    return divisor > 0 ? float3(code(0) / divisor, code(8) / divisor, code(16) / divisor) : float3(0.0f);
}

} // namespace filament_core
