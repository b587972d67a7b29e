// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::shader::lib {
namespace {

TEST(Reflection, WeightsAreOneWhereAHitIsCertainAndZeroWhereItIsUnknown) {
    EXPECT_EQ(insideWeight(vec2(0.5f, 0.5f), 0.08f), 1);
    EXPECT_EQ(insideWeight(vec2(0.0f, 0.5f), 0.08f), 0);
    EXPECT_EQ(insideWeight(vec2(0.5f, 1.0f), 0.08f), 0);
    EXPECT_EQ(insideWeight(vec2(-3.0f, 0.5f), 0.08f), 0);
    EXPECT_EQ(insideWeight(vec2(0.5f, 1e30f), 0.08f), 0);
    EXPECT_NEAR(insideWeight(vec2(0.04f, 0.5f), 0.08f), 0.5f, 1e-6f);
    EXPECT_EQ(awayWeight(-1), 1);
    EXPECT_EQ(awayWeight(0), 1);
    EXPECT_EQ(awayWeight(0.5f), 0);
    EXPECT_EQ(awayWeight(1), 0);
    EXPECT_EQ(reachWeight(0), 1);
    EXPECT_EQ(reachWeight(0.75f), 1);
    EXPECT_EQ(reachWeight(1), 0);
}

TEST(Reflection, HalfOfTheFacetsOfGgxLieWithinTheLobesRadius) {
    for (const float alpha : { 0.01f, 0.1f, 0.2f, 0.4f }) {
        // The part of D(h) n.h below an angle is tan^2 / (alpha^2 + tan^2); the mirrored ray leans by twice the angle.
        const double facet = 0.5 * std::atan(double(lobeRadius(alpha)));
        const double tangent2 = std::tan(facet) * std::tan(facet);
        EXPECT_NEAR(tangent2 / (double(alpha) * alpha + tangent2), 0.5, 1e-5) << alpha;
    }
    EXPECT_EQ(lobeRadius(0), 0);
    EXPECT_EQ(lobeRadius(1), 1) << "45 degrees are enough";
}

TEST(Reflection, TheLevelGrowsByOneForEachDoublingOfTheRadius) {
    EXPECT_EQ(blurLevel(0), 0);
    EXPECT_EQ(blurLevel(0.5f), 0);
    for (float radius = 1; radius < 4096; radius *= 2)
        EXPECT_NEAR(blurLevel(2 * radius) - blurLevel(radius), 1, 1e-5f) << radius;
}

} // namespace
} // namespace filament_core::shader::lib
