// SPDX-License-Identifier: Apache-2.0
// Light through sheets and solids: scenes whose image is a formula.
#include "tests/tools/reference/TestScenes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"
#include "tools/reference/Surface.h"

#include <algorithm>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

struct Glass {
    double ior = 1.5, roughness = 0, dispersion = 0, thickness = 0;
    bool isThin = false;
    double3 absorption{ 0.0 }, color{ 1.0 };
};

SurfaceFinish finishOf(Glass const& glass) {
    return [glass](SurfaceSample& surface) {
        surface.metallic = 0;
        surface.diffuse = double3(0);
        surface.f0 = double3(lib::f0FromIor(glass.ior));
        surface.f90 = glass.ior > 1 ? 1 : 0;
        surface.perceptualRoughness = lib::clampPerceptualRoughness(glass.roughness);
        surface.transmission = { .color = glass.color,
                                 .isThin = glass.isThin,
                                 .ior = glass.ior,
                                 .dispersion = glass.dispersion,
                                 .absorption = glass.absorption,
                                 .thickness = glass.thickness };
    };
}

/// A block from -1 to 1 whose faces look outwards.
assets::PrimitiveData blockPrimitive() {
    std::vector<TestVertex> vertices;
    std::vector<uint32_t> indices;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : { -1.0f, 1.0f }) {
            float3 normal(0.0f), u(0.0f), v(0.0f);
            normal[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            const auto first = static_cast<uint32_t>(vertices.size());
            for (const float2 corner : { float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, 1) }) {
                vertices.push_back({ normal + u * corner.x + v * corner.y, normal, u, corner });
            }
            for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) indices.push_back(first + (side > 0 ? i : (4 - i) % 4));
        }
    }
    return makePrimitive(vertices, indices);
}

ReferenceScene sceneOf(assets::PrimitiveData primitive, Glass const& glass) {
    assets::MaterialData material = lambert(0);
    material.doubleSided = glass.isThin;
    return { .models = { { .data = makeModel(std::move(primitive), material), .finish = finishOf(glass) } } };
}

/// A flat plate of 200 x 200 m, 2 m thick.
ReferenceScene plateOf(Glass const& glass) {
    ReferenceScene scene = sceneOf(blockPrimitive(), glass);
    scene.models[0].worldFromModel[0][0] = scene.models[0].worldFromModel[2][2] = 100;
    return scene;
}

ReferenceSettings pathOf(uint32_t samples) {
    ReferenceSettings settings{ .samplesPerPixel = samples };
    settings.bsdf.fresnel = FresnelTerm::Exact;
    return settings;
}

/// A sky that is `below` where directions point down and black elsewhere.
ReferenceEnvironment groundOnly(float3 below) {
    return { .image = makeSky(64, [=](double3 d) { return d.y < 0 ? below : float3(0.0f); }), .illuminance = Lux{ 1 } };
}

const double3 kEyes[] = { { 0, 5, 0.01 }, { 4, 5, 0 }, { 9, 4, 3 } };

double cosineOf(double3 eye) { return glm::normalize(eye).y; }

/// Two parallel interfaces and all bounces between them; t: the fraction transmitted inside per crossing.
double plateTransmittance(double f, double t) { return (1 - f) * (1 - f) * t / (1 - f * f * t * t); }

TEST(Solid, AClearBallVanishesInAWhiteFurnace) {
    for (const double ior : { 1.1, 1.5, 2.4 }) {
        ReferenceScene scene = sceneOf(spherePrimitive(64), { .ior = ior });
        scene.environment = uniformSky();
        for (const double aside : { 0.0, 0.5, 0.8 }) {
            const Estimate estimate =
                    estimated(scene, viewFrom({ 0, 0.02, 50 }, { aside, 0, 0 }, { 8, 8 }, 0.05f), pathOf(256));
            // Facets and smooth normals may disagree about which directions are above the surface; then light is lost.
            expectAgrees(estimate, double3(1), 1e-2);
        }
    }
}

