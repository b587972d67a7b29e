// SPDX-License-Identifier: Apache-2.0
// Light that scatters inside solids: closed forms of one event, and what is known of many.
#include "tests/tools/reference/TestScenes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/SampleStream.h"
#include "tools/reference/ScatteringMedium.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

/// `extinction`: 1/m. Light enters by transmission.
assets::MaterialData cloudy(float3 extinction, float3 color, float anisotropy = 0, float ior = 1) {
    assets::MaterialData material = lambert(1);
    material.roughnessFactor = 0;
    material.ior = ior;
    const float distance = 1 / std::max({ extinction.x, extinction.y, extinction.z }); // darker colours count as black
    const float3 depth = extinction * distance;
    material.transmission = { .factor = 1,
                              .thicknessMeters = 1,
                              .attenuationColor = { std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z) },
                              .attenuationDistanceMeters = distance,
                              .maps = {} };
    material.volumeScatter = { .color = color, .anisotropy = anisotropy, .map = {} };
    return material;
}

ReferenceSettings pathsOf(uint32_t samples) {
    ReferenceSettings settings{ .samplesPerPixel = samples };
    settings.bsdf.fresnel = FresnelTerm::Exact;
    return settings;
}

/// A flat plate of 200 x 200 m, 2 m thick, whose middle is the origin.
ReferenceScene layerOf(assets::MaterialData const& material) {
    ReferenceScene scene;
    std::vector<TestVertex> vertices;
    std::vector<uint32_t> indices;
    for (const float side : { 1.0f, -1.0f }) {
        const auto first = static_cast<uint32_t>(vertices.size());
        for (const float2 corner : { float2(-100, -100), float2(-100, 100), float2(100, 100), float2(100, -100) })
            vertices.push_back({ { corner.x, side, corner.y }, { 0, side, 0 }, { 1, 0, 0 }, corner });
        for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) indices.push_back(first + (side > 0 ? i : (4 - i) % 4));
    }
    scene.models = { { .data = makeModel(makePrimitive(vertices, indices), material) } };
    return scene;
}

ReferenceEnvironment skyAbove() {
    return { .image = makeSky(64, [](double3 d) { return float3(d.y > 0 ? 1.0f : 0.0f); }), .illuminance = Lux{ 1 } };
}

/// Towards the middle of the upper face, at this cosine.
ReferenceView viewAt(double cosine) {
    const double3 direction(std::sqrt(1 - cosine * cosine), cosine, 0.001);
    return viewFrom(double3(0, 1, 0) + glm::normalize(direction) * 5.0, { 0, 1, 0 }, { 8, 8 }, 0.05f);
}

TEST(Scattering, ABallThatAbsorbsNothingVanishesInAWhiteFurnace) {
    for (const float anisotropy : { -0.5f, 0.0f, 0.9f }) {
        for (const float extinction : { 0.5f, 4.0f }) {
            ReferenceScene scene{
                .models = { { .data = makeModel(spherePrimitive(64), cloudy({ extinction, 2 * extinction, 0 },
                                                                            float3(1), anisotropy, 1.5f)) } },
                .environment = uniformSky()
            };
            const ReferenceView view = viewFrom({ 0, 0.02, 50 }, { 0.4, 0, 0 }, { 8, 8 }, 0.05f);
            expectAgrees(estimated(scene, view, pathsOf(256)), double3(1), 1e-2);
        }
    }
}

TEST(Scattering, SoDoesOneThatLightEntersByDiffuseTransmission) {
    assets::MaterialData wax = cloudy({ 1, 3, 9 }, float3(1));
    wax.transmission.factor = 0;
    wax.roughnessFactor = 1;
    for (const float part : { 1.0f, 0.5f }) {
        wax.diffuseTransmission = { .factor = part, .maps = {} };
        ReferenceScene scene{ .models = { { .data = makeModel(spherePrimitive(64), wax) } },
                              .environment = uniformSky() };
        const ReferenceView view = viewFrom({ 0, 0.02, 50 }, { 0.4, 0, 0 }, { 8, 8 }, 0.05f);
        expectAgrees(estimated(scene, view, pathsOf(256)), double3(1), 1e-2);
    }
}

