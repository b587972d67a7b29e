// SPDX-License-Identifier: Apache-2.0
// Scenes whose image is a formula: the reference agrees within its stated error.
#include "tests/tools/reference/TestScenes.h"

#include "tools/reference/DirectionalAlbedo.h"

#include <algorithm>

namespace filament_core::reference {
namespace {

ReferenceSettings settingsOf(Integrator integrator, uint32_t samples = 64) {
    return { .integrator = integrator, .samplesPerPixel = samples };
}

/// Lambert's lobe alone, without a specular lobe.
ReferenceSettings diffuseOnly(Integrator integrator, uint32_t samples) {
    ReferenceSettings settings = settingsOf(integrator, samples);
    settings.bsdf = { .coupling = CouplingTerm::Never, .lobes = LobeChoice::Diffuse };
    return settings;
}

const std::array kIntegrators{ Integrator::Path, Integrator::Unoccluded };

ReferenceScene sceneOfOne(assets::PrimitiveData primitive, assets::MaterialData material) {
    return { .models = { { makeModel(std::move(primitive), std::move(material)) } } };
}

TEST(ClosedForm, AWhiteDielectricVanishesInAWhiteFurnace) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(1));
    scene.environment = uniformSky();
    // The diffuse lobe gets what the specular lobe leaves: together they reflect everything.
    for (const Integrator integrator : kIntegrators) {
        for (const double height : { 0.3, 1.0, 5.0 }) {
            const Estimate estimate =
                    estimated(scene, viewFrom({ 2, height, 0 }, { 0, 0, 0 }), settingsOf(integrator, 64));
            expectAgrees(estimate, double3(1), 3e-4);
        }
    }
}

TEST(ClosedForm, AWhiteMetalVanishesInAWhiteFurnaceAtEveryRoughness) {
    for (const float roughness : { 0.1f, 0.4f, 0.7f, 1.0f }) {
        ReferenceScene scene = sceneOfOne(floorPrimitive(), metal(roughness));
        scene.environment = uniformSky();
        for (const Integrator integrator : kIntegrators) {
            const Estimate estimate = estimated(scene, viewFrom({ 2, 1, 0 }, { 0, 0, 0 }), settingsOf(integrator, 256));
            expectAgrees(estimate, double3(1), 3e-4);
        }
    }
}

// The fraction that one bounce keeps, from quadrature over half vectors in another file.
TEST(ClosedForm, ASingleScatteringMetalLosesOneMinusItsDirectionalAlbedo) {
    for (const float roughness : { 0.3f, 0.6f, 1.0f }) {
        ReferenceScene scene = sceneOfOne(floorPrimitive(), metal(roughness));
        scene.environment = uniformSky();
        ReferenceSettings settings = settingsOf(Integrator::Unoccluded, 256);
        settings.bsdf.energy = EnergyTerm::SingleScatter;
        const double cosine = 1 / std::sqrt(5.0);
        const double kept = integrateDirectionalAlbedo(cosine, std::pow(double(roughness), 2), 64, 64).y;
        expectAgrees(estimated(scene, viewFrom({ 2, 1, 0 }, { 0, 0, 0 }), settings), double3(kept), 5e-4);
        EXPECT_GT(1 - kept, roughness > 0.5f ? 0.05 : 1e-4) << "the loss is not what this test could miss";
    }
}

TEST(ClosedForm, ALambertFloorUnderASunShowsAlbedoOverPiTimesTheIlluminanceTimesTheCosine) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    for (const float tilt : { 0.0f, 0.5f, 1.2f, 1.56f }) {
        scene.suns = { { .directionWorld = { std::sin(tilt), -std::cos(tilt), 0 }, .illuminance = Lux{ 3 } } };
        for (const Integrator integrator : kIntegrators) {
            const Estimate estimate = estimated(scene, viewFrom({ 0, 4, 4 }, { 0, 0, 0 }), diffuseOnly(integrator, 16));
            const double expected = 0.5 / kPiExact * 3 * std::cos(double(tilt));
            expectAgrees(estimate, double3(expected), 1e-6 + 2e-5 * expected);
        }
    }
}

/// The fraction of light from everywhere that a dielectric of alpha 1 reflects.
double albedoOfRoughDielectric(double cosine) {
    const double2 dfg = integrateDirectionalAlbedo(cosine, 1);
    return (0.04 * (dfg.y - dfg.x) + dfg.x) * (1 + 0.04 * (1 / dfg.y - 1));
}

