// SPDX-License-Identifier: Apache-2.0
#include "base/math/Rgbd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core {
namespace {

uint32_t texelOf(uint32_t code, uint32_t divisor) { return code | code << 8 | code << 16 | divisor << 24; }

// Every colour with every divisor: the value is the nearest float to the quotient of the two unit numbers.
TEST(Rgbd, EveryTexelIsItsColourOverItsDivisor) {
    for (uint32_t divisor = 1; divisor < 256; ++divisor) {
        for (uint32_t code = 0; code < 256; ++code) {
            const double exact = static_cast<double>(code) / divisor; // of code / 255 and divisor / 255
            const float3 found = unpackRgbd(texelOf(code, divisor));
            ASSERT_EQ(found.x, static_cast<float>(exact)) << code << " / " << divisor;
            ASSERT_EQ(found.y, found.x);
            ASSERT_EQ(found.z, found.x);
        }
    }
}

TEST(Rgbd, ComponentsAreInTheOrderOfTheirBytes) {
    EXPECT_EQ(unpackRgbd(0x04030201u), float3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(packRgbd({ 1, 0.2f, 0 }), 0xFF0033FFu);
}

TEST(Rgbd, ADivisorOfZeroIsBlack) {
    EXPECT_EQ(unpackRgbd(0x00FFFFFFu), float3(0));
    EXPECT_EQ(unpackRgbd(0), float3(0));
}

// Half a step of the divisor that was chosen; a step of 1 / 128 of the brightest component at worst.
TEST(Rgbd, WhatFitsIsKeptToHalfAStep) {
    for (int i = 0; i < 4000; ++i) {
        const float scale = std::exp2(static_cast<float>(i % 200) / 200.0f * 16.0f - 8.0f);
        if (scale > kMaxRgbd) continue;
        const float3 light(scale, 0.7f * scale, 0.01f * scale * static_cast<float>(i % 7));
        const uint32_t bits = packRgbd(light);
        const float step = 1 / static_cast<float>(bits >> 24);
        for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(unpackRgbd(bits)[c] - light[c]), 0.5001f * step) << scale;
        EXPECT_LE(step, std::max(scale / 127, 1.0f / 255)) << scale;
    }
}

TEST(Rgbd, TheEndsOfTheRangeAreExactAndBrighterLightKeepsItsHue) {
    EXPECT_EQ(packRgbd(float3(0)), 0xFF000000u);
    EXPECT_EQ(packRgbd(float3(1)), 0xFFFFFFFFu);
    EXPECT_EQ(unpackRgbd(packRgbd(float3(kMaxRgbd))), float3(kMaxRgbd));
    EXPECT_EQ(unpackRgbd(packRgbd(float3(4000, 1000, 0))), float3(255, 64, 0));
    EXPECT_EQ(packRgbd({ -1, std::numeric_limits<float>::quiet_NaN(), 0 }), 0xFF000000u);
}

} // namespace
} // namespace filament_core
