// SPDX-License-Identifier: Apache-2.0
// Skins, morph targets and animations that the loader keeps for the device.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include "shaders/interface/ShaderInterface.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace filament_core::assets::test {
namespace {

using backend::VertexFormat;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ModelData kept(TestFile const& file) {
    Result<ModelData> model = file.load({ .deformation = GltfDeformation::Kept });
    if (model) return std::move(*model);
    ADD_FAILURE() << model.error().message;
    return {};
}

std::string errorOf(TestFile const& file) {
    const Result<ModelData> model = file.load({ .deformation = GltfDeformation::Kept });
    return model ? "" : model.error().message;
}

/// Two joints, the second a child of the first; the third vertex is attached to both, with weights that sum to 2.
TestFile namedSkin() {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("JOINTS_0", std::vector<uint8_t>{ 0, 77, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>{ 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0 }, kFloat, "VEC4", 4);
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "skin": 0, "translation": [ 100, 0, 0 ] },
        { "name": "hip", "translation": [ 0, 0, 10 ], "children": [ 2 ] }, { "name": "knee", "translation": [ 0, 5, 0 ] } ])");
    file.root["scenes"][0]["nodes"] = { 0, 1 };
    file.root["skins"] = Json::parse(R"([ { "name": "leg", "joints": [ 1, 2 ] } ])");
    return file;
}

std::array<uint8_t, 4> jointsOf(PrimitiveData const& primitive, uint32_t vertex, uint8_t location) {
    std::array<uint8_t, 4> joints{};
    for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
        if (primitive.layout.attributes[i].location != location) continue;
        EXPECT_EQ(primitive.layout.attributes[i].format, VertexFormat::UByte4);
        std::memcpy(joints.data(),
                    &primitive.vertices[vertex * primitive.layout.buffers[0].stride +
                                        primitive.layout.attributes[i].offset],
                    4);
    }
    return joints;
}

TEST(GltfDeformation, KeepsVerticesWhereTheyWereBoundAndWeightsThatSumToOne) {
    const ModelData model = kept(namedSkin());
    ASSERT_EQ(model.skins.size(), 1u);
    EXPECT_EQ(model.skins[0].name, "leg");
    ASSERT_EQ(model.skins[0].joints.size(), 2u);
    EXPECT_EQ(model.nodes[model.skins[0].joints[0]].name, "hip");
    EXPECT_EQ(model.nodes[model.skins[0].joints[1]].name, "knee");
    EXPECT_EQ(model.nodes[1].skin, 0u);
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    EXPECT_TRUE(primitive.isSkinned);
    EXPECT_THAT(cornersOf(primitive), ElementsAre(float3(0), float3(1, 0, 0), float3(0, 1, 0)));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights, 2), float4(0.5f, 0.5f, 0, 0));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights, 0), float4(1, 0, 0, 0)) << "none: the first joint";
    EXPECT_EQ(jointsOf(primitive, 0, shader::kAttributeJoints)[1], 0) << "a joint without weight may be any number";
    ASSERT_EQ(primitive.boneBounds.size(), 2u);
    EXPECT_EQ(primitive.boneBounds[1].min, float3(0, 0, 0));
    EXPECT_EQ(primitive.boneBounds[1].max, float3(1, 1, 0));
    // first joint (0, 0, 10), second (0, 5, 10)
    EXPECT_EQ(primitive.restBounds.min, float3(0, 0, 10));
    EXPECT_EQ(primitive.restBounds.max, float3(1, 5, 10));
}

TEST(GltfDeformation, KeepsEightJointsAVertex) {
    TestFile file = namedSkin();
    file.attribute("JOINTS_1", std::vector<uint16_t>{ 1, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1 }, kUShort, "VEC4", 4);
    file.attribute("WEIGHTS_1", std::vector<float>{ 0, 0, 0, 0, 1, 1, 1, 0, 2, 0, 0, 0 }, kFloat, "VEC4", 4);
    const PrimitiveData primitive = kept(file).meshes[0].primitives[0];
    EXPECT_EQ(jointsOf(primitive, 1, shader::kAttributeJoints1), (std::array<uint8_t, 4>{ 1, 1, 1, 0 }));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights, 1), float4(0.25f, 0, 0, 0));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights1, 1), float4(0.25f, 0.25f, 0.25f, 0));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeWeights1, 2), float4(0.5f, 0, 0, 0));
}

