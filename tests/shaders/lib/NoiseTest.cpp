// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace filament_core::shader::lib {
namespace {

TEST(Noise, GradientNoiseIsUniformAndDiffersBetweenNeighbours) {
    std::array<int, 10> histogram{};
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 100; ++x) {
            const vec2 pixel(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            const float noise = interleavedGradientNoise(pixel);
            ASSERT_TRUE(noise >= 0 && noise < 1);
            ++histogram[static_cast<size_t>(noise * 10)];
            EXPECT_GT(std::fabs(noise - interleavedGradientNoise(pixel + vec2(1, 0))), 0.05f);
        }
    }
    for (const int count : histogram) EXPECT_NEAR(count, 1000, 100);
}

TEST(Noise, DirectionsGoOnceAroundAndAreUnit) {
    constexpr int kSteps = 4096;
    float before = -1;
    for (int i = 0; i < kSteps; ++i) {
        const vec2 axis = directionOfTurn(static_cast<float>(i) / kSteps);
        EXPECT_NEAR(length(axis), 1, 3e-7f);
        const float angle = std::atan2(axis.y, axis.x);
        const float turn = (angle < 0 ? angle + 2 * kPi : angle) / (2 * kPi);
        EXPECT_GT(turn, before) << i;
        EXPECT_NEAR(turn, static_cast<float>(i) / kSteps, 0.025f) << "nearly even";
        before = turn;
    }
}

} // namespace
} // namespace filament_core::shader::lib
