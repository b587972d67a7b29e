// SPDX-License-Identifier: Apache-2.0
// Glowing triangles as lights: their solid angle, their light, and agreement of all techniques that find them.
#include "tests/tools/reference/TestScenes.h"

#include "tools/reference/EmissiveLights.h"

#include <random>

namespace filament_core::reference {
namespace {

assets::MaterialData lamp(float radiance) {
    assets::MaterialData material = lambert(0);
    material.emissiveFactor = float3(1);
    material.emissiveStrength = radiance;
    material.doubleSided = true;
    return material;
}

/// Only Lambert's lobe.
const BsdfModel kLambert{ .coupling = CouplingTerm::Never, .lobes = LobeChoice::Diffuse };

/// A floor of albedo 0.5 and a square lamp of side 2 * `half` one metre above its middle.
ReferenceScene lampOverFloor(double half, float radiance) {
    ReferenceScene scene;
    scene.models.push_back({ makeModel(floorPrimitive(), lambert(0.5f)) });
    double4x4 place(half);
    place[3] = double4(0, 1, 0, 1);
    scene.models.push_back({ makeModel(floorPrimitive(), lamp(radiance)), place });
    return scene;
}

/// The middle of the floor.
ReferenceView floorView() { return viewFrom({ 0.6, 0.5, 0 }, { 0, 0, 0 }, { 4, 4 }, 0.2f); }

Estimate floorUnder(ReferenceScene const& scene, Sampling sampling, uint32_t samples = 1024) {
    return estimated(scene, floorView(),
                     { .samplesPerPixel = samples, .maxBounces = 1, .sampling = sampling, .bsdf = kLambert });
}

// Per unit radiance, from a point h below the middle of a square of half side a: Howell, "A Catalog of Radiation Heat
// Transfer Configuration Factors", B-4, four times a corner.
double formFactorOfSquare(double a, double h) {
    const double x = a / h, root = std::sqrt(1 + x * x);
    return 4 / (2 * kPiExact) * 2 * (x / root * std::atan(x / root));
}

TEST(EmissiveLights, AFloorGetsTheFormFactorOfTheLampHoweverItIsFound) {
    const double half = 0.4;
    const double expected = 0.5 * 20 * formFactorOfSquare(half, 1);
    for (const Sampling sampling : { Sampling::Both, Sampling::Light, Sampling::Bsdf }) {
        const Estimate estimate = floorUnder(lampOverFloor(half, 20), sampling);
        expectAgrees(estimate, double3(expected), 0.002 * expected);
    }
}

// A node may scale a lamp beyond the floats; its area is then no weight.
TEST(EmissiveLights, ALampOfInfiniteAreaIsNoLight) {
    jobs::JobSystem jobs({ .workers = 0 });
    for (const double half : { 1e20, 1e30, 1e38, 1e100, 1e200 })
        EXPECT_TRUE(prepare(lampOverFloor(half, 3e38f), jobs).ok()) << half;
}

TEST(EmissiveLights, ASmallLampIsFoundWithATenthOfTheNoise) {
    const ReferenceScene scene = lampOverFloor(0.05, 1000);
    const Estimate both = floorUnder(scene, Sampling::Both), chance = floorUnder(scene, Sampling::Bsdf);
    EXPECT_LT(both.error.x, 0.1 * chance.error.x);
    expectAgrees(both, chance.mean, 4 * chance.error.x);
    expectAgrees(both, double3(0.5 * 1000 * formFactorOfSquare(0.05, 1)), 0.5);
}

TEST(EmissiveLights, TheMeanOfOneOverTheDensityIsTheSolidAngle) {
    assets::MaterialData material = lamp(3);
    const auto model = makeModel(floorPrimitive(), material);
    std::vector<Part> parts{ makePart(model->meshes[0].primitives[0], double4x4(1.0), double3(0.0)) };
    parts[0].material = &model->materials[0];
    parts[0].images = &model->images;
    const EmissiveLights lights(parts);
    ASSERT_FALSE(lights.empty());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    double mean = 0;
    constexpr int kSamples = 100'000;
    for (int i = 0; i < kSamples; ++i) {
        const EmissiveSample sample = lights.sample({ 0, 2, 0 }, { uniform(random), uniform(random) }, uniform(random));
        ASSERT_GT(sample.pdf, 0);
        EXPECT_EQ(sample.radiance, double3(3));
        mean += 1 / sample.pdf / kSamples;
    }
    const double solidAngle = 4 * std::asin(1 / (1 + 4.0)); // of a square of half side 1 from 2 above its middle
    EXPECT_NEAR(mean, solidAngle, 0.005 * solidAngle);
}

TEST(EmissiveLights, WhatDoesNotGlowIsNoLight) {
    const auto model = makeModel(floorPrimitive(), lambert(1));
    std::vector<Part> parts{ makePart(model->meshes[0].primitives[0], double4x4(1.0), double3(0.0)) };
    parts[0].material = &model->materials[0];
    parts[0].images = &model->images;
    const EmissiveLights lights(parts);
    EXPECT_TRUE(lights.empty());
    EXPECT_EQ(lights.pdf({}, { 0, 1, 0 }), 0);
}

TEST(EmissiveLights, AnotherSurfaceShadowsALamp) {
    ReferenceScene scene = lampOverFloor(0.05, 1000);
    double4x4 place(0.2);
    place[3] = double4(0, 0.75, 0, 1);
    scene.models.push_back({ makeModel(floorPrimitive(), lambert(0)), place });
    EXPECT_EQ(floorUnder(scene, Sampling::Both, 64).mean, double3(0.0));
}

} // namespace
} // namespace filament_core::reference