TEST(GltfDeformation, WeightsThatAreExactIntegersStayIntegers) {
    TestFile file = namedSkin();
    file.attribute("WEIGHTS_0", std::vector<uint8_t>{ 255, 0, 0, 0, 255, 0, 0, 0, 100, 155, 0, 0 }, kUByte, "VEC4", 4,
                   true);
    EXPECT_EQ(formatOf(kept(file).meshes[0].primitives[0], shader::kAttributeWeights), VertexFormat::UByte4N);
    file.attribute("WEIGHTS_0", std::vector<uint8_t>{ 255, 0, 0, 0, 255, 0, 0, 0, 100, 100, 0, 0 }, kUByte, "VEC4", 4,
                   true);
    const PrimitiveData scaled = kept(file).meshes[0].primitives[0];
    EXPECT_EQ(formatOf(scaled, shader::kAttributeWeights), VertexFormat::Float4);
    EXPECT_NEAR(vertexValue(scaled, shader::kAttributeWeights, 2).x, 0.5f, 1e-6f);
}

TEST(GltfDeformation, JointsThatTheSkinLacksAreRefused) {
    TestFile file = namedSkin();
    file.attribute("JOINTS_0", std::vector<uint8_t>{ 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0 }, kUByte, "VEC4", 4);
    EXPECT_THAT(errorOf(file), HasSubstr("meshes[0].primitives[0]: names a joint that its skin lacks"));
}

// Vertices keep joints of 8 bits where those are enough, also in a skin of more.
TEST(GltfDeformation, KeepsSkinsOfAnyNumberOfJoints) {
    for (const uint16_t last : std::initializer_list<uint16_t>{ 255, 256, 300, 5000, 65535 }) {
        TestFile file = namedSkin();
        for (uint32_t i = 3; i < last + 2u; ++i) {
            file.root["nodes"].push_back(Json::object());
            file.root["skins"][0]["joints"].push_back(i);
        }
        file.attribute("JOINTS_0", std::vector<uint16_t>{ 0, 0, 0, 0, 1, 0, 0, 0, 0, last, 0, 0 }, kUShort, "VEC4", 4);
        const ModelData model = kept(file);
        EXPECT_THAT(model.warnings, IsEmpty());
        ASSERT_EQ(model.skins.size(), 1u);
        EXPECT_EQ(model.skins[0].joints.size(), last + 1u);
        PrimitiveData const& primitive = model.meshes[0].primitives[0];
        EXPECT_TRUE(primitive.isSkinned);
        EXPECT_EQ(primitive.boneBounds.size(), last + 1u);
        const auto attributes = std::span(primitive.layout.attributes).first(primitive.layout.attributeCount);
        const auto joints =
                std::ranges::find(attributes, shader::kAttributeJoints, &backend::VertexAttribute::location);
        ASSERT_NE(joints, attributes.end());
        EXPECT_EQ(joints->format, last < 256 ? VertexFormat::UByte4 : VertexFormat::UShort4);
        uint16_t stored = 0;
        std::byte const* const at = &primitive.vertices[2 * primitive.layout.buffers[0].stride + joints->offset];
        std::memcpy(&stored, at + (last < 256 ? 1 : 2), last < 256 ? 1 : 2);
        EXPECT_EQ(stored, last);
    }
}

TEST(GltfDeformation, JointsOutsideOfTheSceneComeAlongWithoutTheirMeshes) {
    TestFile file = namedSkin();
    file.root["scenes"][0]["nodes"] = { 0 };
    file.root["nodes"][1]["mesh"] = 0;
    const ModelData model = kept(file);
    ASSERT_EQ(model.nodes.size(), 4u);
    EXPECT_EQ(model.nodes[model.skins[0].joints[0]].mesh, kNone);
    EXPECT_EQ(model.nodes[model.skins[0].joints[1]].worldFromNode[3].y, 5);
}

