// SPDX-License-Identifier: Apache-2.0
// Boxes of reflection probes: weights, and where mirrored rays leave a box, against points that are on its walls by
// construction.
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace filament_core::shader {
namespace {

const glm::vec3 kHalf(3, 1.5f, 2);

TEST(Probes, AWeightIsOneInTheBoxAndOnItsFacesAndZeroFromTheBlendDistanceOn) {
    EXPECT_EQ(lib::probeWeight(glm::vec3(0), kHalf, 2), 1);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : { -1.0f, 1.0f }) {
            const auto weightAt = [&](float outside) {
                glm::vec3 point(0);
                point[axis] = side * (kHalf[axis] + outside);
                return lib::probeWeight(point, kHalf, 2); // a blend of half a metre
            };
            EXPECT_EQ(weightAt(-0.5f), 1);
            EXPECT_EQ(weightAt(0), 1);
            EXPECT_NEAR(weightAt(0.25f), 0.5, 1e-6);
            EXPECT_EQ(weightAt(0.5f), 0);
            EXPECT_EQ(weightAt(1e6f), 0);
        }
    }
}

TEST(Probes, BesideACornerTheFartherFaceCounts) {
    EXPECT_NEAR(lib::probeWeight({ 3.1f, 1.9f, -1.8f }, kHalf, 2), 0.2, 1e-6);
}

TEST(Probes, ABoxWithoutAnInsideIsItsMiddle) {
    EXPECT_EQ(lib::probeWeight(glm::vec3(0), glm::vec3(0), 1e6f), 1);
    EXPECT_EQ(lib::probeWeight({ 0, 0.1f, 0 }, { 1, 0, 1 }, 1e6f), 0);
}

TEST(Probes, SharesOfTwoBoxesNeverAddUpToMoreThanOne) {
    for (int i = -200; i <= 200; ++i) {
        const float x = 0.01f * static_cast<float>(i); // boxes of 3 m beside each other, a blend of 1 m
        const float first = lib::probeWeight({ x + 1.5f, 0, 0 }, { 1.5f, 9, 9 }, 1);
        const float second = lib::probeWeight({ x - 1.5f, 0, 0 }, { 1.5f, 9, 9 }, 1);
        const float share = lib::probeShare(first, 1);
        ASSERT_NEAR(share + lib::probeShare(second, 1 - share), 1, 1e-5) << x << ": one of them is around the point";
    }
}

TEST(Probes, TheInnerOfTwoBoxesTakesAllAndTheOuterTheRest) {
    EXPECT_EQ(lib::probeShare(1, 1), 1);
    EXPECT_EQ(lib::probeShare(1, 0), 0);
    EXPECT_EQ(lib::probeShare(0.25f, 1), 0.25f);
    EXPECT_EQ(lib::probeShare(1, 0.75f), 0.75f);
}

TEST(Probes, RaysEndOnTheWallThatTheyMeetFirst) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 from = kHalf * glm::vec3(unit(random), unit(random), unit(random));
        glm::vec3 wall = kHalf * glm::vec3(unit(random), unit(random), unit(random));
        const int axis = i % 3;
        wall[axis] = i % 2 ? kHalf[axis] : -kHalf[axis];
        const float distance = glm::length(wall - from);
        if (distance < 0.1f || std::abs(wall[axis] - from[axis]) < 0.01f) continue;
        const glm::vec3 direction = (wall - from) / distance;
        const float length = lib::probeRayLength(from, direction, kHalf);
        ASSERT_NEAR(length, distance, 2e-4) << i;
        const glm::vec3 to = lib::probeDirection(from - glm::vec3(0.3f, 0.2f, 0.1f), direction, length);
        ASSERT_LT(glm::length(to + glm::vec3(0.3f, 0.2f, 0.1f) - wall), 4e-4f) << i;
    }
}

TEST(Probes, ComponentsOfZeroMeetNoWall) {
    EXPECT_FLOAT_EQ(lib::probeRayLength({ 1, 0, 0 }, { 1, 0, 0 }, kHalf), 2);
    EXPECT_FLOAT_EQ(lib::probeRayLength({ 1, 0, 0 }, { -1, 0, -0.0f }, kHalf), 4);
    EXPECT_FLOAT_EQ(lib::probeRayLength({ 1, 1, 1 }, { 0, 0, 1 }, kHalf), 1);
}

TEST(Probes, RaysFromOutsideStayWhereTheyAre) {
    EXPECT_EQ(lib::probeRayLength({ 1e6f, 0, 0 }, { 1, 0, 0 }, kHalf), 0);
    EXPECT_EQ(lib::probeRayLength(glm::vec3(0), { 0, 1, 0 }, glm::vec3(0)), 0);
    EXPECT_EQ(lib::probeRayLength({ 3, 0, 0 }, { 1, 0, 0 }, kHalf), 0) << "on the face";
}

TEST(Probes, TheEnvironmentAroundEverythingIsSeenInTheDirectionOfTheRay) {
    const glm::vec3 everywhere(1e30f);
    EXPECT_EQ(lib::probeWeight({ 1e6f, -1e6f, 0 }, everywhere, 1), 1);
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 direction(unit(random), unit(random), unit(random)),
                from = 1e6f * glm::vec3(direction.z, direction.x, direction.y);
        const glm::vec3 to =
                lib::probeDirection(from, direction, lib::probeRayLength(from, direction, everywhere)) * 1e-30f;
        ASSERT_TRUE(std::isfinite(to.x + to.y + to.z)) << i;
        const float largest = std::max({ std::abs(direction.x), std::abs(direction.y), std::abs(direction.z) });
        ASSERT_LT(glm::length(to - direction / largest), 1e-6f) << i;
    }
}

} // namespace
} // namespace filament_core::shader
