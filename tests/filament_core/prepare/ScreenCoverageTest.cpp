// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ScreenCoverage.h"

#include <filament_core/Camera.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kPi = std::numbers::pi;

CoverageLens lensAt(double3 eye, Lens const& lens, float aspect = 1) {
    const Camera camera = Camera::lookAt(eye, eye + double3(0, 0, -1), lens);
    return coverageLens(camera.position(), camera.clipFromView(aspect));
}

TEST(ScreenCoverage, OfAPerspectiveLensFallsWithTheSquareOfTheDistance) {
    const CoverageLens lens = lensAt({ 0, 0, 10 }, { .verticalFovDegrees = 90 }, 2); // 4 m x 2 m at 1 m
    EXPECT_NEAR(screenCoverage(lens, double3(0.0), 1), kPi / 8 / 100, 1e-8);
    EXPECT_NEAR(screenCoverage(lens, { 0, 0, -10 }, 1), kPi / 8 / 400, 1e-8);
    EXPECT_NEAR(screenCoverage(lens, { 0, 10, 10 }, 1), kPi / 8 / 100, 1e-8) << "out of view, and as far away";
}

TEST(ScreenCoverage, OfAParallelLensIsThatOfTheDisc) {
    const CoverageLens lens = lensAt({ 0, 0, 10 }, { .orthographicHeight = 4 }, 2); // 8 m x 4 m
    EXPECT_NEAR(screenCoverage(lens, double3(0.0), 1), kPi / 32, 1e-8);
    EXPECT_NEAR(screenCoverage(lens, { 3, 4, -500 }, 1), kPi / 32, 1e-8);
    EXPECT_NEAR(screenCoverage(lens, { 0, 0, 10 }, 1), kPi / 32, 1e-8) << "the camera has no place in it";
}

TEST(ScreenCoverage, IsDefinedEverywhere) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (Lens const& lens : { Lens{}, Lens{ .orthographicHeight = 3 } }) {
        const CoverageLens at = lensAt(double3(0.0), lens);
        EXPECT_EQ(screenCoverage(at, { 0, 0, -5 }, 0), 0);
        EXPECT_EQ(screenCoverage(at, double3(0.0), 0), 0) << "a point at the eye";
        EXPECT_EQ(screenCoverage(at, { 0, 0, -5 }, nan), kInfinity);
        EXPECT_EQ(screenCoverage(at, { 0, 0, -5 }, kInfinity), kInfinity);
        EXPECT_EQ(screenCoverage(at, { 0, 0, -5 }, 1e300), kInfinity);
        EXPECT_GE(screenCoverage(at, { 0, 0, -5 }, 1e-200), 0);
    }
    const CoverageLens perspective = lensAt(double3(0.0), {});
    EXPECT_EQ(screenCoverage(perspective, { 0, nan, 0 }, 1), kInfinity);
    EXPECT_EQ(screenCoverage(perspective, { 0, 0, -1 }, 1), kInfinity) << "the eye is on the sphere";
    EXPECT_EQ(screenCoverage(perspective, { 0, 0, 0.5 }, 1), kInfinity);
    EXPECT_EQ(screenCoverage(perspective, { 0, 0, -1e200 }, 1), 0);
}

TEST(ScreenCoverage, RangesOfLevelsPartitionAllCoverages) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-50, 50), size(0, 20), share(0, 1);
    std::uniform_real_distribution<float> fov(5, 150);
    for (int trial = 0; trial < 2000; ++trial) {
        const CoverageLens lens =
                lensAt({ place(random), place(random), place(random) }, { .verticalFovDegrees = fov(random) }, 1.5f);
        const double coverage = screenCoverage(lens, { place(random), place(random), place(random) }, size(random));
        std::vector<double> least{ share(random), share(random), share(random), 0 };
        std::ranges::sort(least, std::greater{});
        if (trial % 4 == 0) least[1] = least[2]; // a level that is never drawn
        uint32_t drawn = 0;
        for (size_t i = 0; i < least.size(); ++i) {
            const bool isDrawn = coverage >= least[i] && (i == 0 || coverage < least[i - 1]);
            EXPECT_EQ(levelFor(least, coverage) == i, isDrawn);
            drawn += isDrawn;
        }
        EXPECT_EQ(drawn, 1u);
    }
}

TEST(ScreenCoverage, BoundariesBelongToTheFinerLevel) {
    const double least[] = { 0.5, 0.1, 0.01 };
    EXPECT_EQ(levelFor(least, 0.5), 0u);
    EXPECT_EQ(levelFor(least, std::nextafter(0.5, 0)), 1u);
    EXPECT_EQ(levelFor(least, kInfinity), 0u);
    EXPECT_EQ(levelFor(least, 0.01), 2u);
    EXPECT_EQ(levelFor(least, 0), 3u) << "too small to be drawn";
    EXPECT_EQ(levelFor({}, 1), 0u);
}

} // namespace
} // namespace filament_core::prepare
