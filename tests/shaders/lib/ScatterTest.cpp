// SPDX-License-Identifier: Apache-2.0
// scatter.glsl: limits that are known, closed forms, and the tolerances that its comments state.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

constexpr double kColors[] = { 0, 0.01, 0.2, 0.5, 0.9, 0.999, 1 };
constexpr double kDepths[] = { 0, 0.01, 0.3, 1, 3, 10, 64 };
constexpr double kBallIors[] = { 1, 1.33, 1.5, 2.4 };
constexpr double kAnisotropies[] = { -0.999, -0.5, 0, 0.5, 0.999 };

double lossOf(double color) { return scatterLoss(vec3(color)).x; }

TEST(Scatter, TheLossSolvesVanDeHulstsAlbedo) {
    for (const double color : kColors) {
        const double s = lossOf(color);
        EXPECT_NEAR((1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s), color, 1e-12);
        EXPECT_GE(s, 0);
        EXPECT_LE(s, 1);
    }
}

TEST(Scatter, ABallWithoutMatterLetsAllThroughAndOneWithMuchNothing) {
    EXPECT_EQ(ballTransmittance(vec3(0)).x, 1);
    EXPECT_EQ(ballEscape(vec3(0)).x, 1);
    EXPECT_LT(ballTransmittance(vec3(64)).x, 2e-3);
    EXPECT_LT(ballEscape(vec3(64)).x, 0.03);
}

TEST(Scatter, TheBallIsNearItsClosedFormsAndKeepsTheirReciprocity) {
    for (double depth = 0.05; depth < 64; depth *= 1.25) {
        const double exact = 2 * (1 - (1 + depth) * std::exp(-depth)) / (depth * depth);
        const double through = ballTransmittance(vec3(depth)).x, escape = ballEscape(vec3(depth)).x;
        EXPECT_NEAR(through, exact, 0.034) << depth;
        EXPECT_NEAR(escape, 1.5 * (1 - exact) / depth, 0.02) << depth;
        EXPECT_NEAR(through + 2 * depth * escape / 3, 1, 1e-6) << "what does not cross the ball scatters in it";
    }
}

TEST(Scatter, FresnelsReflectionInsideIsNearItsIntegral) {
    EXPECT_EQ(diffuseReflectedInside(1.0), 0);
    for (const double ior : { 1.2, 1.33, 1.5, 2.0 }) {
        constexpr int kSteps = 10'000;
        double outside = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = (i + 0.5) / kSteps, inside = refractedCosine(cosine, ior);
            const double s = (cosine - ior * inside) / (cosine + ior * inside);
            const double p = (ior * cosine - inside) / (ior * cosine + inside);
            outside += (s * s + p * p) * cosine / kSteps;
        }
        EXPECT_NEAR(diffuseReflectedInside(ior), 1 - (1 - outside) / (ior * ior), 0.025) << ior;
    }
}

TEST(Scatter, WithoutAbsorptionAllOfTheScatteredLightLeaves) {
    for (const double depth : kDepths) {
        for (const double ior : kBallIors) EXPECT_NEAR(scatteredShare(vec3(depth), vec3(0), ior).x, 1, 1e-12);
    }
}

TEST(Scatter, AThickBodyOfIndexOneHasItsColor) {
    for (const double color : kColors) {
        const double share = scatteredShare(vec3(1e4), vec3(lossOf(color)), 1.0).x;
        EXPECT_NEAR(share, color, 2e-3) << color;
    }
}

TEST(Scatter, AThinBodyScattersEachRayOnce) {
    for (const double color : kColors) {
        const double loss = lossOf(color);
        EXPECT_NEAR(scatteredShare(vec3(0), vec3(loss), 1.0).x, 1 - loss * loss, 1e-12) << color;
    }
}

TEST(Scatter, MoreMatterOfTheSameKindLosesMoreLight) {
    for (const double color : kColors) {
        for (const double ior : kBallIors) {
            double before = 1;
            for (const double depth : kDepths) {
                const double share = scatteredShare(vec3(depth), vec3(lossOf(color)), ior).x;
                EXPECT_LE(share, before + 1e-12);
                EXPECT_GE(share, 0);
                before = share;
            }
        }
    }
}

TEST(Scatter, TheSidesOfAThinBodyAreThoseOfOneEventAndAThickOneIsLitFromTheFront) {
    EXPECT_NEAR(scatteredFromBehind(vec3(0), 0.0, 1.0).x, 0.5, 1e-12);
    EXPECT_NEAR(scatteredFromBehind(vec3(0), -0.5, 1.0).x, 0.25, 1e-12);
    EXPECT_LT(scatteredFromBehind(vec3(64), 0.0, 1.0).x, 0.04);
    for (const double anisotropy : kAnisotropies) {
        for (const double depth : kDepths) {
            const double behind = scatteredFromBehind(vec3(depth), anisotropy, 1.5).x;
            EXPECT_GE(behind, 0);
            EXPECT_LE(behind, 1);
        }
    }
}

TEST(Scatter, ForwardScatteringIsLikeLessMatter) {
    EXPECT_NEAR(scatterSimilarity(vec3(0), 0.8).x, 0.2, 1e-12);
    EXPECT_NEAR(scatterSimilarity(vec3(0), -0.5).x, 1.5, 1e-12);
    EXPECT_EQ(scatterSimilarity(vec3(1), 0.8).x, 1) << "nothing scatters";
}

} // namespace
} // namespace filament_core::shader::lib64
