// SPDX-License-Identifier: Apache-2.0
// What each texture of a surface adds to a pixel: closed forms of products and of tilted normals.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include "base/math/Half.h"

#include <filament_core/ExplainPixel.h>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace filament_core {
namespace {

constexpr const char* kProduct = R"(material { name : product, shadingModel : unlit, requires : [ uv0 ], parameters : [
    { type : sampler2d, name : baseColorMap }, { type : sampler2d, name : detailMap }, { type : sampler2d, name : spare },
    { type : sampler2d, name : codes, format : uint } ] }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = 3.0 * texture(materialParams_baseColorMap, getUV0()).rgb
            * texture(materialParams_detailMap, 2.0 * getUV0()).rgb * texture(materialParams_spare, getUV0()).r
            * float(texture(materialParams_codes, getUV0()).r);
} })";

constexpr const char* kChalkWithNormals = R"(material { name : chalk, requires : [ uv0, tangents ],
    variantFilter : [ dynamicLighting, shadowReceiver, skinning, fog ], parameters : [
    { type : sampler2d, name : normalMap } ] }
fragment { void material(inout MaterialInputs material) {
    material.normal = texture(materialParams_normalMap, getUV0()).xyz * 2.0 - 1.0;
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.5);
    material.roughness = 1.0;
    material.reflectance = 0.0;
} })";

Owned<Texture> halves(Engine& engine, float4 texel, const char* name, uint2 size = { 1, 1 }) {
    std::vector<std::array<uint16_t, 4>> pixels(size_t{ size.x } * size.y);
    for (auto& pixel : pixels)
        for (int i = 0; i < 4; ++i) pixel[static_cast<size_t>(i)] = halfFromFloat(texel[i]);
    return engine.own(engine.create(TextureDesc{ .format = Format::RGBA16F,
                                                 .width = size.x,
                                                 .height = size.y,
                                                 .pixels = std::as_bytes(std::span(pixels)),
                                                 .name = name }));
}

PixelExplanation explainedMiddle(Engine& engine, Scene const& scene) {
    Result<PixelExplanation> explained = explainPixel(engine, scene, test::SquareMesh::view(), uint2(8));
    if (explained) return std::move(*explained);
    ADD_FAILURE() << explained.error().message;
    return {};
}

double4 sumOf(std::vector<PixelTexture> const& textures) {
    double4 sum(0);
    for (PixelTexture const& texture : textures) sum += texture.value;
    return sum;
}

// All numbers are exact in half floats.
TEST(ExplainTextures, OfAProductChangeItInTurn) {
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend, kProduct);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.instance);
        const Owned<Texture> base = halves(stage.engine, { 0.5f, 0.25f, 1, 1 }, "bricks", { 4, 2 });
        Owned<Texture> detail = halves(stage.engine, { 0.5f, 2, 0, 1 }, "scratches");
        const uint32_t one = 1;
        const Owned<Texture> codes = stage.engine.own(stage.engine.create(
                TextureDesc{ .format = Format::R32UI, .pixels = std::as_bytes(std::span(&one, 1)), .name = "codes" }));
        ASSERT_TRUE(stage.engine.set(stage.instance, "baseColorMap", base.get()));
        ASSERT_TRUE(stage.engine.set(stage.instance, "detailMap", detail.get()));
        ASSERT_TRUE(stage.engine.set(stage.instance, "codes", codes.get()));
        detail.reset(); // the instance keeps it
        const Image before = test::renderLinear(stage.engine, scene, test::SquareMesh::view());
        const PixelExplanation explained = explainedMiddle(stage.engine, scene);
        ASSERT_EQ(explained.textures.size(), 3u) << "what was not set, and codes, are left out";
        EXPECT_EQ(explained.textures[0].parameter, "");
        EXPECT_EQ(explained.textures[1].parameter, "baseColorMap");
        EXPECT_EQ(explained.textures[1].texture, "bricks");
        EXPECT_EQ(explained.textures[1].size, uint2(4, 2));
        EXPECT_EQ(explained.textures[2].parameter, "detailMap");
        EXPECT_EQ(double3(explained.textures[0].value), double3(3));
        EXPECT_EQ(double3(explained.textures[1].value), double3(1.5, 0.75, 3) - double3(3));
        EXPECT_EQ(double3(explained.textures[2].value), double3(0.75, 1.5, 0) - double3(1.5, 0.75, 3));
        EXPECT_EQ(sumOf(explained.textures), explained.value);
        EXPECT_EQ(test::renderLinear(stage.engine, scene, test::SquareMesh::view()).pixels, before.pixels);
        texts.push_back(toJson(explained));
    }
    EXPECT_EQ(texts[0], texts[1]);
    EXPECT_THAT(texts[0], testing::HasSubstr("\"texture\": \"bricks\""));
}

// A normal that is tilted by 60 degrees takes half of the light from the front; a flat one nothing.
TEST(ExplainTextures, OfNormalsTakeTheLightThatTheyTurnFrom) {
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend, kChalkWithNormals);
        Scene scene(stage.engine);
        stage.square.add(scene, stage.instance);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 3e4f } });
        for (const float degrees : { 0.0f, 60.0f }) {
            const float angle = degrees * std::numbers::pi_v<float> / 180;
            const Owned<Texture> normals = halves(
                    stage.engine, { 0.5f + 0.5f * std::sin(angle), 0.5f, 0.5f + 0.5f * std::cos(angle), 1 }, "normals");
            ASSERT_TRUE(stage.engine.set(stage.instance, "normalMap", normals.get()));
            const PixelExplanation explained = explainedMiddle(stage.engine, scene);
            ASSERT_EQ(explained.textures.size(), 2u);
            const double flat = explained.textures[0].value.x;
            EXPECT_GT(flat, 0);
            EXPECT_NEAR(explained.textures[1].value.x / flat, std::cos(static_cast<double>(angle)) - 1, 5e-3);
            EXPECT_EQ(sumOf(explained.textures), explained.value);
            texts.push_back(toJson(explained));
        }
    }
    EXPECT_EQ(std::vector(texts.begin(), texts.begin() + 2), std::vector(texts.begin() + 2, texts.end()));
}

TEST(ExplainTextures, AreNoneOfMaterialsWithout) {
    test::SquareStage stage(Backend::Gles, kProduct);
    Scene scene(stage.engine);
    stage.square.add(scene, stage.instance);
    const PixelExplanation explained = explainedMiddle(stage.engine, scene);
    EXPECT_TRUE(explained.textures.empty());
    EXPECT_EQ(toJson(explained).find("textures"), std::string::npos);
}

} // namespace
} // namespace filament_core
