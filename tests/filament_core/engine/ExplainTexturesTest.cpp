// SPDX-License-Identifier: Apache-2.0
// What each texture of a surface adds to a pixel: closed forms of products and of tilted normals.
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include "base/math/Half.h"

#include <filament_core/BuiltInMaterials.h>
#include <filament_core/ExplainPixel.h>
#include <filament_core/Gltf.h>
#include <filament_core/Image.h>

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
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

Owned<Texture> halfTexture(Engine& engine, float4 texel, const char* name, uint2 size = { 1, 1 }) {
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

double4 sumOfTextures(std::vector<PixelTexture> const& textures) {
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
        const Owned<Texture> base = halfTexture(stage.engine, { 0.5f, 0.25f, 1, 1 }, "bricks", { 4, 2 });
        Owned<Texture> detail = halfTexture(stage.engine, { 0.5f, 2, 0, 1 }, "scratches");
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
        EXPECT_EQ(sumOfTextures(explained.textures), explained.value);
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
            const Owned<Texture> normals = halfTexture(
                    stage.engine, { 0.5f + 0.5f * std::sin(angle), 0.5f, 0.5f + 0.5f * std::cos(angle), 1 }, "normals");
            ASSERT_TRUE(stage.engine.set(stage.instance, "normalMap", normals.get()));
            const PixelExplanation explained = explainedMiddle(stage.engine, scene);
            ASSERT_EQ(explained.textures.size(), 2u);
            const double flat = explained.textures[0].value.x;
            EXPECT_GT(flat, 0);
            EXPECT_NEAR(explained.textures[1].value.x / flat, std::cos(static_cast<double>(angle)) - 1, 5e-3);
            EXPECT_EQ(sumOfTextures(explained.textures), explained.value);
            texts.push_back(toJson(explained));
        }
    }
    EXPECT_EQ(std::vector(texts.begin(), texts.begin() + 2), std::vector(texts.begin() + 2, texts.end()));
}

/// Of the pixel in the middle: half a pixel right of the middle and below it.
const double kMiddleOffset = std::tan(40 * std::numbers::pi / 180) / 16;
const float2 kMiddleUv{ static_cast<float>((1 + kMiddleOffset) / 2),
                        static_cast<float>((1 + kMiddleOffset) / 2) }; // v downwards

TEST(ExplainTextures, OfBuiltInMaterialsHaveTheTexelsThatTheirShadersRead) {
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        test::SquareStage stage(backend, kProduct);
        const Owned<Material> material = stage.engine.own(*createBuiltInMaterial(stage.engine, "unlitTextured"));
        const Owned<MaterialInstance> instance = stage.engine.own(stage.engine.createInstance(material));
        std::array<std::array<uint8_t, 4>, 16> codes{};
        for (uint8_t i = 0; i < 16; ++i) codes[i] = { i, static_cast<uint8_t>(100 + i), 255, 0 };
        const Owned<Texture> texture = stage.engine.own(stage.engine.create(
                TextureDesc{ .width = 4, .height = 4, .pixels = std::as_bytes(std::span(codes)), .name = "codes" }));
        ASSERT_TRUE(stage.engine.set(instance, "baseColorMap", texture.get(), kUnfilteredSampler));
        Scene scene(stage.engine);
        stage.square.add(scene, instance);
        const Image before = test::renderLinear(stage.engine, scene, test::SquareMesh::view());
        const PixelExplanation explained = explainedMiddle(stage.engine, scene);
        ASSERT_EQ(explained.textures.size(), 2u);
        EXPECT_FALSE(explained.textures[0].uv || explained.textures[0].texel);
        ASSERT_TRUE(explained.textures[1].uv && explained.textures[1].texel);
        EXPECT_NEAR(explained.textures[1].uv->x, kMiddleUv.x, 1e-5);
        EXPECT_NEAR(explained.textures[1].uv->y, 1 - kMiddleUv.y, 1e-5); // v upwards
        const float3 texel = *explained.textures[1].texel;               // third of the second row
        EXPECT_NEAR(texel.x * 255, 6, 1e-5);
        EXPECT_NEAR(texel.y * 255, 106, 1e-5);
        EXPECT_EQ(texel.z, 1);
        EXPECT_EQ(test::renderLinear(stage.engine, scene, test::SquareMesh::view()).pixels, before.pixels);
        texts.push_back(toJson(explained));
    }
    EXPECT_EQ(texts[0], texts[1]);
}

/// A square with a texture of a red, a green, a blue and a white texel, of which a transform shows the middle half.
std::filesystem::path transformedSquare() {
    const std::filesystem::path folder = test::folderOfThisTest();
    constexpr std::array<float, 30> kNumbers{ -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0, // positions
                                              0,  1,  1, 1, 1,  0, 0, 1, 1, 0,  0,  0 };                  // uv
    std::ofstream(folder / "square.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(kNumbers.data()), sizeof kNumbers);
    constexpr std::array<uint8_t, 16> kTexels{ 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255 };
    const auto bytes = std::as_bytes(std::span(kTexels));
    EXPECT_TRUE(savePng(folder / "texels.png",
                        Image{ .width = 4, .height = 1, .pixels = std::vector(bytes.begin(), bytes.end()) }));
    std::ofstream(folder / "square.gltf") << R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_texture_transform"],
"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"name":"stripes","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"baseColorTexture":{"index":0,
"extensions":{"KHR_texture_transform":{"offset":[0.25,0],"scale":[0.5,1]}}}},"occlusionTexture":{"index":0}}],
"textures":[{"source":0,"sampler":0}],"images":[{"uri":"texels.png"}],"samplers":[{"magFilter":9728,"minFilter":9728}],
"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":6,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":48}],
"buffers":[{"byteLength":120,"uri":"square.bin"}]})";
    return folder / "square.gltf";
}

TEST(ExplainTextures, OfModelsAreWhereTheirTransformsPutThem) {
    const std::filesystem::path file = transformedSquare();
    std::vector<std::string> texts;
    for (const Backend backend : test::kBothApis) {
        Result<Engine> engine = Engine::create({ .backend = backend, .workers = 1, .validation = true });
        ASSERT_TRUE(engine);
        Result<Model> model = loadGltf(*engine, file);
        ASSERT_TRUE(model) << model.error().message;
        Scene scene(*engine);
        scene.add(*model);
        scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 3e4f } });
        const PixelExplanation explained = explainedMiddle(*engine, scene);
        ASSERT_EQ(explained.textures.size(), 3u);
        PixelTexture const &color = explained.textures[1], &occlusion = explained.textures[2];
        EXPECT_EQ(color.parameter, "baseColorMap");
        ASSERT_TRUE(color.uv && color.texel && occlusion.uv && occlusion.texel);
        EXPECT_NEAR(color.uv->x, 0.25 + 0.5 * kMiddleUv.x, 1e-5);
        EXPECT_NEAR(color.uv->y, kMiddleUv.y, 1e-5);
        EXPECT_EQ(*color.texel, float3(0, 0, 1)) << "the third; the factor is no part of it";
        EXPECT_EQ(occlusion.parameter, "occlusionMap");
        EXPECT_NEAR(occlusion.uv->x, kMiddleUv.x, 1e-5);
        EXPECT_EQ(*occlusion.texel, float3(0, 0, 1));
        EXPECT_EQ(sumOfTextures(explained.textures), explained.value);
        EXPECT_NEAR(explained.textures[1].value.z, 0, 1e-3) << "blue stays";
        EXPECT_LT(explained.textures[1].value.x, -1e-3);
        texts.push_back(toJson(explained));
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(texts[0], texts[1]);
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
