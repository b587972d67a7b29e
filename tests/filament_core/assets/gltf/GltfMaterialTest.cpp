// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets::test {
namespace {

using backend::Filter;
using backend::MipFilter;
using backend::WrapMode;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A triangle with a material, a texture and a 2 x 1 image: black, white.
TestFile texturedTriangle(Json material) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    const std::array<uint8_t, 8> pixels{ 0, 0, 0, 255, 255, 255, 255, 255 };
    const GlbImage image = *glbImageFromPixels("image", 2, 1, std::as_bytes(std::span(pixels)));
    file.root["images"] = { { { "bufferView", file.addView(image.file) }, { "mimeType", "image/png" } } };
    file.root["textures"] = { { { "source", 0 } } };
    file.root["materials"] = { std::move(material) };
    file.primitive()["material"] = 0;
    return file;
}

MaterialData onlyMaterial(Json material) {
    const ModelData model = loaded(texturedTriangle(std::move(material)));
    return model.materials.size() == 1 ? model.materials[0] : MaterialData{};
}

TEST(GltfMaterial, AnEmptyMaterialHasTheDefaultsOfTheSpecification) {
    const MaterialData material = onlyMaterial(Json::object());
    EXPECT_EQ(material.baseColorFactor, float4(1.0f));
    EXPECT_EQ(material.metallicFactor, 1.0f);
    EXPECT_EQ(material.roughnessFactor, 1.0f);
    EXPECT_EQ(material.emissiveFactor, float3(0.0f));
    EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
    EXPECT_EQ(material.alphaCutoff, 0.5f);
    EXPECT_FALSE(material.doubleSided || material.unlit);
    EXPECT_EQ(material.baseColor.image, kNone);
}

