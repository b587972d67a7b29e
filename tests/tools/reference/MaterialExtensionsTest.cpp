// SPDX-License-Identifier: Apache-2.0
// The KHR_materials extensions at a point of a model, compared with values computed by hand from their formulas.
#include "tests/tools/reference/TestScenes.h"

#include "tools/reference/Geometry.h"
#include "tools/reference/Material.h"

#include <algorithm>

namespace filament_core::reference {
namespace {

using backend::Format;

/// A square in the plane z = 0, seen from +z.
struct Square {
    std::vector<assets::Image> images;
    assets::MaterialData material = lambert(1);
    double sceneFromMesh = 1, worldFromScene = 1;

    Square() {
        material.baseColorFactor = { 0.8f, 0.4f, 0.2f, 1 };
        material.roughnessFactor = 0.5f;
    }

    SurfaceSample seen(double side = 1) const {
        const TestVertex vertices[3] = { { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 0 } },
                                         { { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 1, 0 } },
                                         { { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1 } } };
        const uint32_t indices[3] = { 0, 1, 2 };
        Part part = makePart(makePrimitive(vertices, indices), double4x4(1.0), double3(0.0));
        part.material = &material;
        part.images = &images;
        part.sceneFromMesh = sceneFromMesh;
        part.worldFromScene = worldFromScene;
        return surfaceAt(part, { 0, 0.3, 0.3 }, { 0, 0, side });
    }