// Beer and Lambert: a colour that does not scatter, beside one that does.
TEST(Scattering, AColorThatDoesNotScatterIsAbsorbedAsBefore) {
    const double3 extinction(0.3, 0.6, 1.2);
    ReferenceScene scene{
        .models = { { .data = makeModel(spherePrimitive(128), cloudy(float3(extinction), { 0, 0, 0.8f }, 0.5f)) } }
    };
    scene.environment = { .image = makeSky(64, [](double3 d) { return float3(d.z < -0.99 ? 1.0f : 0.0f); }),
                          .illuminance = Lux{ 1 } };
    const Estimate estimate = estimated(scene, viewFrom({ 0, 0.02, 50 }, { 0, 0, 0 }, { 8, 8 }, 0.05f), pathsOf(1024));
    for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(estimate.mean[i], std::exp(-2 * extinction[i]), 4 * estimate.error[i] + 1e-3) << i;
    }
    EXPECT_GT(estimate.mean.z, std::exp(-2 * extinction.z) + 1e-3) << "scattered into the view";
}

TEST(Scattering, WithoutAColorEveryBitIsThatOfTheVolume) {
    assets::MaterialData clear = cloudy({ 0.3f, 0.6f, 1.2f }, float3(0), 0.7f, 1.5f), volume = clear;
    volume.volumeScatter = {};
    std::vector<float3> pictures[2];
    for (size_t i = 0; i < 2; ++i) {
        ReferenceScene scene{ .models = { { .data = makeModel(spherePrimitive(32), i == 0 ? clear : volume) } },
                              .environment = uniformSky() };
        pictures[i] = rendered(scene, viewFrom({ 0, 0, 50 }, { 0, 0, 0 }, { 16, 16 }, 3), pathsOf(16)).color;
    }
    ASSERT_EQ(pictures[0].size(), pictures[1].size());
    EXPECT_EQ(std::memcmp(pictures[0].data(), pictures[1].data(), pictures[0].size() * sizeof(float3)), 0);
}

/// What a layer of this depth returns after one event, seen along its normal under a sky of radiance 1, for a phase
/// function of this anisotropy and an albedo of 1: an integral over the angles of the light.
double onceReturned(double depth, double anisotropy) {
    constexpr int kSteps = 20'000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double cosine = (i + 0.5) / kSteps; // the light turns from -cosine to 1 along the normal
        const double reach = -std::expm1(-depth * (1 + 1 / cosine)) * cosine / (1 + cosine);
        sum += 2 * kPiExact * phaseHenyeyGreenstein(-cosine, anisotropy) * reach / kSteps;
    }
    return sum;
}

TEST(Scattering, ALayerThatHardlyScattersReturnsTheIntegralOfOneEvent) {
    constexpr double kAlbedo = 0.02;
    for (const double anisotropy : { -0.5, 0.0, 0.6 }) {
        ReferenceScene scene = layerOf(cloudy({ 0.1f, 0.5f, 2 }, float3(0.1f), static_cast<float>(anisotropy)));
        scene.models[0].finish = [](SurfaceSample& surface) { surface.medium->albedo = double3(kAlbedo); };
        scene.environment = skyAbove();
        const Estimate estimate = estimated(scene, viewAt(1), pathsOf(4096));
        for (int i = 0; i < 3; ++i) {
            const double depth = 2 * double3(0.1, 0.5, 2)[i], once = kAlbedo * onceReturned(depth, anisotropy);
            EXPECT_GT(estimate.mean[i], once - 4 * estimate.error[i]) << i << ", " << anisotropy;
            EXPECT_LT(estimate.mean[i], once * (1 + 2 * kAlbedo) + 4 * estimate.error[i]) << i << ", " << anisotropy;
        }
    }
}

