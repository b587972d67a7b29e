// SPDX-License-Identifier: Apache-2.0
#include "base/math/SharedExponent.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

constexpr int kMantissaBits = 9, kBias = 15;

float inRange(float x) { return x > 0 ? std::min(x, kMaxRgb9E5) : 0.0f; } // NaN is not greater than 0

// Exact: a power of two.
float stepOf(int exponent) { return std::ldexp(1.0f, exponent - kBias - kMantissaBits); }

uint32_t mantissa(float x, int exponent) { return static_cast<uint32_t>(std::floor(x / stepOf(exponent) + 0.5f)); }

} // namespace

uint32_t packRgb9E5(float3 value) {
    const float r = inRange(value.x), g = inRange(value.y), b = inRange(value.z);
    const float largest = std::max({ r, g, b });
    int exponent = largest > 0 ? std::max(-kBias - 1, std::ilogb(largest)) + 1 + kBias : 0;
    if (mantissa(largest, exponent) == 1u << kMantissaBits) ++exponent; // rounded up to the next power of two
    return mantissa(r, exponent) | mantissa(g, exponent) << 9 | mantissa(b, exponent) << 18 |
           static_cast<uint32_t>(exponent) << 27;
}

float3 unpackRgb9E5(uint32_t bits) {
    const float step = stepOf(static_cast<int>(bits >> 27));
    const auto component = [&](uint32_t shift) { return static_cast<float>(bits >> shift & 0x1FFu) * step; };
    return { component(0), component(9), component(18) };
}

} // namespace filament_core
