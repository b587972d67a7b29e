// SPDX-License-Identifier: Apache-2.0
#include "base/math/Half.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace filament_core {
namespace {

// Rounds a finite float in [0, maximum] to an unsigned float with 5 exponent bits (bias 15) and `mantissaBits`.
uint32_t roundToSmallFloat(float value, uint32_t mantissaBits, float maximum) {
    if (!(value > 0)) return 0;
    const float clamped = std::min(value, maximum);
    int exponent = 0;
    std::frexp(clamped, &exponent); // clamped = m * 2^exponent, m in [0.5, 1)
    const int unbiased = std::max(exponent - 1, -14);
    const double scale = std::ldexp(1.0, static_cast<int>(mantissaBits) - unbiased);
    const auto significand = static_cast<uint32_t>(std::nearbyint(static_cast<double>(clamped) * scale));
    const uint32_t hidden = 1u << mantissaBits;
    if (significand < hidden) return significand; // denormal
    // A carry out of the mantissa increments the exponent automatically.
    return (static_cast<uint32_t>(unbiased + 15) << mantissaBits) + (significand - hidden);
}

float expandSmallFloat(uint32_t bits, uint32_t mantissaBits) {
    const uint32_t mantissa = bits & ((1u << mantissaBits) - 1);
    const uint32_t exponent = bits >> mantissaBits;
    if (exponent == 31) {
        return mantissa ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
    }
    const int shift = static_cast<int>(mantissaBits);
    if (exponent == 0) return std::ldexp(static_cast<float>(mantissa), -14 - shift);
    return std::ldexp(static_cast<float>(mantissa | (1u << mantissaBits)), static_cast<int>(exponent) - 15 - shift);
}

} // namespace

uint16_t halfFromFloat(float value) {
    if (std::isnan(value)) return 0;
    const uint32_t sign = std::signbit(value) ? 0x8000u : 0u;
    return static_cast<uint16_t>(sign | roundToSmallFloat(std::fabs(value), 10, kMaxHalf));
}

float floatFromHalf(uint16_t bits) {
    const float magnitude = expandSmallFloat(bits & 0x7FFFu, 10);
    return (bits & 0x8000u) ? -magnitude : magnitude;
}

uint32_t packR11G11B10F(float3 value) {
    return roundToSmallFloat(value.x, 6, kMaxFloat11) | (roundToSmallFloat(value.y, 6, kMaxFloat11) << 11) |
           (roundToSmallFloat(value.z, 5, kMaxFloat10) << 22);
}

float3 unpackR11G11B10F(uint32_t bits) {
    return { expandSmallFloat(bits & 0x7FFu, 6), expandSmallFloat((bits >> 11) & 0x7FFu, 6),
             expandSmallFloat(bits >> 22, 5) };
}

} // namespace filament_core
