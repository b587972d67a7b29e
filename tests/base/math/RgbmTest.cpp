// SPDX-License-Identifier: Apache-2.0
#include "base/math/Rgbm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core {
namespace {

TEST(Rgbm, WhatFitsIsKeptToAHundredthOfTheBrightestComponent) {
    for (const float scale : { 0.05f, 0.3f, 1.0f, 7.0f, 255.0f }) {
        const float3 light(scale, 0.6f * scale, 0.02f * scale);
        const float3 back = unpackRgbm(packRgbm(light));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], light[c], 0.01f * scale) << scale << ' ' << c;
    }
}

TEST(Rgbm, TheEndsOfTheRangeAreExact) {
    EXPECT_EQ(packRgbm(float3(0)), 0u);
    EXPECT_EQ(unpackRgbm(0), float3(0));
    EXPECT_EQ(packRgbm(float3(kMaxRgbm)), 0xFFFFFFFFu);
    EXPECT_EQ(unpackRgbm(0xFFFFFFFFu), float3(kMaxRgbm));
}

TEST(Rgbm, WhatIsTooBrightKeepsItsHue) {
    const float3 back = unpackRgbm(packRgbm(float3(4000, 1000, 0)));
    EXPECT_EQ(back.x, kMaxRgbm);
    EXPECT_NEAR(back.y, kMaxRgbm / 4, 0.6f) << "half a step of the root";
    EXPECT_EQ(back.z, 0);
}

TEST(Rgbm, WhatIsNoLightIsBlack) {
    EXPECT_EQ(packRgbm(float3(-1, std::numeric_limits<float>::quiet_NaN(), 0)), 0u);
    EXPECT_EQ(unpackRgbm(packRgbm(float3(-1, 256, 0))), float3(0, 256, 0));
}

} // namespace
} // namespace filament_core
