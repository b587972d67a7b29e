// SPDX-License-Identifier: Apache-2.0
// Numbers, choices and directions follow their densities.
#include "tests/tools/reference/TestScenes.h"

#include "tools/reference/DirectLights.h"
#include "tools/reference/EnvironmentLight.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <set>

namespace filament::reference {
namespace {

TEST(SampleStream, EveryElementaryIntervalOfSixteenSamplesHoldsOne) {
    for (uint64_t stream = 0; stream < 20; ++stream) {
        for (uint32_t dimension = 0; dimension < 5; ++dimension) {
            std::set<int> tall, square, wide;
            for (uint32_t i = 0; i < 16; ++i) {
                const double2 u = SampleStream(mixBits(stream), i).pair(dimension);
                ASSERT_TRUE(u.x > 0 && u.x < 1 && u.y > 0 && u.y < 1);
                tall.insert(static_cast<int>(u.x * 16));
                square.insert(static_cast<int>(u.x * 4) * 4 + static_cast<int>(u.y * 4));
                wide.insert(static_cast<int>(u.y * 16));
            }
            EXPECT_EQ(tall.size(), 16u);
            EXPECT_EQ(square.size(), 16u);
            EXPECT_EQ(wide.size(), 16u);
        }
    }
}

TEST(SampleStream, DimensionsAndStreamsAreNotCorrelated) {
    constexpr uint32_t kCount = 4096;
    const SampleStream* previous = nullptr;
    ASSERT_EQ(previous, nullptr);
    double withinPair = 0, betweenPairs = 0, betweenStreams = 0;
    for (uint32_t i = 0; i < kCount; ++i) {
        const double2 a = SampleStream(1, i).pair(0) - 0.5, b = SampleStream(1, i).pair(1) - 0.5;
        const double2 c = SampleStream(2, i).pair(0) - 0.5;
        withinPair += a.x * a.y;
        betweenPairs += a.x * b.x;
        betweenStreams += a.x * c.x;
    }
    const double deviation = 1 / (12 * std::sqrt(double(kCount))); // of the mean of independent products
    EXPECT_LT(std::abs(withinPair / kCount), 4 * deviation);
    EXPECT_LT(std::abs(betweenPairs / kCount), 4 * deviation);
    EXPECT_LT(std::abs(betweenStreams / kCount), 4 * deviation);
}

TEST(Distribution, PicksInProportionAndNeverWhatHasNoWeight) {
    const double weights[] = { 0, 3, 0, 0, 1, 4, 0 };
    const Distribution distribution(weights);
    std::array<int, 7> counts{};
    constexpr int kCount = 8000;
    for (int i = 0; i < kCount; ++i) {
        const Picked picked = distribution.pick((i + 0.5) / kCount);
        ++counts[picked.index];
        EXPECT_EQ(picked.probability, weights[picked.index] / 8);
        EXPECT_TRUE(picked.remainder >= 0 && picked.remainder < 1);
    }
    for (size_t i = 0; i < counts.size(); ++i) EXPECT_NEAR(counts[i], weights[i] * kCount / 8, 1) << i;
    EXPECT_EQ(distribution.pick(0).index, 1u);
    EXPECT_EQ(distribution.pick(1 - 0x1p-53).index, 5u);
}

TEST(Distribution, WithoutAnyWeightEverythingIsEquallyLikely) {
    const double weights[] = { 0, 0, 0, 0 };
    const Distribution distribution(weights);
    EXPECT_EQ(distribution.pick(0.6).index, 2u);
    EXPECT_EQ(distribution.pick(0.6).probability, 0.25);
}

/// A small lamp and a coloured glow.
EnvironmentLight lampSky(double rotation = 0) {
    const auto sky = [](double3 d) {
        const double3 lamp = glm::normalize(double3(0.3, 0.4, 0.8));
        return float3(double3(0.2, 0.3, 0.1) * (1 + d.y) + double3(glm::dot(d, lamp) > 0.99 ? 200.0 : 0.0));
    };
    return EnvironmentLight(makeSky(32, sky), 2, rotation);
}

double3 directionOf(double u, double v) {
    const double y = 1 - 2 * v, radius = std::sqrt(1 - y * y), phi = 2 * kPiExact * u;
    return { radius * std::sin(phi), y, radius * std::cos(phi) };
}

TEST(EnvironmentLight, ItsDensityIntegratesToOneOverTheSphere) {
    const EnvironmentLight light = lampSky(0.4);
    constexpr int kSteps = 1000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) sum += light.pdf(directionOf((i + 0.5) / kSteps, (j + 0.5) / kSteps));
    }
    EXPECT_NEAR(sum * 4 * kPiExact / (kSteps * kSteps), 1, 3e-3);
}

