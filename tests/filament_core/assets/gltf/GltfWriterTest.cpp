// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::HasSubstr;

constexpr Sampler kClamped{ .magFilter = backend::Filter::Nearest,
                            .minFilter = backend::Filter::Linear,
                            .mipFilter = backend::MipFilter::Nearest,
                            .wrapU = backend::WrapMode::ClampToEdge,
                            .wrapV = backend::WrapMode::MirroredRepeat };

GlbImage checkerboard(uint8_t alpha) {
    const std::array<uint8_t, 16> pixels{ 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, alpha };
    return *glbImageFromPixels("checker", 2, 2, std::as_bytes(std::span(pixels)));
}

GlbScene exampleScene() {
    GlbScene scene{ .name = "example", .copyright = "nobody" };
    scene.images = { checkerboard(255), checkerboard(7) };
    MaterialData plain, rich, unlit;
    plain.name = "plain";
    rich.name = "rich";
    rich.baseColorFactor = { 0.5f, 0.25f, 1, 0.75f };
    rich.metallicFactor = 0;
    rich.roughnessFactor = 0.3f;
    rich.emissiveFactor = { 1, 0.5f, 0.25f };
    rich.emissiveStrength = 5;
    rich.alphaMode = AlphaMode::Mask;
    rich.alphaCutoff = 0.25f;
    rich.doubleSided = true;
    rich.normalScale = 0.5f;
    rich.occlusionStrength = 0.125f;
    rich.baseColor = { .image = 0, .sampler = kClamped };
    rich.metallicRoughness = rich.occlusion = { .image = 1, .sampler = kClamped };
    rich.normal = { .image = 1, .sampler = kClamped };
    rich.emissive = { .image = 1, .sampler = kClamped };
    rich.baseColor.uvTransform = { float3(0, -2, 0), float3(3, 0, 0), float3(0.5f, 0.25f, 1) }; // turned by 90 degrees
    rich.baseColor.hasTransform = true;
    plain.transmission.factor = 0.75f;
    rich.transmission.factor = 0.5f;
    rich.transmission.thicknessMeters = 0.25f;
    rich.transmission.attenuationColor = { 0.5f, 1, 0.25f };
    rich.transmission.attenuationDistanceMeters = 2;
    rich.diffuseTransmission = { .color = { 1, 0.5f, 0 }, .factor = 0.75f, .maps = {} };
    rich.volumeScatter = { .color = { 0.75f, 0.5f, 0 }, .anisotropy = -0.5f, .map = {} };
    unlit.name = "unlit";
    unlit.unlit = true;
    unlit.alphaMode = AlphaMode::Blend;
    scene.materials = { plain, rich, unlit };
    GlbPrimitive primitive{ .positions = { float3(0, 0, 0), float3(1, 0, 0), float3(0, 2, 0) },
                            .normals = std::vector<float3>(3, float3(0, 0, 1)),
                            .tangents = std::vector<float4>(3, float4(1, 0, 0, -1)),
                            .colors = std::vector<float4>(3, float4(0.5f, 1, 0.25f, 1)),
                            .uvs = { float2(0, 0), float2(1, 0), float2(0, 1) },
                            .indices = { 0, 1, 2 },
                            .material = 1 };
    GlbPrimitive bare{ .positions = primitive.positions, .material = 2 };
    scene.meshes = { { "both", { primitive, bare } },
                     { "plain", { { .positions = primitive.positions, .material = 0 } } } };
    scene.lights = { { .name = "spot",
                       .type = LightType::Spot,
                       .color = { 1, 0.5f, 0 },
                       .intensity = 100,
                       .rangeMeters = 7,
                       .innerConeRadians = 0.25f,
                       .outerConeRadians = 0.5f },
                     { .name = "sun", .type = LightType::Directional, .intensity = 1000 } };
    double4x4 moved(1.0);
    moved[3] = double4(1, 2, 3, 1);
    scene.nodes = { { .name = "root", .parentFromNode = moved, .children = { 1, 2 } },
                    { .name = "a", .parentFromNode = moved, .mesh = 0 },
                    { .name = "b", .light = 0 },
                    { .name = "c", .mesh = 1 },
                    { .name = "d", .light = 1 } };
    return scene;
}

