// SPDX-License-Identifier: Apache-2.0
#include "base/math/SharedExponent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core {
namespace {

TEST(SharedExponent, EveryPackedValueUnpacksToSomethingThatPacksToTheSameNumber) {
    for (uint32_t exponent = 0; exponent < 32; ++exponent) {
        for (uint32_t m = 0; m < 512; ++m) {
            const float3 value = unpackRgb9E5(m | (511 - m) << 9 | (m ^ 0x155u) << 18 | exponent << 27);
            EXPECT_EQ(unpackRgb9E5(packRgb9E5(value)), value);
        }
    }
}

TEST(SharedExponent, TheLargestComponentKeepsNineBitsAndTheOthersItsStep) {
    for (float scale = 1e-3f; scale < 6e4f; scale *= 1.7f) {
        const float3 value = float3(1.0f, 0.37f, 0.011f) * scale;
        const float3 back = unpackRgb9E5(packRgb9E5(value));
        for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(back[c] - value[c]), scale / 512 * 1.0001f) << scale;
    }
}

TEST(SharedExponent, OneIsExactAndWhatDoesNotFitIsClamped) {
    EXPECT_EQ(unpackRgb9E5(packRgb9E5(float3(1))), float3(1));
    EXPECT_EQ(unpackRgb9E5(packRgb9E5(float3(1e9f, 0, -4))), float3(kMaxRgb9E5, 0, 0));
    EXPECT_EQ(unpackRgb9E5(packRgb9E5(float3(std::numeric_limits<float>::quiet_NaN(), 0, 0))), float3(0));
    EXPECT_EQ(unpackRgb9E5(packRgb9E5(float3(std::numeric_limits<float>::infinity()))), float3(kMaxRgb9E5));
    EXPECT_EQ(packRgb9E5(float3(0)), 0u);
    EXPECT_NEAR(unpackRgb9E5(packRgb9E5(float3(1.9999f, 0, 0))).x, 2.0f, 0.004f); // the exponent moves up
}

} // namespace
} // namespace filament_core