TEST(EnvironmentLight, SamplesCarryTheDensityAndTheRadianceOfTheirDirection) {
    const EnvironmentLight light = lampSky(-1.1);
    for (uint32_t i = 0; i < 2000; ++i) {
        const EnvironmentSample sample = light.sample(SampleStream(3, i).pair(0));
        EXPECT_NEAR(glm::length(sample.direction), 1, 1e-12);
        EXPECT_NEAR(light.pdf(sample.direction), sample.pdf, 1e-9 * sample.pdf) << i;
        EXPECT_EQ(light.radiance(sample.direction), sample.radiance);
    }
}

TEST(EnvironmentLight, ItsSamplesIntegrateTheSkyWithLittleNoise) {
    const EnvironmentLight light = lampSky();
    constexpr int kSteps = 1500;
    double3 exact(0.0), estimate(0.0);
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) exact += light.radiance(directionOf((i + 0.5) / kSteps, (j + 0.5) / kSteps));
    }
    exact *= 4 * kPiExact / (double(kSteps) * kSteps);
    constexpr uint32_t kCount = 4096;
    for (uint32_t i = 0; i < kCount; ++i) {
        const EnvironmentSample sample = light.sample(SampleStream(4, i).pair(0));
        estimate += sample.radiance / sample.pdf / double(kCount);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(estimate[c], exact[c], 5e-3 * exact[c]);
}

TEST(EnvironmentLight, CellsOfALargePictureShareTheirPixels) {
    const auto image = std::make_shared<assets::HdrImage>();
    image->width = 5000; // more than there are cells
    image->height = 10;
    image->pixels.assign(50000, float3(0.5f));
    image->at(4999, 3) = float3(1e6f);
    const EnvironmentLight light(image, 1, 0);
    double mean = 0;
    constexpr uint32_t kCount = 4096;
    for (uint32_t i = 0; i < kCount; ++i) {
        const EnvironmentSample sample = light.sample(SampleStream(4, i).pair(0));
        ASSERT_GT(sample.pdf, 0);
        mean += sample.radiance.x / sample.pdf / kCount;
    }
    const double solidAngle = 2 * kPiExact / 5000 * (std::cos(0.3 * kPiExact) - std::cos(0.4 * kPiExact));
    const double expected = 4 * kPiExact * 0.5 + 1e6 * solidAngle;
    EXPECT_NEAR(mean, expected, 0.03 * expected);
}

TEST(EnvironmentLight, StandsWhereTheEngineHasIt) {
    // One bright pixel; <filament/Environment.h>: u = 0.5 - atan2(x, z) / 2 pi, v = acos(y) / pi.
    auto image = makeSky(64, [](double3) { return float3(0.0f); });
    auto writable = std::const_pointer_cast<assets::HdrImage>(std::shared_ptr<const assets::HdrImage>(image));
    writable->at(40, 20) = float3(1.0f);
    const double u = 40.5 / 128, v = 20.5 / 64;
    const double azimuth = (0.5 - u) * 2 * kPiExact, polar = v * kPiExact;
    const double3 d(std::sin(azimuth) * std::sin(polar), std::cos(polar), std::cos(azimuth) * std::sin(polar));
    EXPECT_NEAR(EnvironmentLight(image, 1, 0).radiance(d).x, 1, 1e-9);
    // Turned by +90 degrees around +Y, what was at +z is at +x.
    const double3 turned(d.z, d.y, -d.x);
    EXPECT_NEAR(EnvironmentLight(image, 1, kPiExact / 2).radiance(turned).x, 1, 1e-9);
    EXPECT_NEAR(EnvironmentLight(image, 1, kPiExact / 2).radiance(d).x, 0, 1e-9);
}

TEST(DirectLights, ALightThatDoesNotReachAPointIsNeverChosenThere) {
    const std::vector<PointLight> points{
        { .positionWorld = { 0, 1, 0 }, .intensity = Candela{ 1 } },
        { .positionWorld = { 0, 1, 0 }, .intensity = Candela{ 1e6f }, .rangeMeters = 0.5f }
    };
    const DirectLights lights({}, points, {}, 1);
    for (int i = 0; i < 100; ++i) {
        const DirectSample sample = lights.sample({ 0, 0, 0 }, (i + 0.5) / 100);
        EXPECT_NEAR(sample.illuminance.x, 1, 1e-12);
        EXPECT_EQ(sample.distance, 1);
    }
}

TEST(DirectLights, WhereNoLightArrivesThereIsNone) {
    const DirectLights lights(
            {},
            { { .positionWorld = { 0, 9, 0 }, .rangeMeters = 1 }, { .positionWorld = { 0, 8, 0 }, .rangeMeters = 1 } },
            {}, 1);
    EXPECT_EQ(lights.sample({ 0, 0, 0 }, 0.5).illuminance, double3(0.0));
    EXPECT_TRUE(DirectLights().empty());
}

} // namespace
} // namespace filament::reference