TEST(GltfDeformation, KeepsMorphTargetsAsDifferencesAlsoSparseOnes) {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    const size_t moved = file.add(std::vector<float>{ 0, 0, 2, 0, 0, 4, 0, 0, 6 }, kFloat, "VEC3", 3);
    const std::array<uint16_t, 1> replaced{ 2 };
    const std::array<float, 3> replacement{ 7, 8, 9 };
    const size_t sparse = file.addAccessor(
            { { "componentType", 5126 },
              { "count", 3 },
              { "type", "VEC3" },
              { "sparse",
                { { "count", 1 },
                  { "indices",
                    { { "bufferView", file.addView(std::as_bytes(std::span(replaced))) }, { "componentType", 5123 } } },
                  { "values", { { "bufferView", file.addView(std::as_bytes(std::span(replacement))) } } } } } });
    file.primitive()["targets"] = { { { "POSITION", moved } }, { { "POSITION", sparse }, { "NORMAL", moved } } };
    file.root["meshes"][0]["weights"] = { 0.5, 0.0 };
    const ModelData model = kept(file);
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    EXPECT_THAT(cornersOf(primitive), ElementsAre(float3(0), float3(1, 0, 0), float3(0, 1, 0)));
    ASSERT_EQ(primitive.morphTargets.size(), 2u);
    EXPECT_THAT(primitive.morphTargets[0].positions, ElementsAre(float3(0, 0, 2), float3(0, 0, 4), float3(0, 0, 6)));
    EXPECT_THAT(primitive.morphTargets[0].normals, IsEmpty());
    EXPECT_THAT(primitive.morphTargets[1].positions, ElementsAre(float3(0), float3(0), float3(7, 8, 9)));
    EXPECT_EQ(primitive.morphTargets[1].normals[1], float3(0, 0, 4));
    EXPECT_EQ(primitive.restBounds.max.z, 3.0f);
    EXPECT_EQ(primitive.boundsMax.z, 0.0f);
    EXPECT_THAT(model.nodes[0].morphWeights, ElementsAre(0.5f, 0.0f));
}

// Without normals every target has the flat normals of its own triangles.
TEST(GltfDeformation, FlatNormalsMorphIntoThoseOfTheMovedTriangles) {
    TestFile file = TestFile::triangle();
    const size_t target = file.add(std::vector<float>{ 0, 0, 0, -1, 0, 1, 0, 0, 0 }, kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    const PrimitiveData primitive = kept(file).meshes[0].primitives[0];
    ASSERT_EQ(primitive.morphTargets.size(), 1u);
    for (float3 const& difference : primitive.morphTargets[0].normals) {
        EXPECT_EQ(float3(0, 0, 1) + difference, float3(-1, 0, 0)); // (0,0,0), (0,0,1), (0,1,0)
    }
}

TEST(GltfDeformation, UnindexedVerticesThatPartLaterAreNotWelded) {
    TestFile file;
    file.positions({ 0, 0, 0, 0, 0, 0, 0, 0, 0 });
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    const size_t target = file.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    EXPECT_EQ(kept(file).meshes[0].primitives[0].vertexCount, 3u);
}

TestFile triangleWithTargets(size_t count, size_t vertices) {
    TestFile file = TestFile::triangle();
    std::vector<float> positions(vertices * 3), raised(vertices * 3);
    for (size_t i = 0; i < vertices; ++i) {
        positions[i * 3] = static_cast<float>(i % 2);
        positions[i * 3 + 1] = static_cast<float>(i % 3);
        raised[i * 3 + 2] = 1;
    }
    file.attribute("POSITION", positions, kFloat, "VEC3", 3);
    const size_t target = file.add(raised, kFloat, "VEC3", 3);
    file.primitive()["targets"] = Json::array();
    for (size_t i = 0; i < count; ++i) file.primitive()["targets"].push_back({ { "POSITION", target } });
    std::vector<double> weights(count);
    weights[0] = 2;
    file.root["meshes"][0]["weights"] = weights;
    return file;
}

TEST(GltfDeformation, KeepsAnyNumberOfMorphTargets) {
    for (const size_t count : { 256u, 257u, 1500u }) {
        const ModelData model = kept(triangleWithTargets(count, 3));
        EXPECT_THAT(model.warnings, IsEmpty());
        EXPECT_EQ(model.meshes[0].primitives[0].morphTargets.size(), count);
    }
}

TEST(GltfDeformation, MoreTexelsOfMorphTargetsThanATextureHasAreDrawnAtRest) {
    const ModelData model = kept(triangleWithTargets(1000, 6000));
    EXPECT_THAT(model.warnings,
                testing::Contains(HasSubstr("meshes[0].primitives[0]: 1000 morph targets of 6000 vertices")));
    EXPECT_EQ(positionOf(model.meshes[0].primitives[0], 0).z, 2.0f);
}

// ---------------------------------------------------------------------------------------------- animations

TestFile animatedTriangle(Json const& channel, Json const& sampler) {
    TestFile file = TestFile::triangle();
    file.root["nodes"][0]["translation"] = { 3, 0, 0 };
    file.root["animations"] = { { { "name", "go" }, { "channels", { channel } }, { "samplers", { sampler } } } };
    return file;
}

TestFile movingTriangle(std::vector<float> const& times, std::vector<float> const& values) {
    TestFile file = animatedTriangle({ { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "translation" } } } },
                                     Json::object());
    Json& sampler = file.root["animations"][0]["samplers"][0];
    sampler["input"] = file.add(times, kFloat, "SCALAR", 1);
    sampler["output"] = file.add(values, kFloat, "VEC3", 3);
    return file;
}

