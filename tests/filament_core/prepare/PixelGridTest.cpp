// SPDX-License-Identifier: Apache-2.0
// Boxes of every size, beside centres of pixels and on them, in double precision: no box that misses all centres
// contains one, and most of those that contain none are found.
#include "filament_core/prepare/ViewConstants.h"

#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::prepare {
namespace {

struct Covered {
    double2 least{ 1e300 }, most{ -1e300 }; ///< pixels
};

Covered coveredBy(double4x4 const& clipFromWorld, double2 size, double3 center, double3 halfExtent) {
    Covered covered;
    for (int corner = 0; corner < 8; ++corner) {
        const double3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double4 clip = clipFromWorld * double4(center + sign * halfExtent, 1);
        const double2 pixel = (double2(clip) / clip.w * 0.5 + 0.5) * size;
        covered.least = glm::min(covered.least, pixel);
        covered.most = glm::max(covered.most, pixel);
    }
    return covered;
}

/// Of an interval: a centre of a pixel is in it, or within `margin` of it.
bool hasCenter(double least, double most, double margin) {
    return std::ceil(least - margin - 0.5) <= std::floor(most + margin - 0.5);
}

struct Tally {
    int missed = 0, small = 0;
};

Tally compare(ViewInput const& view, uint32_t seed, double farMeters) {
    const ViewSpace space = makeViewSpace(view);
    const double4x4 clip(space.clipFromWorld);
    Random random(seed);
    Tally tally;
    for (int i = 0; i < 20'000; ++i) {
        const double distance = std::exp(random.within(std::log(0.5), std::log(farMeters)));
        const float3 center(double3(random.within(-0.6, 0.6), random.within(-0.6, 0.6), -1) * distance);
        const double largest = distance * std::exp(random.within(-12, -4));
        const float3 halfExtent(double3(random.within(0, 1), random.within(0, 1), random.within(0, 1)) * largest);
        const Covered exact = coveredBy(clip, double2(view.size), double3(center), double3(halfExtent));
        const auto misses = [&](double margin) {
            return !hasCenter(exact.least.x, exact.most.x, margin) || !hasCenter(exact.least.y, exact.most.y, margin);
        };
        const bool isMissed = space.pixels.missesAll(center, halfExtent);
        EXPECT_TRUE(!isMissed || misses(1.0 / 256)) << center.x << ' ' << center.y << ' ' << center.z;
        const double2 pixels = exact.most - exact.least;
        const bool isSmall = std::max(pixels.x, pixels.y) < 0.9 && misses(1.0 / 32);
        tally.small += isSmall;
        tally.missed += isSmall && isMissed;
    }
    return tally;
}

/// Nearly all: a box close to two pixels along a diagonal is not tested.
void expectFound(Tally const& tally) { EXPECT_GE(tally.missed, 0.99 * tally.small) << "of " << tally.small; }

TEST(PixelGrid, BoxesThatMissAllCentresContainNone) {
    for (const uint2 size : { uint2(640, 480), uint2(1, 1), uint2(3840, 2160), uint2(17, 1999) }) {
        const Tally tally = compare({ .size = size }, size.x, 1e5);
        expectFound(tally);
        EXPECT_GT(tally.small, size.x > 1 ? 1000 : 0);
    }
}

TEST(PixelGrid, KnowsParallelLensesJitterAndGuardBands) {
    const Tally parallel = compare(
            { .camera = { .lens = Lens::orthographic(-40, 40, -30, 30, 0, 100) }, .size = { 640, 480 } }, 3, 90);
    expectFound(parallel);
    const Tally jittered = compare({ .size = { 640, 480 }, .jitterPixels = { 0.31f, -0.44f } }, 4, 1e4);
    expectFound(jittered);
    const Tally banded = compare({ .size = { 700, 540 }, .band = 30 }, 5, 1e4);
    expectFound(banded);
}

// Boxes are tested in groups of eight exactly where each alone would be.
TEST(PixelGrid, EightAreAskedAboutWhereOneIs) {
    const ViewSpace space = makeViewSpace({ .size = { 640, 480 } });
    Random random(9);
    for (int i = 0; i < 2000; ++i) {
        std::array<std::array<float, 8>, 6> columns;
        for (auto& column : columns) {
            for (float& value : column)
                value = static_cast<float>(random.within(-1, 1) * std::exp(random.within(-9, 3)));
        }
        std::array<simd::Float8, 3> center, halfExtent;
        for (size_t axis = 0; axis < 3; ++axis) {
            for (float& value : columns[3 + axis]) value = std::abs(value);
            center[axis] = simd::load8(columns[axis].data());
            halfExtent[axis] = simd::load8(columns[3 + axis].data());
        }
        const uint32_t asked = space.pixels.mayMiss8(center, halfExtent);
        for (size_t lane = 0; lane < 8; ++lane) {
            const float3 at(columns[0][lane], columns[1][lane], columns[2][lane]);
            const float3 half(columns[3][lane], columns[4][lane], columns[5][lane]);
            EXPECT_TRUE((asked >> lane & 1) != 0 || !space.pixels.missesAll(at, half));
        }
    }
}

TEST(PixelGrid, NothingMissesBehindTheCameraOrWithoutANumberOrInViewsOfManySamples) {
    const ViewSpace space = makeViewSpace({ .size = { 640, 480 } });
    const float3 tiny(1e-5f);
    EXPECT_TRUE(space.pixels.missesAll({ 0.01f, 0.013f, -10 }, tiny));
    EXPECT_FALSE(space.pixels.missesAll({ 0.01f, 0.013f, 10 }, tiny));
    EXPECT_FALSE(space.pixels.missesAll({ 0, 0, 0 }, tiny));
    const float nan = std::nanf("");
    EXPECT_FALSE(space.pixels.missesAll({ nan, 0.013f, -10 }, tiny));
    EXPECT_FALSE(space.pixels.missesAll({ 0.01f, 0.013f, -10 }, float3(nan)));
    EXPECT_FALSE(makeViewSpace({ .size = { 640, 480 }, .samples = 4 }).pixels.missesAll({ 0.01f, 0.013f, -10 }, tiny));
    EXPECT_FALSE(PixelGrid().missesAll({ 0.01f, 0.013f, -10 }, tiny));
}

} // namespace
} // namespace filament_core::prepare
