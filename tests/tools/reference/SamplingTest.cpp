// SPDX-License-Identifier: Apache-2.0
// Numbers, choices and directions follow their densities.
#include "tests/tools/reference/TestScenes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectLights.h"
#include "tools/reference/EnvironmentLight.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <set>

namespace filament_core::reference {
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
    // One bright pixel; <filament_core/Environment.h>: u = 0.5 - atan2(x, z) / 2 pi, v = acos(y) / pi.
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
    const DirectLights lights({ .points = points }, 1);
    for (int i = 0; i < 100; ++i) {
        const DirectSample sample = lights.sample({ 0, 0, 0 }, (i + 0.5) / 100);
        EXPECT_NEAR(sample.illuminance.x, 1, 1e-12);
        EXPECT_EQ(sample.distance, 1);
    }
}

TEST(DirectLights, WhereNoLightArrivesThereIsNone) {
    const DirectLights lights({ .points = { { .positionWorld = { 0, 9, 0 }, .rangeMeters = 1 },
                                            { .positionWorld = { 0, 8, 0 }, .rangeMeters = 1 } } },
                              1);
    EXPECT_EQ(lights.sample({ 0, 0, 0 }, 0.5).illuminance, double3(0.0));
    EXPECT_TRUE(DirectLights().empty());
}

/// The mean irradiance on a plane at the origin over many samples of both choices.
double3 meanIrradiance(LightSet const& set, double3 normal) {
    const DirectLights lights(set, 1);
    constexpr int kSteps = 64, kChoices = 7;
    double3 sum(0.0);
    for (int i = 0; i < kSteps * kSteps * kChoices; ++i) {
        const int x = i % kSteps, y = i / kSteps % kSteps, choice = i / (kSteps * kSteps);
        const DirectSample sample =
                lights.sample(double3(0.0), (choice + 0.5) / kChoices, { (x + 0.5) / kSteps, (y + 0.5) / kSteps });
        sum += sample.illuminance * std::max(glm::dot(sample.direction, normal), 0.0);
    }
    return sum / double(kSteps * kSteps * kChoices);
}

// A ray meets the nearest drawn area from a side that shines, within its range of distances.
TEST(DirectLights, AreSeenOnlyWhereTheyAreDrawnAndShine) {
    RectLight rect{ .positionWorld = { 0, 2, 0 },
                    .directionWorld = { 0, -1, 0 },
                    .upWorld = { 0, 0, 1 },
                    .widthMeters = 1,
                    .heightMeters = 0.5f,
                    .luminance = Nits{ 3 } };
    const auto seen = [](LightSet const& set, double3 origin, double3 direction, double farthest = 10) {
        return DirectLights(set, 2).seenArea(origin, direction, 0, farthest);
    };
    const double3 up(0, 1, 0);
    EXPECT_FALSE(seen({ .rects = { rect } }, {}, up)) << "by default";
    rect.isVisible = true;
    ASSERT_TRUE(seen({ .rects = { rect } }, { 0.49, 0, 0.24 }, up));
    EXPECT_EQ(seen({ .rects = { rect } }, {}, up)->distance, 2);
    EXPECT_EQ(seen({ .rects = { rect } }, {}, up)->luminance, double3(6));
    EXPECT_FALSE(seen({ .rects = { rect } }, { 0.51, 0, 0 }, up));
    EXPECT_FALSE(seen({ .rects = { rect } }, { 0, 0, 0.26 }, up));
    EXPECT_FALSE(seen({ .rects = { rect } }, {}, up, 1.9)) << "behind a surface";
    EXPECT_FALSE(seen({ .rects = { rect } }, { 0, 3, 0 }, -up)) << "from behind";
    rect.isTwoSided = true;
    EXPECT_TRUE(seen({ .rects = { rect } }, { 0, 3, 0 }, -up));
    const TubeLight tube{ .positionWorld = { 0, 1, 0 },
                          .axisWorld = { 1, 0, 0 },
                          .lengthMeters = 1,
                          .radiusMeters = 0.25f,
                          .luminance = Nits{ 5 },
                          .isVisible = true };
    const auto nearest = seen({ .rects = { rect }, .tubes = { tube } }, {}, up);
    ASSERT_TRUE(nearest);
    EXPECT_EQ(nearest->distance, 0.75);
    EXPECT_EQ(nearest->luminance, double3(10));
    EXPECT_FALSE(seen({ .tubes = { tube } }, {}, { 0.7, 0.7, 0 })) << "beyond its end";
    const DiscLight disc{
        .positionWorld = { 0, 2, 0 }, .directionWorld = { 0, -1, 0 }, .radiusMeters = 0.5f, .isVisible = true
    };
    EXPECT_TRUE(seen({ .discs = { disc } }, { 0.35, 0, 0.35 }, up));
    EXPECT_FALSE(seen({ .discs = { disc } }, { 0.36, 0, 0.36 }, up));
}