TEST(GltfAnimation, ReadsChannelsWithTheirKeysAndTheRestPose) {
    const ModelData model = kept(movingTriangle({ 0.5f, 2 }, { 0, 0, 0, 1, 2, 3 }));
    ASSERT_EQ(model.animations.size(), 1u);
    AnimationData const& animation = model.animations[0];
    EXPECT_EQ(animation.name, "go");
    EXPECT_EQ(animation.durationSeconds, 2);
    ASSERT_EQ(animation.channels.size(), 1u);
    EXPECT_EQ(animation.channels[0].path, AnimationPath::Translation);
    EXPECT_EQ(animation.samplers[0].interpolation, Interpolation::Linear);
    EXPECT_THAT(animation.samplers[0].values, ElementsAre(0, 0, 0, 1, 2, 3));
    EXPECT_EQ(model.nodes[0].pose.translation, double3(3, 0, 0));
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfAnimation, NormalisedIntegersAreRotations) {
    TestFile file = animatedTriangle({ { "sampler", 0 }, { "target", { { "node", 0 }, { "path", "rotation" } } } },
                                     { { "interpolation", "STEP" } });
    Json& sampler = file.root["animations"][0]["samplers"][0];
    sampler["input"] = file.add(std::vector<float>{ 0 }, kFloat, "SCALAR", 1);
    sampler["output"] = file.add(std::vector<int16_t>{ 0, -32768, 0, 16384 }, kShort, "VEC4", 4, true);
    AnimationSampler const read = kept(file).animations[0].samplers[0];
    EXPECT_THAT(read.values, ElementsAre(0, -1, 0, 16384 / 32767.0f));
    EXPECT_TRUE(read.isRotation);
    EXPECT_EQ(read.interpolation, Interpolation::Step);
}

TEST(GltfAnimation, AnOutputWithoutBufferIsZeros) {
    TestFile file = movingTriangle({ 0, 1 }, { 1, 1, 1, 1, 1, 1 });
    const size_t output = file.root["animations"][0]["samplers"][0]["output"];
    file.root["accessors"][output].erase("bufferView");
    EXPECT_THAT(kept(file).animations[0].samplers[0].values, testing::Each(0.0f));
}