ModelData roundTrip(GlbScene const& scene) {
    const Result<std::vector<std::byte>> file = writeGlb(scene);
    if (!file) {
        ADD_FAILURE() << file.error().message;
        return {};
    }
    jobs::JobSystem jobs({ .workers = 0 });
    Result<ModelData> model = loadGltfFromMemory(*file, ".", jobs);
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    return std::move(*model);
}

void expectEqual(MaterialData const& actual, MaterialData const& expected) {
    EXPECT_EQ(actual.name, expected.name);
    EXPECT_EQ(actual.baseColorFactor, expected.baseColorFactor);
    EXPECT_EQ(actual.metallicFactor, expected.metallicFactor);
    EXPECT_EQ(actual.roughnessFactor, expected.roughnessFactor);
    EXPECT_EQ(actual.normalScale, expected.normalScale);
    EXPECT_EQ(actual.occlusionStrength, expected.occlusionStrength);
    EXPECT_EQ(actual.emissiveFactor, expected.emissiveFactor);
    EXPECT_EQ(actual.emissiveStrength, expected.emissiveStrength);
    EXPECT_EQ(actual.alphaMode, expected.alphaMode);
    EXPECT_EQ(actual.alphaCutoff, expected.alphaCutoff);
    EXPECT_EQ(actual.doubleSided, expected.doubleSided);
    EXPECT_EQ(actual.unlit, expected.unlit);
    EXPECT_EQ(actual.transmission.factor, expected.transmission.factor);
    EXPECT_EQ(actual.transmission.thicknessMeters, expected.transmission.thicknessMeters);
    EXPECT_EQ(actual.transmission.attenuationColor, expected.transmission.attenuationColor);
    EXPECT_EQ(actual.transmission.attenuationDistanceMeters, expected.transmission.attenuationDistanceMeters);
    EXPECT_EQ(actual.diffuseTransmission.factor, expected.diffuseTransmission.factor);
    EXPECT_EQ(actual.diffuseTransmission.color, expected.diffuseTransmission.color);
    EXPECT_EQ(actual.volumeScatter.color, expected.volumeScatter.color);
    EXPECT_EQ(actual.volumeScatter.anisotropy, expected.volumeScatter.anisotropy);
}

TEST(GltfWriter, MaterialsSurviveTheRoundTrip) {
    const GlbScene scene = exampleScene();
    const ModelData model = roundTrip(scene);
    EXPECT_TRUE(model.warnings.empty());
    ASSERT_EQ(model.materials.size(), scene.materials.size());
    for (size_t i = 0; i < scene.materials.size(); ++i) expectEqual(model.materials[i], scene.materials[i]);
    TextureRef const& texture = model.materials[1].baseColor;
    EXPECT_EQ(texture.sampler, kClamped);
    EXPECT_TRUE(texture.hasTransform);
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            EXPECT_NEAR(texture.uvTransform[column][row], scene.materials[1].baseColor.uvTransform[column][row], 1e-6f);
        }
    }
}

TEST(GltfWriter, PixelsSurviveTheRoundTrip) {
    const ModelData model = roundTrip(exampleScene());
    ASSERT_EQ(model.images.size(), 3u); // the second one serves as colour and as data
    Image const& base = model.images[model.materials[1].baseColor.image];
    Image const& normal = model.images[model.materials[1].normal.image];
    EXPECT_EQ(base.width, 2u);
    EXPECT_EQ(base.data[0], std::byte{ 255 }); // the top left texel is red
    EXPECT_EQ(base.data[1], std::byte{ 0 });
    EXPECT_EQ(base.data[15], std::byte{ 255 });
    EXPECT_EQ(normal.data[15], std::byte{ 7 }); // alpha is kept when it says something
}