// pi L sin^2 of the angle of its rim.
TEST(DirectLights, ADiscGivesTheIrradianceOfItsClosedForm) {
    for (const float radius : { 0.1f, 1.0f, 4.0f }) {
        const DiscLight disc{
            .positionWorld = { 0, 2, 0 }, .directionWorld = { 0, -1, 0 }, .radiusMeters = radius, .luminance = Nits{ 3 }
        };
        const double expected = 3 * kPiExact * radius * radius / (radius * radius + 4);
        EXPECT_NEAR(meanIrradiance({ .discs = { disc } }, { 0, 1, 0 }).x, expected, 2e-3 * expected) << radius;
        DiscLight away = disc;
        away.directionWorld = { 0, 1, 0 };
        EXPECT_EQ(meanIrradiance({ .discs = { away } }, { 0, 1, 0 }).x, 0);
        away.isTwoSided = true;
        EXPECT_NEAR(meanIrradiance({ .discs = { away } }, { 0, 1, 0 }).x, expected, 2e-3 * expected);
    }
}

// The engine's own integral, in double precision.
TEST(DirectLights, ARectangleGivesTheIrradianceOfItsPolygon) {
    const RectLight rect{ .positionWorld = { 0.5, 1, -0.2 },
                          .directionWorld = { -0.3f, -1, 0.2f },
                          .upWorld = { 1, 0, 0 },
                          .widthMeters = 1.5f,
                          .heightMeters = 0.7f,
                          .luminance = Nits{ 2 } };
    const double3 axis = glm::normalize(double3(rect.directionWorld));
    const double3 up = glm::normalize(double3(1, 0, 0) - axis * axis.x), side = glm::cross(axis, up);
    const auto local = [](double3 v) { return shader::lib64::vec3(v.z, v.x, v.y); }; // y is the normal
    const shader::lib64::vec3 integral =
            shader::lib64::areaIntegral(local(rect.positionWorld), local(side * 0.75), local(up * 0.35), false);
    EXPECT_NEAR(meanIrradiance({ .rects = { rect } }, { 0, 1, 0 }).x, 2 * integral.z, 1e-3);
}

TEST(DirectLights, ALongTubeGivesTheIrradianceOfItsClosedForm) {
    const TubeLight tube{ .positionWorld = { 0, 2, 0 },
                          .axisWorld = { 1, 0, 0 },
                          .lengthMeters = 24,
                          .radiusMeters = 0.5f,
                          .luminance = Nits{ 5 } };
    // Of an endless strip between two planes at angles -a and a from the normal: pi L sin(a).
    EXPECT_NEAR(meanIrradiance({ .tubes = { tube } }, { 0, 1, 0 }).x, 5 * kPiExact * 0.25, 0.08);
}

TEST(DirectLights, AmongSeveralLightsTheMeanIsTheirSum) {
    const LightSet both{ .points = { { .positionWorld = { 0, 2, 0 }, .intensity = Candela{ 8 } } },
                         .discs = { { .positionWorld = { 0, 2, 0 },
                                      .directionWorld = { 0, -1, 0 },
                                      .radiusMeters = 1,
                                      .luminance = Nits{ 3 } } } };
    EXPECT_NEAR(meanIrradiance(both, { 0, 1, 0 }).x, 2 + 3 * kPiExact / 5, 0.15);
}

} // namespace
} // namespace filament_core::reference