TEST(Solid, OfIndexOneIsInvisible) {
    ReferenceScene scene = sceneOf(spherePrimitive(16), { .ior = 1, .roughness = 0.5 });
    const auto sky = [](double3 d) { return 1.5 + d.x + 0.3 * d.z; };
    scene.environment = { .image = makeSky(256, [&](double3 d) { return float3(static_cast<float>(sky(d))); }),
                          .illuminance = Lux{ 1 } };
    const double3 direction = glm::normalize(double3(0.2, 0.1, 0) - double3(3, 1, 4));
    const Estimate estimate = estimated(scene, viewFrom({ 3, 1, 4 }, { 0.2, 0.1, 0 }, { 8, 8 }, 0.01f), pathOf(16));
    EXPECT_NEAR(estimate.mean.x, sky(direction), 2e-4);
    EXPECT_LT(estimate.error.x, 1e-4) << "nothing is left to chance";
}

// Light through a plate: Stokes' series with Fresnel's equations at the angle of the view.
TEST(Solid, APlateTransmitsWhatFresnelsEquationsSay) {
    for (const double ior : { 1.3, 1.5, 2.0 }) {
        ReferenceScene scene = plateOf({ .ior = ior });
        scene.environment = groundOnly(float3(1.0f));
        for (const double3 eye : kEyes) {
            const Estimate estimate = estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f), pathOf(512));
            const double f = lib::fresnelComplex(cosineOf(eye), ior, 0.0);
            expectAgrees(estimate, double3(plateTransmittance(f, 1)), 5e-3);
        }
    }
}

TEST(Solid, APlateAbsorbsByTheLengthOfTheWayInside) {
    const double3 absorption(0.1, 0.5, 1.5);
    ReferenceScene scene = plateOf({ .absorption = absorption });
    scene.environment = groundOnly(float3(1.0f));
    for (const double3 eye : kEyes) {
        const Estimate estimate = estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f), pathOf(512));
        const double cosine = cosineOf(eye), f = lib::fresnelComplex(cosine, 1.5, 0.0);
        double3 expected;
        for (int i = 0; i < 3; ++i) {
            expected[i] = plateTransmittance(f, std::exp(-absorption[i] * 2 / lib::refractedCosine(cosine, 1.5)));
        }
        expectAgrees(estimate, expected, 5e-3);
    }
}

// KHR_materials_volume: a coloured foil around the plate. Light that is reflected inside does not cross it.
TEST(Solid, ABaseColourCountsAtBothInterfacesOrOnceAsInTheEngine) {
    const double3 color(0.9, 0.6, 0.3);
    ReferenceScene scene = plateOf({ .color = color });
    scene.environment = groundOnly(float3(1.0f));
    for (const double3 eye : kEyes) {
        const ReferenceView view = viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f);
        const double passed = plateTransmittance(lib::fresnelComplex(cosineOf(eye), 1.5, 0.0), 1);
        ReferenceSettings settings = pathOf(512);
        expectAgrees(estimated(scene, view, settings), color * color * passed, 5e-3);
        settings.bsdf.solidTint = SolidTint::Once;
        expectAgrees(estimated(scene, view, settings), color * passed, 5e-3);
    }
}

// The offset of the view through a plate, and through a smooth ball the library's direction.
TEST(Solid, ABallBendsTheViewAsTwoRefractionsDo) {
    ReferenceScene scene = sceneOf(spherePrimitive(512), {});
    const auto sky = [](double3 d) { return 1.5 + d.x + 0.3 * d.y; };
    scene.environment = { .image = makeSky(256, [&](double3 d) { return float3(static_cast<float>(sky(d))); }),
                          .illuminance = Lux{ 1 } };
    const double3 eye(0, 0, 50), at(0.4, 0.2, 0);
    const double3 view = glm::normalize(eye - at);
    // Where the ray meets the ball.
    const double along = glm::dot(eye, view), reach = std::sqrt(along * along - (glm::dot(eye, eye) - 1));
    const double3 normal = eye - view * (along - reach);
    const double nov = glm::dot(normal, view), f = lib::fresnelComplex(nov, 1.5, 0.0);
    const double through = (1 - f) * (1 - f) * sky(lib::refractedSolid(normal, view, 1.5));
    const double mirrored = f * sky(2 * nov * normal - view);
    ReferenceSettings settings = pathOf(1024);
    settings.maxBounces = 1; // no reflection inside
    const Estimate estimate = estimated(scene, viewFrom(eye, at, { 8, 8 }, 0.002f), settings);
    EXPECT_NEAR(estimate.mean.x, through + mirrored, 4e-3 + 4 * estimate.error.x);
    EXPECT_GT(std::abs(sky(lib::refractedSolid(normal, view, 1.5)) - sky(-view)), 0.1) << "it bends";
}