TEST(ClosedForm, ARoughDielectricUnderASunShowsBothLobes) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    double average = 0; // weighted by the cosine: evenly in its square
    for (int i = 0; i < 256; ++i) average += albedoOfRoughDielectric(std::sqrt((i + 0.5) / 256)) / 256;
    for (const float tilt : { 0.0f, 0.5f, 1.2f }) {
        scene.suns = { { .directionWorld = { std::sin(tilt), -std::cos(tilt), 0 }, .illuminance = Lux{ 3 } } };
        // alpha = 1: D = 1 / pi, V = 1 / (2 (n.l + n.v)).
        const double3 view = glm::normalize(double3(0, 1, 1.5)), light(-std::sin(tilt), std::cos(tilt), 0);
        const double nov = view.y, nol = light.y, voh = glm::dot(view, glm::normalize(view + light));
        const double fresnel = 0.04 + 0.96 * std::pow(1 - voh, 5);
        const double compensation = 1 + 0.04 * (1 / integrateDirectionalAlbedo(nov, 1).y - 1);
        const double specular = 1 / kPiExact * 0.5 / (nol + nov) * fresnel * compensation;
        const double coupling = (1 - albedoOfRoughDielectric(nov)) * (1 - albedoOfRoughDielectric(nol)) / (1 - average);
        const double expected = (0.5 / kPiExact * coupling + specular) * 3 * nol;
        expectAgrees(
                estimated(scene, viewFrom(view * 10.0, { 0, 0, 0 }, { 8, 8 }, 0.05f), settingsOf(Integrator::Path, 16)),
                double3(expected), 2e-4 * expected);
    }
}

// The irradiance of half of the sky, x > 0, on a floor is pi / 2; the bilinear edge at x = 0 is symmetric.
TEST(ClosedForm, HalfASkyGivesALambertFloorHalfItsLight) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.8f));
    scene.environment = { .image = makeSky(64, [](double3 d) { return float3(d.x > 0 ? 1.0f : 0.0f); }),
                          .illuminance = Lux{ 2 } };
    for (const Integrator integrator : kIntegrators) {
        const Estimate estimate = estimated(scene, viewFrom({ 3, 3, 3 }, { 0, 0, 0 }), diffuseOnly(integrator, 256));
        expectAgrees(estimate, double3(0.8 * 0.5 * 2), 1e-4);
    }
}

// L = cos theta: the irradiance of a floor is the integral of cos^2, 2 pi / 3.
TEST(ClosedForm, ASkyThatBrightensTowardsTheZenithGivesTwoThirdsOfPi) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(1));
    scene.environment = { .image = makeSky(256,
                                           [](double3 d) { return float3(static_cast<float>(std::max(d.y, 0.0))); }),
                          .illuminance = Lux{ 1 } };
    for (const Integrator integrator : kIntegrators) {
        const Estimate estimate = estimated(scene, viewFrom({ 3, 3, 3 }, { 0, 0, 0 }), diffuseOnly(integrator, 256));
        expectAgrees(estimate, double3(2.0 / 3), 2e-4);
    }
}

TEST(ClosedForm, APointLightFallsOffWithTheSquareOfItsDistance) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    for (const double height : { 0.5, 1.0, 3.0 }) {
        scene.points = { { .positionWorld = { 0, height, 0 }, .intensity = Candela{ 7 } } };
        const Estimate estimate = estimated(scene, viewFrom({ 0, 4, 4 }, { 0, 0, 0 }, { 8, 8 }, 0.02f),
                                            diffuseOnly(Integrator::Path, 16));
        const double expected = 0.5 / kPiExact * 7 / (height * height);
        expectAgrees(estimate, double3(expected), 2e-5 * expected);
    }
}

// Each is chosen now and then; the mean is the sum.
TEST(ClosedForm, ManyLightsAddUp) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    scene.suns = { { .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 2 }, .color = { 1, 0, 0 } } };
    scene.points = { { .positionWorld = { 0, 1, 0 }, .intensity = Candela{ 3 }, .color = { 0, 1, 0 } },
                     { .positionWorld = { 0, 2, 0 }, .intensity = Candela{ 4 }, .color = { 0, 0, 1 } } };
    const Estimate estimate =
            estimated(scene, viewFrom({ 0, 4, 4 }, { 0, 0, 0 }, { 8, 8 }, 0.02f), diffuseOnly(Integrator::Path, 256));
    EXPECT_GT(estimate.error.y, 0);
    expectAgrees(estimate, double3(2, 3, 1) * (0.5 / kPiExact), 1e-5);
}

