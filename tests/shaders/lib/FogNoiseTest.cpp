// SPDX-License-Identifier: Apache-2.0
// fog_noise.glsl: the noise by which the density of fog varies.
#include "shaders/lib/LibCpp.h"
#include "shaders/lib/LibCppDouble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::shader {
namespace {

constexpr double kSpread[] = { 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 }; // Roberts 2018

/// check(place) for places that cover the lattice evenly.
template <class Check>
void forPlaces(int count, Check const& check) {
    for (int i = 0; i < count; ++i) {
        glm::dvec3 place(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const double at = kSpread[axis] * i + 0.31;
            place[axis] = 256 * (at - std::floor(at));
        }
        check(place);
    }
}

TEST(FogNoise, EveryBitOfTheHashDependsOnEveryOther) {
    for (uint32_t bit = 0; bit < 32; ++bit) {
        std::array<int, 32> flips{};
        for (uint32_t i = 0; i < 4096; ++i) {
            const uint32_t x = i * 2654435761u;
            const uint32_t changed = lib::hashBits(x) ^ lib::hashBits(x ^ (1u << bit));
            for (uint32_t other = 0; other < 32; ++other) flips[other] += static_cast<int>(changed >> other & 1);
        }
        for (const int count : flips) EXPECT_NEAR(count, 2048, 250) << bit;
    }
}

TEST(FogNoise, HasMeanZeroAndStaysWithinOne) {
    for (const double octaves : { 1.0, 2.0, 4.0 }) {
        double sum = 0, squares = 0, least = 0, most = 0;
        constexpr int kCount = 200'000;
        forPlaces(kCount, [&](glm::dvec3 place) {
            const double noise = lib64::fogNoise(place, octaves, 0.0);
            sum += noise, squares += noise * noise;
            least = std::min(least, noise), most = std::max(most, noise);
        });
        EXPECT_NEAR(sum / kCount, 0, 2e-3) << octaves;
        EXPECT_GT(squares / kCount, 0.015) << octaves;
        EXPECT_GE(least, -1);
        EXPECT_LT(most, 1);
    }
}

TEST(FogNoise, RepeatsAfterItsPeriodOnBothSidesOfTheOrigin) {
    forPlaces(500, [](glm::dvec3 place) {
        const double noise = lib64::fogNoise(place, 4.0, 0.0);
        for (const glm::dvec3 moved : { glm::dvec3(256, 0, 0), glm::dvec3(0, -256, 512), glm::dvec3(-512, -256, -256) })
            EXPECT_NEAR(lib64::fogNoise(place + moved, 4.0, 0.0), noise, 1e-9);
        EXPECT_NE(lib64::fogNoise(place + glm::dvec3(128, 0, 0), 4.0, 0.0), noise);
    });
}

TEST(FogNoise, HasNoStepsBetweenCells) {
    for (int i = 0; i < 200; ++i) {
        const auto at = static_cast<double>(i);
        const glm::dvec3 before(at - 1e-7, 0.37 + at, 1.71 * at), behind(at + 1e-7, 0.37 + at, 1.71 * at);
        EXPECT_NEAR(lib64::latticeNoise(before, 255u, 0u), lib64::latticeNoise(behind, 255u, 0u), 1e-6);
    }
}

TEST(FogNoise, FadesWhereSwirlsAreNarrowerThanSamples) {
    forPlaces(200, [](glm::dvec3 place) {
        EXPECT_EQ(lib64::fogNoise(place, 1.0, 1.0), 0);
        EXPECT_EQ(lib64::fogNoise(place, 4.0, 1.0), 0);
        EXPECT_EQ(lib64::fogNoise(place, 1.0, 0.5), lib64::fogNoise(place, 1.0, 0.0));
        // Of two octaves the narrower one is gone; the wider one has the share that it had.
        EXPECT_NEAR(lib64::fogNoise(place, 2.0, 0.5), lib64::fogNoise(place, 1.0, 0.0) / 1.5, 1e-12);
    });
}

/// Numbers of integers: what floats round is the place.
TEST(FogNoise, IsTheSameInFloatsAndDoublesAtPointsOfTheLattice) {
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 place(static_cast<float>(i % 17), static_cast<float>(i % 29), static_cast<float>(i));
        EXPECT_EQ(static_cast<double>(lib::latticeNoise(place, 255u, 1u)),
                  lib64::latticeNoise(glm::dvec3(place), 255u, 1u));
    }
}

} // namespace
} // namespace filament_core::shader