TEST(GltfMaterial, EveryFieldIsRead) {
    const MaterialData material = onlyMaterial(Json::parse(R"({ "name": "all",
        "pbrMetallicRoughness": { "baseColorFactor": [ 0.1, 0.2, 0.3, 0.4 ], "metallicFactor": 0.5, "roughnessFactor": 0.6,
            "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0, "texCoord": 1 } },
        "normalTexture": { "index": 0, "scale": 2 }, "occlusionTexture": { "index": 0, "strength": 0.25 },
        "emissiveTexture": { "index": 0 }, "emissiveFactor": [ 1, 0.5, 0 ], "alphaMode": "MASK", "alphaCutoff": 0.75,
        "doubleSided": true, "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 12 } } })"));
    EXPECT_EQ(material.name, "all");
    EXPECT_EQ(material.baseColorFactor, float4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.metallicFactor, 0.5f);
    EXPECT_EQ(material.roughnessFactor, 0.6f);
    EXPECT_EQ(material.metallicRoughness.uvSet, 1u);
    EXPECT_EQ(material.normalScale, 2.0f);
    EXPECT_EQ(material.occlusionStrength, 0.25f);
    EXPECT_EQ(material.emissiveFactor, float3(1, 0.5f, 0));
    EXPECT_EQ(material.emissiveStrength, 12.0f);
    EXPECT_EQ(material.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(material.alphaCutoff, 0.75f);
    EXPECT_TRUE(material.doubleSided);
}

TEST(GltfMaterial, AnImageUsedAsColourAndAsDataBecomesTwo) {
    const ModelData model = loaded(texturedTriangle(Json::parse(R"({ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } },
        "occlusionTexture": { "index": 0 }, "emissiveTexture": { "index": 0 } })")));
    ASSERT_EQ(model.images.size(), 2u);
    MaterialData const& material = model.materials[0];
    EXPECT_EQ(material.baseColor.image, material.emissive.image);
    EXPECT_EQ(material.metallicRoughness.image, material.occlusion.image);
    EXPECT_EQ(model.images[material.baseColor.image].format, backend::Format::RGBA8Srgb);
    EXPECT_EQ(model.images[material.occlusion.image].format, backend::Format::RGBA8);
    // the middle between black and white is 0.735 in sRGB for light, but 0.5 for a plain number
    EXPECT_EQ(model.images[material.baseColor.image].data[8], std::byte{ 188 });
    EXPECT_EQ(model.images[material.occlusion.image].data[8], std::byte{ 128 });
}

TEST(GltfMaterial, UnlitMaterialsDecodeNothingButTheirBaseColour) {
    const ModelData model = loaded(texturedTriangle(Json::parse(R"({ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } },
        "extensions": { "KHR_materials_unlit": {} } })")));
    EXPECT_TRUE(model.materials[0].unlit);
    EXPECT_EQ(model.images.size(), 1u);
}

TEST(GltfMaterial, MaterialsThatNothingUsesAreLeftOut) {
    TestFile file = texturedTriangle(Json::parse(R"({ "name": "unused", "emissiveTexture": { "index": 0 } })"));
    file.root["materials"].push_back({ { "name", "used" } });
    file.primitive()["material"] = 1;
    const ModelData model = loaded(file);
    ASSERT_EQ(model.materials.size(), 1u);
    EXPECT_EQ(model.materials[0].name, "used");
    EXPECT_EQ(model.meshes[0].primitives[0].material, 0u);
    EXPECT_THAT(model.images, IsEmpty());
}

TEST(GltfMaterial, SamplersTranslateEveryModeOfOpenGl) {
    struct Case {
        int minFilter;
        Filter filter;
        MipFilter mips;
    };
    for (const Case c : { Case{ 9728, Filter::Nearest, MipFilter::None },
                          { 9729, Filter::Linear, MipFilter::None },
                          { 9984, Filter::Nearest, MipFilter::Nearest },
                          { 9985, Filter::Linear, MipFilter::Nearest },
                          { 9986, Filter::Nearest, MipFilter::Linear },
                          { 9987, Filter::Linear, MipFilter::Linear } }) {
        TestFile file = texturedTriangle(Json::parse(R"({ "emissiveTexture": { "index": 0 } })"));
        file.root["samplers"] = {
            { { "minFilter", c.minFilter }, { "magFilter", 9728 }, { "wrapS", 33071 }, { "wrapT", 33648 } }
        };
        file.root["textures"][0]["sampler"] = 0;
        const Sampler sampler = loaded(file).materials.at(0).emissive.sampler;
        EXPECT_EQ(sampler.minFilter, c.filter) << c.minFilter;
        EXPECT_EQ(sampler.mipFilter, c.mips) << c.minFilter;
        EXPECT_EQ(sampler.magFilter, Filter::Nearest);
        EXPECT_EQ(sampler.wrapU, WrapMode::ClampToEdge);
        EXPECT_EQ(sampler.wrapV, WrapMode::MirroredRepeat);
    }
}

TEST(GltfMaterial, TexturesWithoutASamplerRepeatAndFilter) {
    const TextureRef texture = onlyMaterial(Json::parse(R"({ "emissiveTexture": { "index": 0 } })")).emissive;
    EXPECT_EQ(texture.sampler.wrapU, WrapMode::Repeat);
    EXPECT_EQ(texture.sampler.minFilter, Filter::Linear);
    EXPECT_EQ(texture.sampler.mipFilter, MipFilter::Linear);
    EXPECT_FALSE(texture.hasTransform);
}

float2 transformed(TextureRef const& texture, float2 uv) { return float2(texture.uvTransform * float3(uv, 1.0f)); }

// The quads of TextureTransformTest: an arrow with its tip at (7/9, 7/9) of the image, and green markers where the tip
// must appear on the quad. The file gives the positions in the quad's coordinates.
TEST(GltfMaterial, TextureTransformsPutTheArrowsOfTheTestModelOntoTheirMarkers) {
    const TextureRef turned = onlyMaterial(Json::parse(R"({ "emissiveTexture": { "index": 0, "extensions": {
        "KHR_texture_transform": { "rotation": 0.39269908169872414 } } } })"))
                                      .emissive;
    const float2 marker(0.5f - 0.07904822f, 0.5f + 0.51626748f);
    EXPECT_NEAR(transformed(turned, marker).x, 7 / 9.0f, 1e-4f);
    EXPECT_NEAR(transformed(turned, marker).y, 7 / 9.0f, 1e-4f);

    const TextureRef scaled = onlyMaterial(Json::parse(R"({ "emissiveTexture": { "index": 0, "extensions": {
        "KHR_texture_transform": { "scale": [ 1.5, 1.5 ] } } } })"))
                                      .emissive;
    EXPECT_NEAR(transformed(scaled, float2(0.5f + 0.018544973f)).x, 7 / 9.0f, 1e-4f);
    EXPECT_TRUE(scaled.hasTransform);
}

