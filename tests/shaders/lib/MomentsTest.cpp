// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace filament_core::shader::lib {
namespace {

TEST(Moments, DepthsAreLinearInMeters) {
    for (const float farMeters : { 0.01f, 1.0f, 1000.0f, 1e6f }) {
        constexpr float kNear = 1e-6f;
        for (int i = 1; i <= 100; ++i) {
            const float meters = farMeters * static_cast<float>(i) / 100;
            EXPECT_NEAR(momentDepth(kNear / meters, kNear / farMeters), 2 * meters / farMeters - 1, 1e-6f);
        }
        EXPECT_EQ(momentDepth(0, kNear / farMeters), 1) << "nothing";
        EXPECT_EQ(momentDepth(kNear / (2 * farMeters), kNear / farMeters), 1) << "beyond the far plane";
    }
    EXPECT_EQ(momentDepth(0, 0), 1);
    EXPECT_EQ(momentDepth(1, 0), -1);
    EXPECT_EQ(momentDepth(2, 0), -1);
    EXPECT_EQ(momentDepth(0.25f, 0), 0.5f);
}

TEST(Moments, TwoDepthsAreBoundedExactly) {
    for (const float share : { 0.1f, 0.25f, 0.5f, 0.75f, 0.9f }) {
        const float near = -0.5f, far = 0.5f;
        const vec2 moments = momentsOf(near) * (1 - share) + momentsOf(far) * share;
        EXPECT_NEAR(chebyshevBound(moments, far, 0), share, 1e-5f);
    }
}

// Random filters of depths: no bound is below the truth.
TEST(Moments, BoundsHoldForRandomDepths) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> depths(-1, 1);
    for (int trial = 0; trial < 2000; ++trial) {
        const size_t count = 2 + random() % 30;
        std::vector<float> texels(count);
        vec2 moments(0);
        vec4 warpedMoments(0);
        for (float& texel : texels) {
            texel = depths(random);
            moments += momentsOf(texel) / static_cast<float>(count);
            warpedMoments += warpedMomentsOf(texel) / static_cast<float>(count);
        }
        const float receiver = depths(random);
        const auto behind = std::ranges::count_if(texels, [&](float texel) { return texel >= receiver; });
        const float truth = static_cast<float>(behind) / static_cast<float>(count);
        const vec2 at = warpedDepth(receiver);
        const float ofWarped = std::min(chebyshevBound(vec2(warpedMoments.x, warpedMoments.y), at.x, 0),
                                        chebyshevBound(vec2(warpedMoments.z, warpedMoments.w), at.y, 0));
        EXPECT_GE(chebyshevBound(moments, receiver, 0), truth - 1e-4f);
        EXPECT_GE(ofWarped, truth - 1e-3f);
    }
}

// Light bleeds where a filter sees the edge of one caster in front of another.
TEST(Moments, WarpedDepthsBleedLess) {
    for (const float share : { 0.1f, 0.3f, 0.5f }) {
        const float first = -0.8f, second = 0.2f, receiver = 0.6f;
        const vec2 moments = momentsOf(first) * share + momentsOf(second) * (1 - share);
        const vec4 warped = warpedMomentsOf(first) * share + warpedMomentsOf(second) * (1 - share);
        EXPECT_GT(chebyshevBound(moments, receiver, 0), 0.2f);
        EXPECT_LT(chebyshevBound(vec2(warped.x, warped.y), warpedDepth(receiver).x, 0), 1e-6f);
        EXPECT_EQ(shadowOfWarpedMoments(warped, receiver, 0), 0);
    }
}

TEST(Moments, WhatLiesOnTheMeanIsLitAndWhatLiesFarBehindIsNot) {
    for (float depth = -1; depth <= 1; depth += 1.0f / 64) {
        EXPECT_EQ(shadowOfMoments(momentsOf(depth), depth), 1);
        EXPECT_EQ(shadowOfWarpedMoments(warpedMomentsOf(depth), depth, 0), 1);
        EXPECT_EQ(shadowOfMoments(momentsOf(depth), depth - 0.01f), 1) << "in front";
        EXPECT_EQ(shadowOfWarpedMoments(warpedMomentsOf(depth), depth - 0.01f, 0), 1);
        if (depth > 0.99f) continue;
        EXPECT_EQ(shadowOfMoments(momentsOf(depth), depth + 0.01f), 0) << depth;
        EXPECT_EQ(shadowOfWarpedMoments(warpedMomentsOf(depth), depth + 0.01f, 0), 0) << depth;
    }
}

TEST(Moments, SlopesAreDerivativesOfTheDepth) {
    for (const float ratio : { 0.0f, 1e-6f, 1e-3f }) {
        for (const float share : { 0.1f, 0.4f, 0.9f }) {
            const float depth = ratio > 0 ? ratio / share : share, step = depth * 1e-2f;
            const float slope = (momentDepth(depth - step, ratio) - momentDepth(depth + step, ratio)) / (2 * step);
            EXPECT_NEAR(momentSlope(momentDepth(depth, ratio), ratio) / slope, 1, 2e-3f);
        }
    }
}

// Planes through any point of a filter, as steep as that they cross a fifth of the map in it.
TEST(Moments, PlanesDoNotDarkenThemselves) {
    for (float slope = 0; slope < 0.1f; slope += 0.005f) {
        for (float depth = -0.7f; depth < 0.7f; depth += 0.1f) {
            vec2 moments(0);
            vec4 warped(0);
            for (int i = -2; i <= 2; ++i) {
                const float weight = (3 - std::abs(static_cast<float>(i))) / 9;
                moments += momentsOf(depth + slope * static_cast<float>(i)) * weight;
                warped += warpedMomentsOf(depth + slope * static_cast<float>(i)) * weight;
            }
            EXPECT_EQ(shadowOfMoments(moments, depth), 1) << slope;
            EXPECT_EQ(shadowOfWarpedMoments(warped, depth, slope * slope * 8 / 6), 1) << slope << ' ' << depth;
        }
    }
}

TEST(Moments, WarpsFitIntoFloats) {
    for (const float depth : { -1.0f, 0.0f, 1.0f }) {
        const vec4 moments = warpedMomentsOf(depth);
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(moments[i]));
        EXPECT_GT(moments.x, 0);
        EXPECT_TRUE(std::isfinite(shadowOfWarpedMoments(moments, 1, 0)));
        EXPECT_TRUE(std::isfinite(shadowOfWarpedMoments(moments, -1, 1e30f)));
    }
}

} // namespace
} // namespace filament_core::shader::lib
