// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {
namespace {

TEST(Light, WithoutRangeTheInverseSquareLawHoldsExactly) {
    for (const float distance : { 0.01f, 0.5f, 1.0f, 3.0f, 1000.0f }) {
        EXPECT_NEAR(distanceAttenuation(vec3(0, distance, 0), 0.0f) * distance * distance, 1.0f, 1e-5f);
    }
}

TEST(Light, TheWindowReachesZeroAtTheRangeWithZeroSlope) {
    const float range = 5, inverse = 1 / (range * range);
    EXPECT_EQ(distanceAttenuation(vec3(0, 0, range), inverse), 0.0f);
    EXPECT_EQ(distanceAttenuation(vec3(0, 0, 2 * range), inverse), 0.0f);
    EXPECT_LT(distanceAttenuation(vec3(0, 0, 0.99f * range), inverse), 1e-3f * inverse * 100);
    EXPECT_NEAR(distanceAttenuation(vec3(0, 0, 0.1f * range), inverse) * sq(0.1f * range), 1.0f, 1e-3f)
            << "near: no window";
}

TEST(Light, ALightAtTheSurfaceIsBrightButFinite) {
    EXPECT_EQ(distanceAttenuation(vec3(0.0f), 0.0f), 1.0f / kMinLightDistanceSquared);
    EXPECT_EQ(distanceAttenuation(vec3(1e-30f), 1e30f), 1.0f / kMinLightDistanceSquared);
    EXPECT_TRUE(std::isfinite(distanceAttenuation(vec3(1e18f), 0.0f)));
    EXPECT_EQ(distanceAttenuation(vec3(1e10f), 1.0f), 0.0f);
}

TEST(Light, ASpotIsFullInsideOfItsInnerConeAndDarkOutsideOfItsOuter) {
    const float cosInner = std::cos(0.3f), cosOuter = std::cos(0.6f);
    const float scale = 1 / (cosInner - cosOuter), offset = -cosOuter * scale;
    const auto at = [&](float angle) {
        const vec3 toLight(std::sin(angle), std::cos(angle), 0);
        return spotAttenuation(toLight, vec3(0, -1, 0), scale, offset);
    };
    EXPECT_NEAR(at(0.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(at(0.29f), 1.0f, 1e-6f);
    EXPECT_EQ(at(0.61f), 0.0f);
    EXPECT_EQ(at(3.14159f), 0.0f) << "behind the spot";
    float last = 1;
    for (float angle = 0.3f; angle <= 0.6f; angle += 0.01f) {
        EXPECT_LE(at(angle), last + 1e-6f);
        last = at(angle);
    }
}

} // namespace
} // namespace filament_core::shader::lib