TEST(GltfMaterial, TextureTransformsScaleThenTurnThenMove) {
    const TextureRef texture =
            onlyMaterial(Json::parse(R"({ "emissiveTexture": { "index": 0, "texCoord": 0, "extensions": {
        "KHR_texture_transform": { "offset": [ 10, 20 ], "rotation": 1.5707963267948966, "scale": [ 2, 3 ], "texCoord": 1 } } } })"))
                    .emissive;
    EXPECT_EQ(texture.uvSet, 1u);                         // the extension's set wins
    const float2 uv = transformed(texture, float2(1, 1)); // (2, 3), turned to (3, -2), moved
    EXPECT_NEAR(uv.x, 13, 1e-5f);
    EXPECT_NEAR(uv.y, 18, 1e-5f);
}

TEST(GltfMaterial, FactorsOutsideTheirRangeAreClampedWithAWarning) {
    const ModelData model = loaded(texturedTriangle(Json::parse(
            R"({ "pbrMetallicRoughness": { "metallicFactor": 7, "baseColorFactor": [ 1, -2, 1, 1 ] }, "alphaMode": "FOG" })")));
    EXPECT_EQ(model.materials[0].metallicFactor, 1.0f);
    EXPECT_EQ(model.materials[0].baseColorFactor.y, 0.0f);
    EXPECT_EQ(model.materials[0].alphaMode, AlphaMode::Opaque);
    EXPECT_THAT(model.warnings,
                ElementsAre(AllOf(HasSubstr("materials[0].pbrMetallicRoughness.baseColorFactor"), HasSubstr("-2")),
                            HasSubstr("materials[0].pbrMetallicRoughness.metallicFactor: 7"), HasSubstr("'FOG'")));
}

TEST(GltfMaterial, UnknownExtensionsAreNamedOnceAndTheBaseMaterialIsLoaded) {
    TestFile file = texturedTriangle(Json::parse(R"({ "name": "car", "extensions": { "EXT_wax": {} } })"));
    file.root["extensionsUsed"] = { "EXT_wax", "KHR_materials_unlit" };
    const ModelData model = loaded(file);
    EXPECT_EQ(model.materials[0].name, "car");
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("EXT_wax")));
}

TEST(GltfMaterial, AnUnknownExtensionThatTheFileRequiresIsAnError) {
    TestFile file = texturedTriangle(Json::parse("{}"));
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = { "KHR_materials_unlit", "EXT_must" };
    const Result<ModelData> model = file.load();
    ASSERT_FALSE(model);
    EXPECT_THAT(model.error().message, HasSubstr("extension EXT_must is required by the file but not supported"));
}

TEST(GltfMaterial, ATextureInAFormatThatIsNotReadIsAnError) {
    TestFile file = texturedTriangle(Json::parse(R"({ "emissiveTexture": { "index": 0 } })"));
    file.root["textures"][0] = Json::parse(R"({ "extensions": { "VENDOR_texture": { "source": 0 } } })");
    const Result<ModelData> model = file.load();
    ASSERT_FALSE(model);
    EXPECT_THAT(model.error().message, HasSubstr("textures[0]: has no PNG, JPEG, WebP, AVIF, KTX2 or DDS image"));
}

TEST(GltfMaterial, ImagesComeFromDataUrisAndFilesWithEncodedNames) {
    const std::array<uint8_t, 4> pixel{ 10, 20, 30, 255 };
    const GlbImage image = *glbImageFromPixels("image", 1, 1, std::as_bytes(std::span(pixel)));
    const auto folder = std::filesystem::path(testing::TempDir()) / "gltf images";
    std::filesystem::create_directories(folder / "a b");
    FILE* file = std::fopen((folder / "a b" / "c%.png").c_str(), "wb");
    ASSERT_TRUE(file);
    std::fwrite(image.file.data(), 1, image.file.size(), file);
    std::fclose(file);
    jobs::JobSystem jobs({ .workers = 0 });
    for (const char* uri : { "a%20b/c%25.png", "./a b/c%.png", "a b/../a%20b/c%25.png" }) {
        TestFile gltf = texturedTriangle(Json::parse(R"({ "emissiveTexture": { "index": 0 } })"));
        gltf.root["images"][0] = { { "uri", uri } };
        const Result<ModelData> model = loadGltfFromMemory(gltf.glb(), folder, jobs);
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_EQ(model->images[0].data[2], std::byte{ 30 });
    }
    std::filesystem::remove_all(folder);
}