TEST(Solid, ARoughBallLosesOnlyWhatItsFacetsShadow) {
    for (const double roughness : { 0.3, 0.6 }) {
        ReferenceScene scene = sceneOf(spherePrimitive(64), { .roughness = roughness });
        scene.environment = uniformSky();
        const Estimate estimate = estimated(scene, viewFrom({ 0, 0, 50 }, { 0.3, 0, 0 }, { 8, 8 }, 0.05f), pathOf(512));
        EXPECT_LT(estimate.mean.x, 1 + 4 * estimate.error.x);
        EXPECT_GT(estimate.mean.x, roughness < 0.5 ? 0.95 : 0.75);
    }
}

TEST(Solid, LightAndMaterialSamplingAgreeBehindRoughGlass) {
    ReferenceScene scene = sceneOf(spherePrimitive(32), { .roughness = 0.5, .absorption = double3(0.2) });
    scene.environment = { .image = makeSky(32, [](double3 d) { return float3(d.z < -0.5 ? 4.0f : 0.2f); }),
                          .illuminance = Lux{ 1 } };
    const ReferenceView view = viewFrom({ 0, 0, 50 }, { 0.3, 0.1, 0 }, { 8, 8 }, 0.05f);
    ReferenceSettings settings = pathOf(2048);
    const Estimate both = estimated(scene, view, settings);
    for (const Sampling sampling : { Sampling::Bsdf, Sampling::Light }) {
        settings.sampling = sampling;
        const Estimate one = estimated(scene, view, settings);
        EXPECT_NEAR(one.mean.x, both.mean.x, 4 * (one.error.x + both.error.x) + 1e-3);
    }
}

TEST(Solid, DispersionBendsBlueMoreThanRedAndLosesNothing) {
    ReferenceScene white = sceneOf(spherePrimitive(64), { .dispersion = 1 });
    white.environment = uniformSky();
    const ReferenceView view = viewFrom({ 0, 0.02, 50 }, { 0.6, 0, 0 }, { 8, 8 }, 0.05f);
    expectAgrees(estimated(white, view, pathOf(1024)), double3(1), 1.5e-2);

    // The sky grows brighter in the direction to which a ball bends the view: stronger refraction sees more.
    ReferenceScene ramp = sceneOf(spherePrimitive(256), { .dispersion = 1 });
    ramp.environment = { .image = makeSky(256, [](double3 d) { return float3(static_cast<float>(1 - d.x)); }),
                         .illuminance = Lux{ 1 } };
    ReferenceSettings settings = pathOf(4096);
    settings.maxBounces = 1;
    const Estimate seen = estimated(ramp, view, settings);
    const double3 iors = lib::dispersedIor(1.5, 1.0);
    const double3 direction = glm::normalize(double3(0.6, 0, 0) - double3(0, 0.02, 50));
    const double3 eye(0, 0.02, 50);
    const double along = -glm::dot(eye, direction), reach = std::sqrt(along * along - (glm::dot(eye, eye) - 1));
    const double3 normal = eye + direction * (along - reach);
    const double nov = -glm::dot(normal, direction);
    for (int i = 0; i < 3; ++i) {
        const double f = lib::fresnelComplex(nov, 1.5, 0.0); // index of the middle colour, as in the material
        const double through = 1 - lib::refractedSolid(normal, -direction, iors[i]).x;
        const double mirrored = 1 - (2 * nov * normal + direction).x;
        EXPECT_NEAR(seen.mean[i], (1 - f) * (1 - f) * through + f * mirrored, 0.02 + 4 * seen.error[i]) << i;
    }
    EXPECT_GT(seen.mean.z, seen.mean.y + 3e-3);
    EXPECT_GT(seen.mean.y, seen.mean.x + 3e-3);
}