    assets::TextureRef texel(std::array<uint8_t, 4> value, Format format = Format::RGBA8) {
        assets::Image image{ .width = 1, .height = 1, .format = format, .data = {} };
        for (const uint8_t component : value) image.data.push_back(std::byte{ component });
        images.push_back(std::move(image));
        return { .image = static_cast<uint32_t>(images.size() - 1) };
    }
};

void expectNear(double3 value, double3 expected, const char* what) {
    EXPECT_LT(glm::distance(value, expected), 1e-6)
            << what << ": " << value.x << ", " << value.y << ", " << value.z << ", expected " << expected.x << ", "
            << expected.y << ", " << expected.z;
}

TEST(MaterialExtensions, ClearCoatHasItsFactorRoughnessAndNormalAndLeavesTheBase) {
    Square square;
    square.material.clearCoat.factor = 0.5f;
    square.material.clearCoat.roughness = 0.25f;
    SurfaceSample surface = square.seen();
    EXPECT_NEAR(surface.coat.strength, 0.5, 1e-6);
    EXPECT_NEAR(surface.coat.perceptualRoughness, 0.25, 1e-6);
    expectNear(surface.coat.bareF0, double3(0.04), "f0 in air");
    expectNear(surface.f0, double3(0.04), "f0 below the coat, without a change of index");
    square.material.normal = square.texel({ 204, 128, 230, 255 });
    square.material.clearCoat.maps = { square.texel({ 51, 102, 0, 255 }), true, true };
    surface = square.seen();
    EXPECT_NEAR(surface.coat.strength, 0.5 * 0.2, 1e-6);
    EXPECT_NEAR(surface.coat.perceptualRoughness, 0.25 * 0.4, 1e-6);
    expectNear(surface.coat.normal, { 0, 0, 1 }, "the base's normal map does not bend the coat");
    EXPECT_GT(surface.normal.x, 0.5);
    square.material.clearCoat.maps.hasFirst = false;
    EXPECT_NEAR(square.seen().coat.strength, 0.5, 1e-6) << "red means nothing then";
    square.material.clearCoat.normal = square.texel({ 128, 204, 230, 255 });
    square.material.clearCoat.normalScale = 0.5f;
    const double3 texel(128 / 127.5 - 1, 204 / 127.5 - 1, 230 / 127.5 - 1);
    const double3 bent = glm::normalize(texel * double3(0.5, 0.5, 1));
    EXPECT_LT(glm::distance(square.seen().coat.normal, bent), 1e-4);
    EXPECT_LT(glm::distance(square.seen(-1).coat.normal, -bent), 1e-4) << "from behind";
}

/// Heights that grow by `step` (of 255) a texel along u, eight texels wide.
assets::Image ramp(int step) {
    assets::Image image{ .width = 8, .height = 1, .format = Format::RGBA8, .data = {} };
    for (int x = 0; x < 8; ++x) image.data.insert(image.data.end(), 4, static_cast<std::byte>(x * step));
    return image;
}

TEST(MaterialExtensions, BumpsTiltTheNormalAgainstTheSlopeOfTheHeight) {
    Square square;
    square.images.push_back(ramp(17));
    square.material.bump = { .factor = 0.5f, .map = { .image = 0 } };
    const double slope = 0.5 * 8 * 17 / 255; // metres of height per metre: u is 1 at x = 1
    expectNear(square.seen().normal, glm::normalize(double3(-slope, 0, 1)), "uphill along x");
    expectNear(square.seen(-1).normal, glm::normalize(double3(slope, 0, -1)), "the same relief from behind");
    EXPECT_TRUE(square.seen().unmappedNormal) << "lamps below the geometry's horizon are hidden";
    square.material.bump.factor = -0.5f;
    expectNear(square.seen().normal, glm::normalize(double3(slope, 0, 1)), "dents");
    square.material.bump.map.hasTransform = true;
    square.material.bump.map.uvTransform = float3x3(float3(0, 1, 0), float3(1, 0, 0), float3(0, 0, 1));
    expectNear(square.seen().normal, glm::normalize(double3(0, slope, 1)), "u and v exchanged, and so mirrored");
    square.material.bump.factor = 0;
    expectNear(square.seen().normal, { 0, 0, 1 }, "no relief");
}

TEST(MaterialExtensions, TheSlopesOfBumpsAndNormalMapsAddUp) {
    Square square;
    square.images.push_back(ramp(17));
    square.material.bump = { .factor = 0.5f, .map = { .image = 0 } };
    square.material.normal = square.texel({ 204, 128, 230, 255 });
    const double slope = 0.5 * 8 * 17 / 255;
    const double3 texel(204 / 127.5 - 1, 128 / 127.5 - 1, 230 / 127.5 - 1);
    const double3 sum = glm::normalize(double3(texel.x / texel.z - slope, texel.y / texel.z, 1));
    EXPECT_LT(glm::distance(square.seen().normal, sum), 1e-4);
    square.material.clearCoat.factor = 1;
    expectNear(square.seen().coat.normal, { 0, 0, 1 }, "the coat is smooth");
}

TEST(MaterialExtensions, SheenTakesItsColorFromRgbAndItsRoughnessFromAlpha) {
    Square square;
    square.material.sheen.color = { 0.5f, 1, 0.25f };
    square.material.sheen.roughness = 0.5f;
    square.material.sheen.maps = { square.texel({ 255, 188, 0, 51 }, Format::RGBA8Srgb), true, true };
    const SurfaceSample surface = square.seen();
    const double green = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    expectNear(surface.sheen.color, { 0.5, green, 0 }, "sRGB");
    EXPECT_NEAR(surface.sheen.perceptualRoughness, 0.5 * 0.2, 1e-6);
    square.material.sheen.color = float3(0.0f);
    EXPECT_EQ(square.seen().sheen.color, double3(0.0));
}

TEST(MaterialExtensions, IndexAndSpecularWeighWhatDielectricsReflect) {
    Square square;
    square.material.ior = 2;
    expectNear(square.seen().f0, double3(1 / 9.0), "((2 - 1) / (2 + 1))^2");
    square.material.metallicFactor = 0.25f;
    square.material.specular.factor = 0.5f;
    square.material.specular.color = { 1, 0.5f, 20 };
    square.material.specular.maps = { square.texel({ 255, 255, 255, 102 }, Format::RGBA8Srgb), true, true };
    const SurfaceSample surface = square.seen();
    const double3 dielectric = double3(1 / 9.0, 0.5 / 9.0, 1) * (0.5 * 0.4); // no more than all is reflected
    expectNear(surface.f0, dielectric * 0.75 + double3(0.8, 0.4, 0.2) * 0.25, "mixed with the metal");
    EXPECT_NEAR(surface.f90, 0.2 * 0.75 + 0.25, 1e-6) << "the colour does not tint grazing light";
    expectNear(surface.diffuse, double3(0.8, 0.4, 0.2) * 0.75, "diffuse");
}

TEST(MaterialExtensions, AnisotropyMakesTheTurnedTangentRougher) {
    Square square;
    square.material.anisotropy = { .strength = 0.6f, .rotationRadians = 0.5f, .map = {} };
    SurfaceSample surface = square.seen();
    const double across = 0.25, along = 0.25 + 0.75 * 0.36;
    EXPECT_NEAR(surface.stretchedAlpha.x, along, 1e-6);
    EXPECT_NEAR(surface.stretchedAlpha.y, across, 1e-6);
    EXPECT_NEAR(surface.anisotropy, (along - across) / (along + across), 1e-6);
    EXPECT_LT(glm::distance(surface.tangent, double3(std::cos(0.5), std::sin(0.5), 0)), 1e-4);
    // (0, 1) of the map, turned by half a radian; half the strength.
    square.material.anisotropy.map = square.texel({ 128, 255, 128, 255 });
    surface = square.seen();
    const double strength = 0.6 * 128 / 255;
    EXPECT_NEAR(surface.stretchedAlpha.x, 0.25 + 0.75 * strength * strength, 1e-6);
    EXPECT_NEAR(surface.stretchedAlpha.y, 0.25, 1e-6);
    EXPECT_LT(glm::distance(glm::normalize(surface.tangent), double3(-std::sin(0.5), std::cos(0.5), 0)), 5e-3);
    square.material.anisotropy.map = square.texel({ 128, 255, 0, 255 });
    EXPECT_EQ(square.seen().stretchedAlpha, double2(0.0)) << "round where the map says so";
    EXPECT_NEAR(square.seen().perceptualRoughness, 0.5, 1e-6);
}

TEST(MaterialExtensions, ThinTransmissionTakesItsPartOfTheDiffuseLobe) {
    Square square;
    square.material.metallicFactor = 0.5f;
    square.material.ior = 1.25f;
    square.material.transmission.factor = 0.75f;
    square.material.transmission.maps = { square.texel({ 51, 0, 0, 255 }), true, false };
    const SurfaceSample surface = square.seen(-1);
    expectNear(surface.transmission.color, double3(0.8, 0.4, 0.2) * (0.5 * 0.15), "through");
    expectNear(surface.diffuse, double3(0.8, 0.4, 0.2) * (0.5 * 0.85), "what is left");
    EXPECT_TRUE(surface.transmission.isThin);
    EXPECT_FALSE(surface.transmission.isFromInside);
    EXPECT_NEAR(surface.transmission.ior, 1.25, 1e-6);
    EXPECT_EQ(surface.transmission.absorption, double3(0.0));
}

TEST(MaterialExtensions, VolumesMeasureInTheMeshAndTheSceneOfTheFile) {
    Square square;
    square.material.transmission = { .factor = 1,
                                     .thicknessMeters = 0.5f,
                                     .attenuationColor = { 0.5f, 1, 0.25f },
                                     .attenuationDistanceMeters = 2,
                                     .dispersion = 0.3f,
                                     .maps = {} };
    square.material.transmission.maps = { square.texel({ 0, 102, 0, 255 }), false, true };
    square.sceneFromMesh = 3;
    square.worldFromScene = 10;
    const TransmissionSample below = square.seen(-1).transmission;
    EXPECT_FALSE(below.isThin);
    EXPECT_TRUE(below.isFromInside);
    EXPECT_NEAR(below.thickness, 0.5 * 0.4 * 3 * 10, 1e-5);
    EXPECT_NEAR(below.dispersion, 0.3, 1e-6);
    const double perMeter = std::log(2.0) / 2 / 10; // half after 2 m of the file, 20 m of the world
    expectNear(below.absorption, { perMeter, 0, 2 * perMeter }, "1/m");
    expectNear(below.color, { 0.8, 0.4, 0.2 }, "red of that map means nothing");
}

TEST(MaterialExtensions, DiffuseTransmissionSharesTheDiffuseLobeWithTheOtherSide) {
    Square square;
    square.material.metallicFactor = 0.5f;
    square.material.diffuseTransmission = { .color = { 1, 0.5f, 0 }, .factor = 0.8f, .maps = {} };
    square.material.diffuseTransmission.maps = { square.texel({ 255, 255, 255, 102 }, Format::RGBA8Srgb), true, true };
    const double part = 0.8 * 0.4;
    SurfaceSample surface = square.seen();
    expectNear(surface.diffuseTransmission.color, double3(1, 0.5, 0) * (0.5 * part), "behind");
    expectNear(surface.diffuse, double3(0.8, 0.4, 0.2) * (0.5 * (1 - part)), "in front");
    square.material.transmission.factor = 0.5f;
    surface = square.seen();
    expectNear(surface.diffuseTransmission.color, double3(1, 0.5, 0) * (0.25 * part), "behind, of what is not clear");
    expectNear(surface.diffuse, double3(0.8, 0.4, 0.2) * (0.25 * (1 - part)), "in front");
    expectNear(surface.transmission.color, double3(0.8, 0.4, 0.2) * 0.25, "clear");
}

TEST(MaterialExtensions, SpecularGlossinessTakesThePlaceOfMetallicAndRoughness) {
    Square square;
    square.material.metallicFactor = 1;
    square.material.specularGlossiness.emplace();
    square.material.specularGlossiness->specularFactor = { 1, 0.5f, 0.25f };
    square.material.specularGlossiness->glossinessFactor = 0.5f;
    square.material.specularGlossiness->map = square.texel({ 255, 188, 255, 204 }, Format::RGBA8Srgb);
    square.material.baseColorFactor = { 0.8f, 0.4f, 0.2f, 1 };
    const double green = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
    SurfaceSample surface = square.seen();
    expectNear(surface.f0, { 1, 0.5 * green, 0.25 }, "specular colour");
    expectNear(surface.diffuse, double3(0.0), "the largest component leaves nothing");
    EXPECT_EQ(surface.metallic, 0);
    EXPECT_NEAR(surface.perceptualRoughness, 1 - 0.5 * 0.8, 1e-6);
    square.material.specularGlossiness->specularFactor = float3(0.25f);
    expectNear(square.seen().diffuse, double3(0.8, 0.4, 0.2) * 0.75, "what is not reflected");
}

TEST(MaterialExtensions, WhatIsNotUsedIsNotThere) {
    const SurfaceSample surface = Square().seen();
    EXPECT_EQ(surface.coat.strength, 0);
    EXPECT_EQ(surface.sheen.color, double3(0.0));
    EXPECT_EQ(surface.stretchedAlpha, double2(0.0));
    EXPECT_FALSE(surface.transmits());
}

TEST(MaterialExtensions, TheSizeOfModelAndNodeReachesTheVolume) {
    // A ball of radius 1, drawn 10 times as large: light through its middle is halved by 2 m of the file.
    assets::MaterialData glass = lambert(1);
    glass.ior = 1; // nothing bends or reflects
    glass.transmission = {
        .factor = 1, .thicknessMeters = 2, .attenuationColor = float3(0.5f), .attenuationDistanceMeters = 2, .maps = {}
    };
    ReferenceScene scene{ .models = { { .data = makeModel(spherePrimitive(), glass),
                                        .worldFromModel = double4x4(double3x3(10.0)) } },
                          .environment = uniformSky() };
    scene.models[0].worldFromModel[3][3] = 1;
    const ReferenceView view = viewFrom({ 0, 0, 60 }, { 0, 0, 0 }, { 4, 4 }, 0.1f);
    expectAgrees(estimated(scene, view, { .samplesPerPixel = 16 }), double3(0.5), 2e-3);
}

TEST(MaterialExtensions, IridescenceIsTracedWithoutAWarning) {
    assets::MaterialData film = lambert(0.5f);
    film.iridescence.factor = 1;
    jobs::JobSystem jobs({ .workers = 1 });
    const Result<TracedScenePtr> traced =
            prepare({ .models = { { .data = makeModel(floorPrimitive(), film) } } }, jobs);
    ASSERT_TRUE(traced.ok()) << traced.error().message;
    EXPECT_TRUE(warnings(**traced).empty()) << warnings(**traced)[0];
}

} // namespace
} // namespace filament_core::reference