TEST(GltfAnimation, WhatMakesNoSenseIsLeftOutByName) {
    const auto expectLeftOut = [](TestFile const& file, const char* reason) {
        const ModelData model = kept(file);
        ASSERT_EQ(model.animations.size(), 1u) << "animations keep their numbers";
        EXPECT_THAT(model.animations[0].channels, IsEmpty());
        EXPECT_THAT(model.warnings, ElementsAre(HasSubstr(reason)));
    };
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    expectLeftOut(movingTriangle({ kInfinity, NAN }, std::vector<float>(6)),
                  "animations[0].channels[0]: no key has a finite time and value; the channel is left out");
    expectLeftOut(movingTriangle({ 0, 1 }, std::vector<float>(9)), "9 values for 2 keys of 3 numbers");
    expectLeftOut(movingTriangle({}, {}), "0 values for 0 keys");
    TestFile cubic = movingTriangle({ 0, 1 }, std::vector<float>(6));
    cubic.root["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
    expectLeftOut(cubic, "6 values for 2 keys of 3 numbers with their tangents");
    TestFile weights = movingTriangle({ 0, 1 }, std::vector<float>(6));
    weights.root["animations"][0]["channels"][0]["target"]["path"] = "weights";
    expectLeftOut(weights, "nodes[0] has no morph targets");
}

// One line for an animation, however many of its channels are broken.
TEST(GltfAnimation, TimesThatDoNotGrowAreMendedAndNamed) {
    TestFile file = movingTriangle({ 2, 0, NAN, 2 }, { 5, 0, 0, 1, 2, 3, 9, 9, 9, 4, 0, 0 });
    Json& animation = file.root["animations"][0];
    animation["samplers"].push_back({ { "input", file.add(std::vector<float>{ -1, 1 }, kFloat, "SCALAR", 1) },
                                      { "output", file.add(std::vector<float>(6), kFloat, "VEC3", 3) } });
    animation["channels"].push_back({ { "sampler", 1 }, { "target", { { "node", 0 }, { "path", "scale" } } } });
    animation["channels"].push_back(animation["channels"][0]);
    const ModelData model = kept(file);
    ASSERT_EQ(model.animations[0].channels.size(), 3u);
    AnimationSampler const& first = model.animations[0].samplers[0];
    EXPECT_THAT(first.times, ElementsAre(0, 2, 2));
    EXPECT_THAT(first.values, ElementsAre(1, 2, 3, 5, 0, 0, 4, 0, 0));
    EXPECT_THAT(model.animations[0].samplers[1].times, ElementsAre(-1, 1));
    EXPECT_EQ(model.animations[0].durationSeconds, 2);
    EXPECT_THAT(model.warnings,
                ElementsAre("model: animations[0] 'go': the times of channels 0-2 do not grow from 0 on: 1 at the time "
                            "of another (the last of them holds from there on), 1 earlier than the one before "
                            "(sorted), 1 before 0, 1 without a finite time (left out)"));
}

TEST(GltfAnimation, WhatPointsNowhereIsRefusedByName) {
    TestFile file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["animations"][0]["channels"][0]["sampler"] = 1;
    EXPECT_THAT(errorOf(file), HasSubstr("animations[0].channels[0].sampler"));
    file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["animations"][0]["channels"].push_back({ { "sampler", 0 }, { "target", { { "node", 1 } } } });
    EXPECT_THAT(errorOf(file), HasSubstr("animations[0].channels[1].target.node"));
    file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["accessors"][1]["count"] = 1000;
    EXPECT_THAT(errorOf(file), HasSubstr("accessors[1]: 1000 elements end at byte"));
}

TEST(GltfAnimation, UnknownPathsAndInterpolationsAreNamed) {
    TestFile file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["animations"][0]["channels"][0]["target"]["path"] = "colour";
    EXPECT_THAT(kept(file).animations[0].channels, IsEmpty());
    EXPECT_THAT(kept(file).warnings, ElementsAre(HasSubstr("animations[0].channels[0].target.path: 'colour'")));
    file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["animations"][0]["samplers"][0]["interpolation"] = "SMOOTH";
    EXPECT_EQ(kept(file).animations[0].samplers[0].interpolation, Interpolation::Linear);
    EXPECT_THAT(kept(file).warnings, ElementsAre(HasSubstr("animations[0].samplers[0].interpolation: 'SMOOTH'")));
}

TEST(GltfAnimation, TargetsOfExtensionsAreNotNodes) {
    TestFile file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    file.root["animations"][0]["channels"][0]["target"] = { { "path", "pointer" } };
    EXPECT_THAT(kept(file).animations[0].channels, IsEmpty());
}

// The weights of a mesh that stands at many nodes go to all of them.
TEST(GltfAnimation, WeightsGoToEveryInstance) {
    TestFile file = movingTriangle({ 0, 1 }, std::vector<float>(6));
    const size_t target = file.add(std::vector<float>(9), kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    Json& animation = file.root["animations"][0];
    animation["channels"][0]["target"]["path"] = "weights";
    animation["samplers"][0]["output"] = file.add(std::vector<float>{ 0, 1 }, kFloat, "SCALAR", 1);
    const size_t places = file.add(std::vector<float>(6), kFloat, "VEC3", 3);
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
    const ModelData model = kept(file);
    ASSERT_EQ(model.animations[0].channels.size(), 2u);
    EXPECT_EQ(model.animations[0].channels[0].node, 1u);
    EXPECT_EQ(model.animations[0].channels[1].node, 2u);
}

} // namespace
} // namespace filament_core::assets::test
