// SPDX-License-Identifier: Apache-2.0
// GltfLoadOptions::normalMapRoughness on both APIs: stripes that a pixel averages look like an even surface that is as
// much rougher, whatever maps the material has.
#include "filament_core/assets/image/NormalVariance.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/engine/gltf/QuadFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"
#include "toolkit/showcase/SceneBuilder.h"

#include <filament_core/Gltf.h>

#include <cmath>
#include <memory>

namespace filament_core {
namespace {

using assets::MaterialData;
using test::MaterialStage;

constexpr int kImageSide = 2;
constexpr float kRepeats = 96; ///< of the maps over the quad: eight texels a pixel
enum Map : uint32_t { kStripes, kEven, kHalf };

/// kStripes: normals that lean to both sides, 0.32 of their length. kHalf: 0.5 in each channel.
std::vector<assets::GlbImage> mapsOfQuad() {
    std::vector<std::byte> texels[3];
    const auto add = [&](Map map, std::initializer_list<int> codes) {
        for (const int code : codes) texels[map].push_back(static_cast<std::byte>(code));
    };
    for (int i = 0; i < kImageSide * kImageSide; ++i) {
        add(kStripes, { i % 2 ? 168 : 87, 128, 248, 255 });
        add(kEven, { 128, 128, 255, 255 });
        add(kHalf, { 128, 128, 128, 128 });
    }
    std::vector<assets::GlbImage> images;
    for (auto const& each : texels) images.push_back(*assets::glbImageFromPixels("map", kImageSide, kImageSide, each));
    return images;
}

/// The width of the last level of the stripes, as the texture stores it.
float widthOfStripes() {
    assets::Image image{ .width = kImageSide, .height = kImageSide, .levels = 2, .data = {} };
    for (int i = 0; i < kImageSide * kImageSide; ++i)
        for (const int code : { i % 2 ? 168 : 87, 128, 248, 255 }) image.data.push_back(static_cast<std::byte>(code));
    image.data.resize(image.data.size() + 4);
    return static_cast<float>(std::to_integer<int>(assets::withNormalVariance(std::move(image)).data.back())) / 255;
}

MaterialData striped(Map normals = kStripes) {
    MaterialData material{ .name = "stripes" };
    material.metallicFactor = 1;
    material.roughnessFactor = 0.3f;
    material.normal = showcase::textured(normals);
    return material;
}

std::vector<std::byte> quadOf(MaterialData const& material) {
    return test::quadFile(mapsOfQuad(), material, { { 0, 0 }, { 0, kRepeats }, float2(kRepeats), { kRepeats, 0 } });
}

/// 24 pixels for the middle 1.5 metres of the quad.
Image pictureUnderSun(MaterialData const& material, bool isOn) {
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Model> model = loadGltf(stage.engine, GltfMemory{ .file = quadOf(material), .name = "stripes.glb" },
                                       { .normalMapRoughness = isOn });
        ASSERT_TRUE(model) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept);
        stage.scene.add(SunLight{ .directionWorld = { -0.2f, -0.1f, -1.0f }, .illuminance = Lux{ 3 } });
        stage.view.camera = Camera::lookAt({ 0, 0, 0.75f }, { 0, 0, 0 }, { .verticalFovDegrees = 90 });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        stage.view.size = { 24, 24 };
    });
}

float largestDifference(Image const& a, Image const& b) {
    float largest = 0;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            const float4 one = test::halfPixel(a, x, y), other = test::halfPixel(b, x, y);
            largest = std::max(largest, std::abs(one.x - other.x) / std::max(one.x, 0.02f));
        }
    }
    return largest;
}

/// The stripes beside the even map with the roughness that they add up to.
void expectLike(MaterialData const& wide, MaterialData const& rougher) {
    const Image picture = pictureUnderSun(wide, true);
    EXPECT_LT(largestDifference(pictureUnderSun(rougher, false), picture), 0.02f);
    EXPECT_GT(largestDifference(pictureUnderSun(wide, false), picture), 0.1f) << "it shows";
}

float widened(float roughness, float scale = 1) {
    return shader::lib::widenedPerceptualRoughness(roughness, widthOfStripes() * scale);
}

TEST(NormalMapRoughness, IsThatOfTheAveragedNormals) {
    EXPECT_NEAR(widthOfStripes(), 0.319, 0.002) << "a mean of the length 0.948";
    MaterialData rougher = striped(kEven);
    rougher.roughnessFactor = widened(rougher.roughnessFactor);
    expectLike(striped(), rougher);
}

TEST(NormalMapRoughness, GrowsWithTheScaleOfTheMap) {
    for (const float scale : { 0.5f, -1.0f }) {
        MaterialData scaled = striped(), rougher = striped(kEven);
        scaled.normalScale = rougher.normalScale = scale;
        rougher.roughnessFactor = widened(rougher.roughnessFactor, scale);
        expectLike(scaled, rougher);
    }
}

TEST(NormalMapRoughness, AddsToARoughnessMapThatIsReadOtherwise) {
    MaterialData mapped = striped(), rougher = striped(kEven);
    mapped.roughnessFactor = 0.4f;
    mapped.normalScale = rougher.normalScale = 0.5f; // so that no factor exceeds 1
    mapped.metallicRoughness = showcase::textured(kHalf);
    mapped.metallicRoughness.sampler.minFilter = mapped.metallicRoughness.sampler.magFilter = Filter::Nearest;
    mapped.metallicRoughness.hasTransform = true;
    mapped.metallicRoughness.uvTransform = float3x3(0.3f, 0, 0, 0, 0.2f, 0, 0.1f, 0, 1);
    rougher.metallicRoughness = showcase::textured(kHalf);
    rougher.roughnessFactor = widened(0.4f * 128 / 255, 0.5f) * 255 / 128;
    expectLike(mapped, rougher);
}

TEST(NormalMapRoughness, LeavesEvenMapsAsTheyAre) {
    EXPECT_LT(largestDifference(pictureUnderSun(striped(kEven), false), pictureUnderSun(striped(kEven), true)), 0.002f);
}

} // namespace
} // namespace filament_core