TEST(GltfWriter, GeometrySurvivesTheRoundTrip) {
    const GlbScene scene = exampleScene();
    const ModelData model = roundTrip(scene);
    ASSERT_EQ(model.meshes.size(), 2u);
    ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    EXPECT_THAT(cornersOf(primitive), testing::ElementsAreArray(scene.meshes[0].primitives[0].positions));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeColor, 1), float4(0.5f, 1, 0.25f, 1));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeUv0, 2), float4(0, 1, 0, 1));
    EXPECT_LT(vertexValue(primitive, shader::kAttributeTangents, 0).w, 0.0f);
    EXPECT_EQ(primitive.boundsMax, float3(1, 2, 0));
    EXPECT_FALSE(model.meshes[0].primitives[1].hasUv0);
}

TEST(GltfWriter, NodesAndLightsSurviveTheRoundTrip) {
    const GlbScene scene = exampleScene();
    const ModelData model = roundTrip(scene);
    ASSERT_EQ(model.nodes.size(), 5u);
    EXPECT_EQ(model.nodes[1].name, "a");
    EXPECT_EQ(model.nodes[1].worldFromNode[3], double4(2, 4, 6, 1));
    EXPECT_EQ(model.nodes[2].light, 0u);
    ASSERT_EQ(model.lights.size(), 2u);
    EXPECT_EQ(model.lights[0].type, LightType::Spot);
    EXPECT_EQ(model.lights[0].color, scene.lights[0].color);
    EXPECT_EQ(model.lights[0].intensity, 100.0f);
    EXPECT_EQ(model.lights[0].rangeMeters, 7.0f);
    EXPECT_EQ(model.lights[0].innerConeRadians, 0.25f);
    EXPECT_EQ(model.lights[0].outerConeRadians, 0.5f);
    EXPECT_EQ(model.lights[1].type, LightType::Directional);
}

TEST(GltfWriter, TheSameSceneGivesTheSameBytes) { EXPECT_EQ(*writeGlb(exampleScene()), *writeGlb(exampleScene())); }

TEST(GltfWriter, ManyVerticesGetWideIndices) {
    GlbScene scene;
    GlbPrimitive primitive;
    for (uint32_t i = 0; i < 70'000; ++i) primitive.positions.emplace_back(static_cast<float>(i), i % 2, i % 3);
    primitive.normals.assign(70'000, float3(0, 0, 1));
    primitive.indices = { 69'999, 1, 2 };
    primitive.indices.resize(210'000, 5);
    scene.meshes = { { "large", { primitive } } };
    scene.nodes = { { .name = "n", .mesh = 0 } };
    const ModelData model = roundTrip(scene);
    EXPECT_EQ(model.meshes.at(0).primitives.at(0).indexFormat, backend::IndexFormat::UInt32);
    EXPECT_EQ(cornersOf(model.meshes[0].primitives[0])[0].x, 69'999.0f);
}

TEST(GltfWriter, AnEmptySceneIsAValidFile) {
    const ModelData model = roundTrip({});
    EXPECT_TRUE(model.nodes.empty());
    EXPECT_TRUE(model.warnings.empty());
}

std::string refusal(GlbScene const& scene) {
    const auto file = writeGlb(scene);
    return file ? "was written" : file.error().message;
}

TEST(GltfWriter, BrokenScenesAreRefusedByElement) {
    GlbScene scene = exampleScene();
    scene.meshes[0].primitives[0].indices[1] = 3;
    EXPECT_THAT(refusal(scene), HasSubstr("meshes[0].primitives[0]: an index is out of range"));
    scene = exampleScene();
    scene.meshes[0].primitives[0].uvs.pop_back();
    EXPECT_THAT(refusal(scene), HasSubstr("meshes[0].primitives[0]: its attributes differ"));
    scene = exampleScene();
    scene.materials[1].normal.image = 2;
    EXPECT_THAT(refusal(scene), HasSubstr("materials[1]: an image is out of range"));
    scene = exampleScene();
    scene.nodes[3].children = { 1 };
    EXPECT_THAT(refusal(scene), HasSubstr("nodes[3]: child 1"));
    scene = exampleScene();
    scene.nodes[1].mesh = 2;
    EXPECT_THAT(refusal(scene), HasSubstr("nodes[1]: its mesh or light"));
    EXPECT_FALSE(glbImageFromPixels("x", 2, 2, {}));
}

} // namespace
} // namespace filament_core::assets::test