// A profile of I cos^2 above a floor: E = I cos^3 / d^2 = I cos^5 / h^2.
TEST(ClosedForm, AProfileGivesEachDirectionItsShare) {
    assets::IesFile file{ .type = assets::IesType::C, .horizontal = { 0 }, .peak = 700 };
    for (int degrees = 0; degrees <= 90; ++degrees) {
        file.vertical.push_back(degrees);
        file.candelas.push_back(static_cast<float>(700 * std::pow(std::cos(degrees * kPiExact / 180), 2)));
    }
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    scene.pointProfiles = { std::make_shared<const assets::IesFile>(file) };
    const ReferenceView view = viewFrom({ 0, 4, 4 }, { 0, 0, 0 }, { 8, 8 }, 0.02f);
    for (const double away : { 0.0, 1.0, 3.0 }) {
        scene.points = { { .positionWorld = { away, 2, 0 },
                           .intensity = Candela{ 8 },
                           .directionWorld = { 0, -3, 0 },
                           .upWorld = { 0, 0, 1 } } };
        const double cosine = 2 / std::sqrt(4 + away * away);
        const double expected = 0.5 / kPiExact * 8 * std::pow(cosine, 5) / 4;
        expectAgrees(estimated(scene, view, diffuseOnly(Integrator::Path, 16)), double3(expected),
                     1e-6 + 2e-3 * expected);
        scene.points[0].directionWorld = { 0, 1, 0 };
        EXPECT_EQ(estimated(scene, view, diffuseOnly(Integrator::Path, 4)).mean, double3(0))
                << "beyond the last angle there is no light";
    }
}

TEST(ClosedForm, ASpotIsDarkOutsideOfItsConeAndFullInside) {
    ReferenceScene scene = sceneOfOne(floorPrimitive(), lambert(0.5f));
    const ReferenceSettings settings = diffuseOnly(Integrator::Path, 16);
    const ReferenceView view = viewFrom({ 0, 4, 4 }, { 0, 0, 0 }, { 8, 8 }, 0.02f);
    const double full = 0.5 / kPiExact * 7;
    const auto lit = [&](float3 direction) {
        scene.spots = { { .positionWorld = { 0, 1, 0 },
                          .directionWorld = direction,
                          .intensity = Candela{ 7 },
                          .innerConeRadians = 0.3f,
                          .outerConeRadians = 0.5f } };
        return estimated(scene, view, settings).mean.x;
    };
    EXPECT_NEAR(lit({ 0, -1, 0 }), full, 2e-5 * full);
    EXPECT_NEAR(lit({ std::sin(0.29f), -std::cos(0.29f), 0 }), full, 2e-5 * full);
    const double between = (std::cos(0.4) - std::cos(0.5)) / (std::cos(0.3) - std::cos(0.5));
    EXPECT_NEAR(lit({ std::sin(0.4f), -std::cos(0.4f), 0 }), full * between * between, 1e-3 * full);
    EXPECT_EQ(lit({ std::sin(0.51f), -std::cos(0.51f), 0 }), 0);
    scene.spots.clear();
    scene.points = { { .positionWorld = { 0, 1, 0 }, .intensity = Candela{ 7 }, .rangeMeters = 0.99f } };
    EXPECT_EQ(estimated(scene, view, settings).mean.x, 0) << "out of range";
}

TEST(ClosedForm, EmissionIsAddedAsItIsWhateverTheExposure) {
    assets::MaterialData material = lambert(0);
    material.emissiveFactor = { 0.25f, 0.5f, 1.0f };
    material.emissiveStrength = 8;
    const ReferenceScene scene = sceneOfOne(floorPrimitive(), material);
    ReferenceView view = viewFrom({ 0, 4, 4 }, { 0, 0, 0 });
    for (const float shutter : { 1.2f, 0.001f }) {
        view.camera.exposure.shutterSeconds = shutter;
        for (const Integrator integrator : kIntegrators) {
            expectAgrees(estimated(scene, view, settingsOf(integrator, 16)), double3(2, 4, 8), 1e-6);
        }
    }
}

// Radiance inside of a closed room that emits Le and reflects a: Le + a Le + a^2 Le + ... = Le / (1 - a).
TEST(ClosedForm, InsideOfAGlowingRoomAllBouncesSumUpToTheGeometricSeries) {
    for (const float albedo : { 0.3f, 0.7f, 0.9f }) {
        for (const auto& primitive : { roomPrimitive(), spherePrimitive(16, true) }) {
            assets::MaterialData material = lambert(albedo);
            material.emissiveFactor = float3(0.5f);
            const Estimate estimate = estimated(sceneOfOne(primitive, material), viewFrom({ 0, 0, 0 }, { 0.3, 1, 0.2 }),
                                                diffuseOnly(Integrator::Path, 512));
            const double expected = 0.5 / (1 - double(albedo));
            // Losses due to the safety distance at corners, or to normals that differ from those of the facets.
            expectAgrees(estimate, double3(expected), 2e-3 * expected);
        }
    }
}