TEST(GltfMaterial, LargeTexturesStartAtASmallerLevel) {
    TestFile file = texturedTriangle(Json::parse(R"({ "emissiveTexture": { "index": 0 } })"));
    const Result<ModelData> model = file.load({ .maxTextureSize = 1 });
    ASSERT_TRUE(model);
    EXPECT_EQ(model->images[0].width, 1u);
    EXPECT_EQ(model->images[0].levels, 1u);
    EXPECT_EQ(model->images[0].data[0], std::byte{ 188 });
}

TEST(GltfMaterial, LightsHaveTheDefaultsOfTheirExtension) {
    TestFile file = TestFile::triangle();
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([ { "type": "spot" },
        { "type": "directional", "color": [ 1, 0.5, 0.25 ], "intensity": 4 }, { "type": "point", "range": 3 } ])");
    file.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    const ModelData model = loaded(file);
    ASSERT_EQ(model.lights.size(), 3u);
    EXPECT_EQ(model.lights[0].type, LightType::Spot);
    EXPECT_EQ(model.lights[0].innerConeRadians, 0.0f);
    EXPECT_FLOAT_EQ(model.lights[0].outerConeRadians, 3.14159265f / 4);
    EXPECT_EQ(model.lights[1].color, float3(1, 0.5f, 0.25f));
    EXPECT_EQ(model.lights[2].rangeMeters, 3.0f);
    ASSERT_EQ(model.nodes.size(), 1u); // it carries the mesh and the light
    EXPECT_EQ(model.nodes[0].light, 1u);
    EXPECT_EQ(model.nodes[0].mesh, 0u);
}

// The engine asserts 0 <= inner < outer <= pi/2.
TEST(GltfMaterial, SpotsWhoseInnerConeIsNotInsideTheOuterOneAreNarrowed) {
    TestFile file = TestFile::triangle();
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
        { "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.5 } },
        { "type": "spot", "spot": { "innerConeAngle": 0.6, "outerConeAngle": 0.5 } },
        { "type": "spot", "spot": { "innerConeAngle": 0.5, "outerConeAngle": 0.50000000001 } },
        { "type": "spot", "spot": { "outerConeAngle": 0 } },
        { "type": "spot", "spot": { "innerConeAngle": -1, "outerConeAngle": -0.5 } },
        { "type": "spot", "spot": { "innerConeAngle": 2, "outerConeAngle": 3 } },
        { "type": "spot", "spot": { "innerConeAngle": 1 } } ])");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.lights.size(), 7u);
    for (LightData const& light : model.lights) {
        EXPECT_GE(light.innerConeRadians, 0.0f);
        EXPECT_LT(light.innerConeRadians, light.outerConeRadians);
        EXPECT_LE(light.outerConeRadians, 1.5707964f);
    }
    EXPECT_EQ(model.lights[0].outerConeRadians, 0.5f) << "the light keeps its size";
    EXPECT_EQ(model.lights[0].innerConeRadians, std::nextafter(0.5f, 0.0f)) << "and its hard edge";
    EXPECT_THAT(model.warnings,
                testing::Contains(testing::HasSubstr("lights[0].spot: the inner cone is not inside of the outer one")));
}

TEST(GltfMaterial, ProgressCountsEveryImageAndPrimitive) {
    TestFile file = texturedTriangle(Json::parse(R"({ "emissiveTexture": { "index": 0 } })"));
    std::vector<std::string> steps;
    GltfOptions options;
    options.progress = [&](GltfStage stage, size_t done, size_t total) {
        steps.push_back(fmt::format("{} {}/{}", stage == GltfStage::Structure ? "structure" : "content", done, total));
    };
    ASSERT_TRUE(file.load(options));
    EXPECT_THAT(steps, ElementsAre("structure 0/1", "structure 1/1", "content 0/2", "content 1/2", "content 2/2"));
}

} // namespace
} // namespace filament_core::assets::test
