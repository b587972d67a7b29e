// SPDX-License-Identifier: Apache-2.0
// EXT_materials_bump on both APIs, against quads whose normals are tilted by the slope of the heights.
#include "tests/filament_core/engine/gltf/QuadFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Gltf.h>

#include <cmath>
#include <functional>
#include <memory>

namespace filament_core {
namespace {

using assets::MaterialData;
using test::MaterialStage;

constexpr int kMapSide = 16, kHeightStep = 17; // heights: 0 to 255

/// What a quad of 2 x 2 metres in the plane z = 0 is made of.
struct Quad {
    MaterialData material{ .name = "relief" };
    float3 normal{ 0, 0, 1 };
    std::vector<float2> uvs{ { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } }; ///< from the upper left, counter-clockwise
    bool isBack = false;
    float4x4 place{ 1.0f };
};

/// Image 0: heights that grow along u, by 1 over the whole texture (less its outer half texels). 1: even. 2: noise.
/// 3: a normal.
std::vector<assets::GlbImage> pictures() {
    std::vector<std::byte> texels[4];
    for (int y = 0; y < kMapSide; ++y) {
        for (int x = 0; x < kMapSide; ++x) {
            texels[0].insert(texels[0].end(), 4, static_cast<std::byte>(x * kHeightStep));
            texels[1].insert(texels[1].end(), 4, std::byte{ 77 });
            for (const int code : { 178, 128, 242, 255 }) texels[3].push_back(static_cast<std::byte>(code));
            texels[2].insert(texels[2].end(), 4, static_cast<std::byte>((x * 89 + y * 151 + x * y * 31) % 256));
        }
    }
    std::vector<assets::GlbImage> images;
    for (auto const& each : texels) images.push_back(*assets::glbImageFromPixels("heights", kMapSide, kMapSide, each));
    return images;
}

assets::BumpData relief(float factor, uint32_t image = 0) {
    assets::BumpData bump{ .factor = factor, .map = { .image = image } };
    bump.map.sampler = { .magFilter = Filter::Linear,
                         .minFilter = Filter::Linear,
                         .wrapU = WrapMode::ClampToEdge,
                         .wrapV = WrapMode::ClampToEdge };
    return bump;
}

Quad plain() {
    Quad quad;
    quad.material.metallicFactor = 0;
    quad.material.roughnessFactor = 0.6f;
    quad.material.doubleSided = true;
    return quad;
}

/// 24 pixels for the middle 1.5 metres of the quad, under a sun.
Image pictureOf(Quad const& quad) {
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Model> model = loadGltf(
                stage.engine, GltfMemory{ .file = test::quadFile(pictures(), quad.material, quad.uvs, quad.normal),
                                          .name = "relief.glb" });
        ASSERT_TRUE(model) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept, double4x4(quad.place));
        stage.scene.add(
                SunLight{ .directionWorld = { -0.4f, -0.3f, quad.isBack ? 1.0f : -1.0f }, .illuminance = Lux{ 3 } });
        const float z = quad.isBack ? -1.0f : 1.0f;
        stage.view.camera = Camera::lookAt({ 0, 0, z * 0.75f }, { 0, 0, 0 }, { .verticalFovDegrees = 90 });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        stage.view.size = { 24, 24 };
    });
}

void expectSame(Image const& a, Image const& b, const char* what) {
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x)
            ASSERT_EQ(test::halfPixel(a, x, y), test::halfPixel(b, x, y)) << what << " at " << x << ", " << y;
    }
}

/// The largest difference, as a share of the brightest value of `expected`.
float differenceFrom(Image const& expected, Image const& picture) { // both have to be finite
    float largest = 0, brightest = 0;
    for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x) {
            const float4 is = test::halfPixel(picture, x, y), should = test::halfPixel(expected, x, y);
            EXPECT_TRUE(std::isfinite(is.x)) << x << ", " << y;
            largest = std::max(largest, std::abs(is.x - should.x));
            brightest = std::max(brightest, should.x);
        }
    }
    return largest / brightest;
}

// Heights of 1 over 15/16 of the texture, which is 2 metres wide.
float slopeOf(float factor) { return factor * kMapSide * kHeightStep / 255.0f / 2.0f; }