// The mean over a hemisphere of what it returns, each direction by its cosine: the spherical albedo.
TEST(Scattering, AThickBodyHasItsMultiscatterColor) {
    constexpr std::array kCosines{ 0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558 }; // Gauss and Legendre
    constexpr std::array kWeights{ 0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226 };
    const double3 color(0.2, 0.5, 0.9);
    ReferenceScene scene{
        .models = { { .data = makeModel(spherePrimitive(128), cloudy(float3(1000), float3(color))) } },
        .environment = uniformSky()
    };
    double3 mean(0.0), variance(0.0);
    for (size_t i = 0; i < kCosines.size(); ++i) {
        const double aside = std::sqrt(1 - kCosines[i] * kCosines[i]);
        const ReferenceView view = viewFrom({ aside, 0, 100 }, { aside, 0.01, 0 }, { 8, 8 }, 0.001f);
        const Estimate estimate = estimated(scene, view, pathsOf(128));
        const double weight = 2 * kCosines[i] * kWeights[i];
        mean += estimate.mean * weight;
        variance += estimate.error * estimate.error * (weight * weight);
    }
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i], color[i], 0.006 + 4 * std::sqrt(variance[i])) << i;
}

TEST(ScatteringMedium, FlightsWeighWhatReachesTheSurfaceAndWhatScatters) {
    const MediumSample medium{ .extinction = { 0.2, 1, 5 }, .albedo = { 0.9, 0.5, 0 } };
    constexpr uint32_t kCount = 1u << 16;
    double3 passed(0.0), scattered(0.0);
    for (uint32_t i = 0; i < kCount; ++i) {
        const Flight flight = sampleFlight(medium, { 1, 2, 0.5 }, 0.7, SampleStream(3, i).pair(0));
        (flight.scatters ? scattered : passed) += flight.weight / double(kCount);
    }
    for (int i = 0; i < 3; ++i) {
        const double left = std::exp(-0.7 * medium.extinction[i]);
        EXPECT_NEAR(passed[i], left, 2e-3) << i;
        EXPECT_NEAR(scattered[i], medium.albedo[i] * (1 - left), 2e-3) << i;
    }
}

TEST(ScatteringMedium, DirectionsFollowThePhaseFunction) {
    constexpr uint32_t kCount = 1u << 16;
    const double3 before = glm::normalize(double3(0.3, -0.5, 0.8));
    for (const double anisotropy : { -0.9, -0.3, 0.0, 0.5, 0.95 }) {
        double mean = 0, forward = 0, expected = 0;
        for (uint32_t i = 0; i < kCount; ++i) {
            const double cosine = glm::dot(before, turned(before, anisotropy, SampleStream(5, i).pair(0)));
            mean += cosine / kCount;
            forward += (cosine > 0.5 ? 1.0 : 0.0) / kCount;
        }
        constexpr int kSteps = 100'000;
        for (int i = 0; i < kSteps; ++i)
            expected += 2 * kPiExact * phaseHenyeyGreenstein(0.5 + 0.5 * (i + 0.5) / kSteps, anisotropy) * 0.5 / kSteps;
        EXPECT_NEAR(mean, anisotropy, 2e-3);
        EXPECT_NEAR(forward, expected, 2e-3) << anisotropy;
    }
}

TEST(ScatteringMedium, TheLossIsTheRootThatKullaAndContyGive) {
    for (double a = 0; a <= 1; a += 0.0625) {
        const double root = 4.09712 + 4.20863 * a - std::sqrt(9.59217 + 41.6808 * a + 17.7126 * a * a);
        EXPECT_NEAR(lib::scatterLoss(double3(a)).x, root, 2e-5) << a;
    }
    EXPECT_EQ(lib::scatterLoss(double3(1)).x, 0);
    EXPECT_NEAR(lib::scatterLoss(double3(0)).x, 1, 1e-15);
}

} // namespace
} // namespace filament_core::reference