TEST(ClosedForm, TheBounceLimitCutsTheSeriesAfterThatManyTerms) {
    assets::MaterialData material = lambert(0.5f);
    material.emissiveFactor = float3(1);
    const ReferenceScene scene = sceneOfOne(roomPrimitive(), material);
    ReferenceSettings settings = diffuseOnly(Integrator::Path, 64);
    for (const uint32_t bounces : { 1u, 2u, 3u }) {
        settings.maxBounces = bounces;
        const Estimate estimate = estimated(scene, viewFrom({ 0, 0, 0 }, { 0.3, 1, 0.2 }), settings);
        expectAgrees(estimate, double3(2 - std::exp2(-double(bounces))), 1e-4);
    }
}

TEST(ClosedForm, WhatAnotherPlaneHidesFromTheSunIsBlackOnlyWithVisibility) {
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    model->nodes.push_back({ .name = "roof", .mesh = 0 });
    model->nodes[1].worldFromNode[3] = double4(0, 1, 0, 1);
    ReferenceScene scene{ .models = { { model } } };
    scene.suns = { { .directionWorld = { 0, -1, 0 }, .illuminance = Lux{ 1 } } };
    ReferenceSettings settings = settingsOf(Integrator::Path, 16);
    settings.maxBounces = 1;
    const ReferenceView below = viewFrom({ 5, 0.5, 0 }, { 0, 0, 0 });
    EXPECT_EQ(estimated(scene, below, settings).mean.x, 0);
    settings.integrator = Integrator::Unoccluded;
    EXPECT_GT(estimated(scene, below, settings).mean.x, 0.1);
    // Beside the roof's shadow the sun arrives.
    scene.suns = { { .directionWorld = { 3, -1, 0 }, .illuminance = Lux{ 1 } } };
    settings.integrator = Integrator::Path;
    EXPECT_GT(estimated(scene, below, settings).mean.x, 0.01);
}

// One more bounce: the light that a lit floor sends to a ceiling directly above one of its points. The form factor of a
// square of half side s from a parallel element at distance d below its centre (Howell, "Catalog of Radiation Heat
// Transfer Configuration Factors", B-4): four times that of a corner.
TEST(ClosedForm, ALitFloorLightsTheCeilingByItsFormFactor) {
    auto model = makeModel(floorPrimitive(), lambert(0.5f));
    model->nodes.push_back({ .name = "ceiling", .mesh = 0 });
    const double distance = 0.5;
    model->nodes[1].worldFromNode = double4x4(double4(0.02, 0, 0, 0), double4(0, -0.02, 0, 0), double4(0, 0, 0.02, 0),
                                              double4(0, distance, 0, 1));
    ReferenceScene scene{ .models = { { model } } };
    scene.suns = { { .directionWorld = { 1, -1, 0 }, .illuminance = Lux{ 10 } } };
    ReferenceSettings settings = diffuseOnly(Integrator::Path, 1024);
    settings.maxBounces = 2;
    const Estimate ceiling = estimated(scene, viewFrom({ 0, 0.3, 0.3 }, { 0, distance, 0 }, { 8, 8 }, 0.5f), settings);

    const double a = 1 / distance;
    const double corner = 1 / kPiExact * (a / std::sqrt(1 + a * a)) * std::atan(a / std::sqrt(1 + a * a));
    const double floorRadiance = 0.5 / kPiExact * 10 * std::sqrt(0.5);
    expectAgrees(ceiling, double3(0.5 * floorRadiance * 4 * corner), 1e-4);
}

TEST(ClosedForm, ASmoothMetalShowsTheSkyInTheMirrorDirection) {
    // A sky that changes slowly, so that a lobe of half a degree sees its central value.
    const auto value = [](double3 d) { return 1.5 + d.x + 0.3 * d.z; };
    ReferenceScene scene = sceneOfOne(floorPrimitive(), metal(0));
    scene.environment = { .image = makeSky(256, [&](double3 d) { return float3(static_cast<float>(value(d))); }),
                          .illuminance = Lux{ 1 } };
    const double3 eye(-3, 3, 1);
    const double3 mirrored = glm::normalize(double3(3, 3, -1));
    for (const Integrator integrator : kIntegrators) {
        const Estimate estimate =
                estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.1f), settingsOf(integrator, 256));
        expectAgrees(estimate, double3(value(mirrored)), 1e-3);
    }
    scene.environment->rotationRadians = 0.7f; // the sky turns, the mirror shows another part of it
    const double c = std::cos(0.7), s = std::sin(0.7);
    const double3 turned(c * mirrored.x - s * mirrored.z, mirrored.y, s * mirrored.x + c * mirrored.z);
    const Estimate estimate =
            estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.1f), settingsOf(Integrator::Path, 256));
    expectAgrees(estimate, double3(value(turned)), 1e-3);
    EXPECT_GT(std::abs(value(turned) - value(mirrored)), 0.1);
}

} // namespace
} // namespace filament_core::reference