TEST(Bump, ARampShadesLikeAPlaneOfItsSlope) {
    Quad ramp = plain(), tilted = plain();
    ramp.material.bump = relief(0.7f);
    tilted.normal = { -slopeOf(0.7f), 0, 1 };
    const Image expected = pictureOf(tilted);
    EXPECT_GT(differenceFrom(expected, pictureOf(plain())), 0.1f);
    EXPECT_LT(differenceFrom(expected, pictureOf(ramp)), 0.01f);
    ramp.material.bump.factor = -0.7f;
    tilted.normal.x = slopeOf(0.7f);
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(ramp)), 0.01f) << "dents";
}

TEST(Bump, MirroredAndTransformedCoordinatesHaveTheirSlope) {
    Quad ramp = plain(), tilted = plain();
    ramp.material.bump = relief(0.7f);
    ramp.uvs = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };
    tilted.normal = { slopeOf(0.7f), 0, 1 };
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(ramp)), 0.01f) << "mirrored";
    ramp = plain();
    ramp.material.bump = relief(0.7f);
    ramp.material.bump.map.hasTransform = true; // u and v exchanged; v grows downwards
    ramp.material.bump.map.uvTransform = { float3(0, 1, 0), float3(-1, 0, 0), float3(1, 0, 1) };
    tilted.normal = { 0, -slopeOf(0.7f), 1 };
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(ramp)), 0.01f) << "turned";
}

TEST(Bump, FromBehindItIsTheSameRelief) {
    Quad ramp = plain(), tilted = plain();
    ramp.material.bump = relief(0.7f);
    tilted.normal = { -slopeOf(0.7f), 0, 1 };
    ramp.isBack = tilted.isBack = true;
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(ramp)), 0.01f);
}

TEST(Bump, HeightsAreMetresOfTheWorld) {
    Quad ramp = plain(), tilted = plain();
    ramp.material.bump = relief(0.7f);
    ramp.place = tilted.place =
            float4x4(float4(2, 0, 0, 0), float4(0, 2, 0, 0), float4(0, 0, 2, 0), float4(0, 0, 0, 1));
    tilted.normal = { -slopeOf(0.35f), 0, 1 };
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(ramp)), 0.01f);
}

TEST(Bump, WhereTheHeightIsEvenNoBitChanges) {
    Quad quad = plain();
    const Image bare = pictureOf(quad);
    quad.material.bump = relief(3, 1);
    expectSame(pictureOf(quad), bare, "even heights");
    quad.material.bump = relief(0, 2);
    expectSame(pictureOf(quad), bare, "no height");
    quad.material.bump = relief(3, 2);
    quad.uvs = std::vector<float2>(4, float2(0.3f, 0.6f));
    expectSame(pictureOf(quad), bare, "a triangle without an area of texture");
    quad.material.bump.map.uvSet = 1;
    expectSame(pictureOf(quad), bare, "coordinates that the mesh does not have");
}

TEST(Bump, NoFactorAndNoCoordinatesGiveNaN) {
    for (const float factor : { 65504.0f, -65504.0f, 1e-38f }) {
        Quad quad = plain();
        quad.material.bump = relief(factor, 2);
        differenceFrom(pictureOf(quad), pictureOf(quad));
        quad.uvs = { { -3e38f, -3e38f }, { 3e38f, 3e38f }, { 3e38f, -3e38f }, { 0, 3e38f } }; // derivatives overflow
        differenceFrom(pictureOf(quad), pictureOf(quad));
    }
}

TEST(Bump, OnANormalMapTheSlopesAddUp) {
    Quad both = plain(), tilted = plain();
    both.material.bump = relief(0.7f);
    both.material.normal = relief(1, 3).map;
    const float3 mapped = float3(178, 128, 242) / 127.5f - 1.0f;
    tilted.normal = { mapped.x / mapped.z - slopeOf(0.7f), -mapped.y / mapped.z, 1 }; // v grows downwards
    EXPECT_LT(differenceFrom(pictureOf(tilted), pictureOf(both)), 0.01f);
}

} // namespace
} // namespace filament_core