TEST(Sheet, TransmitsByBothSidesAndDoesNotBend) {
    for (const double absorption : { 0.0, 20.0 }) {
        ReferenceScene scene =
                sceneOf(floorPrimitive(), { .thickness = 0.02, .isThin = true, .absorption = double3(absorption) });
        const auto sky = [](double3 d) { return d.y < 0 ? 1.5 + d.x : 0.0; };
        scene.environment = { .image = makeSky(512, [&](double3 d) { return float3(static_cast<float>(sky(d))); }),
                              .illuminance = Lux{ 1 } };
        for (const double3 eye : kEyes) {
            const Estimate estimate = estimated(scene, viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f), pathOf(256));
            const double cosine = cosineOf(eye), f = lib::fresnelComplex(cosine, 1.5, 0.0);
            const double t = std::exp(-absorption * lib::thinPathLength(cosine, 1.5, 0.02));
            const double expected = plateTransmittance(f, t) * sky(-glm::normalize(eye));
            expectAgrees(estimate, double3(expected), 3e-3);
        }
    }
}

// The same sheet as a thin wall and as a plate of glass that is traced: a hundred metres wide, 2 m thick.
TEST(Sheet, IsWhatAPlateOfGlassIs) {
    const double3 absorption(0.05, 0.3, 1);
    ReferenceScene plate = plateOf({ .absorption = absorption });
    ReferenceScene sheet = sceneOf(floorPrimitive(), { .thickness = 2, .isThin = true, .absorption = absorption });
    plate.environment = sheet.environment = groundOnly(float3(0.3f, 0.6f, 0.9f));
    for (const double3 eye : kEyes) {
        const ReferenceView view = viewFrom(eye, { 0, 0, 0 }, { 8, 8 }, 0.05f);
        const Estimate solid = estimated(plate, view, pathOf(512)), thin = estimated(sheet, view, pathOf(512));
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(solid.mean[i], thin.mean[i], 3e-3 + 4 * solid.error[i]) << i;
    }
}

// Both lobes of a sheet together lose what one bounce of microfacets loses, whatever Fresnel's equations give.
TEST(Sheet, LosesInAWhiteFurnaceWhatItsFacetsShadow) {
    for (const double roughness : { 0.0, 0.3, 0.6 }) {
        ReferenceScene scene = sceneOf(floorPrimitive(), { .roughness = roughness, .isThin = true });
        scene.environment = uniformSky();
        const double expected = directionalAlbedo(cosineOf({ 1, 2, 0 }), lib::clampPerceptualRoughness(roughness)).y;
        for (const Integrator integrator : { Integrator::Path, Integrator::Unoccluded }) {
            ReferenceSettings settings = pathOf(512);
            settings.integrator = integrator;
            settings.bsdf.energy = EnergyTerm::SingleScatter;
            const Estimate estimate = estimated(scene, viewFrom({ 1, 2, 0 }, { 0, 0, 0 }, { 8, 8 }, 0.5f), settings);
            expectAgrees(estimate, double3(expected), 2e-3);
        }
    }
}

TEST(Unoccluded, SeesThroughABallAsTheEngineDoes) {
    const double3 absorption(0.1, 0.4, 1);
    ReferenceScene scene = sceneOf(spherePrimitive(256), { .thickness = 2, .absorption = absorption });
    const auto sky = [](double3 d) { return 1.5 + d.x + 0.3 * d.y; };
    scene.environment = { .image = makeSky(256, [&](double3 d) { return float3(static_cast<float>(sky(d))); }),
                          .illuminance = Lux{ 1 } };
    const double3 eye(0, 0, 50), at(0.4, 0.2, 0);
    const ReferenceView view = viewFrom(eye, at, { 8, 8 }, 0.002f);
    ReferenceSettings settings = pathOf(1024);
    settings.maxBounces = 1;
    const Estimate traced = estimated(scene, view, settings);
    settings.integrator = Integrator::Unoccluded;
    const Estimate ball = estimated(scene, view, settings);
    // The engine's ball loses light once, on entry; a traced ball loses it again on exit.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(ball.mean[i], traced.mean[i], 0.06 * traced.mean[i]) << i;
}

} // namespace
} // namespace filament_core::reference
