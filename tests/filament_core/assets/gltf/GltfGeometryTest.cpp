// SPDX-License-Identifier: Apache-2.0
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace filament_core::assets::test {
namespace {

using backend::IndexFormat;
using backend::PrimitiveType;
using backend::VertexFormat;
using testing::ElementsAre;
using testing::HasSubstr;

const float3 kA(0, 0, 0), kB(1, 0, 0), kC(0, 1, 0), kD(1, 1, 0);

TestFile fourPoints(int mode) {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 });
    file.primitive()["mode"] = mode;
    return file;
}

TEST(GltfGeometry, StripsKeepTheWindingOfTheirFirstTriangle) {
    const PrimitiveData primitive = onlyPrimitive(fourPoints(5));
    EXPECT_EQ(primitive.topology, PrimitiveType::Triangles);
    EXPECT_THAT(cornersOf(primitive), ElementsAre(kA, kB, kC, kB, kD, kC)); // specification, section 3.7.2.1
}

TEST(GltfGeometry, FansTurnAboutTheirFirstVertex) {
    EXPECT_THAT(cornersOf(onlyPrimitive(fourPoints(6))), ElementsAre(kB, kC, kA, kC, kD, kA));
}

TEST(GltfGeometry, LoopsCloseAndLineStripsDoNot) {
    const PrimitiveData loop = onlyPrimitive(fourPoints(2)), strip = onlyPrimitive(fourPoints(3));
    EXPECT_EQ(loop.topology, PrimitiveType::Lines);
    EXPECT_THAT(cornersOf(loop), ElementsAre(kA, kB, kB, kC, kC, kD, kD, kA));
    EXPECT_THAT(cornersOf(strip), ElementsAre(kA, kB, kB, kC, kC, kD));
}

TEST(GltfGeometry, StripsThatStitchWithRepeatedIndicesStayFinite) {
    TestFile file = TestFile::triangle();
    file.primitive()["mode"] = 5;
    file.indices({ 0, 1, 2, 2, 0, 0, 1, 2 });
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(primitive.indexCount, 18u) << "triangles without area are drawn as nothing";
    for (uint32_t i = 0; i < primitive.vertexCount; ++i) {
        const float4 frame = vertexValue(primitive, shader::kAttributeTangents, i);
        EXPECT_EQ(frame - frame, float4(0));
    }
    file.indices({ 0, 1, 2, 65535, 0, 1, 2 }); // glTF has no primitive restart
    EXPECT_THAT(file.load().error().message, HasSubstr("65535 is out of range"));
}

TEST(GltfGeometry, InstancesMayHaveNormalisedIntegersAsRotations) {
    TestFile file = TestFile::triangle();
    const size_t bytes = file.add(std::vector<int8_t>{ 0, 0, 127, 0, 0, 0, 0, 127 }, kByte, "VEC4", 4, true);
    const size_t scales = file.add(std::vector<float>{ 1, 1, 1, 2, 2, 2 }, kFloat, "VEC3", 3);
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = { { "ROTATION", bytes },
                                                                                     { "SCALE", scales } };
    const ModelData model = loaded(file);
    ASSERT_EQ(model.nodes.size(), 3u);
    EXPECT_NEAR(model.nodes[1].parentFromNode[0].x, -1, 1e-9) << "half a turn about z";
    EXPECT_NEAR(model.nodes[2].parentFromNode[1].y, 2, 1e-9);
}

TEST(GltfGeometry, PointsHaveTheNormalsAndTangentsOfTheFileAndNoOthers) {
    TestFile file = fourPoints(0);
    EXPECT_FALSE(onlyPrimitive(file).hasNormals);
    EXPECT_FALSE(onlyPrimitive(file).hasTangents);
    const std::vector<float> tangents{ 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1 };
    file.attribute("TANGENT", tangents, kFloat, "VEC4", 4);
    EXPECT_FALSE(onlyPrimitive(file).hasTangents) << "tangents without normals";
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    EXPECT_TRUE(onlyPrimitive(file).hasTangents);
    file.primitive()["attributes"].erase("TANGENT");
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_TRUE(primitive.hasNormals);
    EXPECT_FALSE(primitive.hasTangents);
    EXPECT_EQ(primitive.topology, PrimitiveType::Points);
    EXPECT_EQ(primitive.indexCount, 4u);
}

TEST(GltfGeometry, LeftOverIndicesAreDroppedWithAWarning) {
    TestFile file = fourPoints(4);
    const ModelData model = loaded(file);
    EXPECT_EQ(model.meshes[0].primitives[0].indexCount, 3u);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("meshes[0].primitives[0]: 1 indices are left over")));
}

TEST(GltfGeometry, FlatNormalsPointOutOfCounterClockwiseTriangles) {
    TestFile file;
    // two triangles of a roof that share the ridge, indexed: each needs its own normal
    file.positions({ 0, 0, 1, 0, 0, -1, 1, -1, 0, -1, -1, 0 });
    file.indices({ 0, 2, 1, 0, 1, 3 });
    const PrimitiveData primitive = onlyPrimitive(file);
    ASSERT_EQ(primitive.vertexCount, 6u); // the ridge is split
    const float s = std::sqrt(0.5f);
    for (uint32_t i = 0; i < 6; ++i) {
        float3 n, t, b;
        shader::lib::tangentFrame(vertexValue(primitive, shader::kAttributeTangents, i), n, t, b);
        EXPECT_NEAR(n.x, i < 3 ? s : -s, 1e-4f);
        EXPECT_NEAR(n.y, s, 1e-4f);
    }
}

TEST(GltfGeometry, VerticesWithoutIndicesAreWelded) {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0, /**/ 1, 0, 0, 1, 1, 0, 0, 1, 0 }); // a square, six corners
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(primitive.vertexCount, 4u);
    EXPECT_THAT(cornersOf(primitive), ElementsAre(kA, kB, kC, kB, kD, kC));
}

TEST(GltfGeometry, IndicesOfAnyWidthAreRead) {
    for (const Component width : { kUByte, kUShort, kUInt }) {
        TestFile file = fourPoints(4);
        const std::vector<uint32_t> values{ 3, 1, 0 };
        file.primitive()["indices"] = width == kUByte ? file.add(std::vector<uint8_t>{ 3, 1, 0 }, kUByte, "SCALAR", 1)
                                      : width == kUShort
                                              ? file.add(std::vector<uint16_t>{ 3, 1, 0 }, kUShort, "SCALAR", 1)
                                              : file.add(values, kUInt, "SCALAR", 1);
        EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(kD, kB, kA)) << width;
    }
}

TEST(GltfGeometry, MoreThan65535VerticesNeedWideIndices) {
    for (const uint32_t count : { 65535u, 65537u }) {
        TestFile file;
        std::vector<float> positions(size_t{ count } * 3);
        for (uint32_t i = 0; i < count; ++i) positions[i * 3] = static_cast<float>(i);
        file.positions(positions);
        file.primitive()["mode"] = 0;
        const PrimitiveData primitive = onlyPrimitive(file);
        EXPECT_EQ(primitive.indexFormat, count < 65536 ? IndexFormat::UInt16 : IndexFormat::UInt32);
        EXPECT_EQ(indicesOf(primitive).back(), count - 1);
    }
}

TEST(GltfGeometry, InterleavedBuffersAreReadWithTheirStride) {
    TestFile file;
    const std::vector<float> mixed{ 0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9, 9 };
    const size_t view = file.addView(std::as_bytes(std::span(mixed)), 20);
    file.primitive()["attributes"]["POSITION"] =
            file.addAccessor({ { "bufferView", view }, { "componentType", 5126 }, { "count", 3 }, { "type", "VEC3" } });
    file.primitive()["attributes"]["TEXCOORD_0"] = file.addAccessor({ { "bufferView", view },
                                                                      { "byteOffset", 12 },
                                                                      { "componentType", 5126 },
                                                                      { "count", 3 },
                                                                      { "type", "VEC2" } });
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_THAT(cornersOf(primitive), ElementsAre(kA, kB, kC));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeUv0, 2), float4(9, 9, 0, 1));
}

TEST(GltfGeometry, SparseAccessorsReplaceTheirElements) {
    TestFile file = TestFile::triangle();
    const std::array<uint16_t, 1> replaced{ 1 };
    const std::array<float, 3> replacement{ 7, 8, 9 };
    const size_t indices = file.addView(std::as_bytes(std::span(replaced)));
    const size_t values = file.addView(std::as_bytes(std::span(replacement)));
    file.root["accessors"][0]["sparse"] = { { "count", 1 },
                                            { "indices", { { "bufferView", indices }, { "componentType", 5123 } } },
                                            { "values", { { "bufferView", values } } } };
    EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(kA, float3(7, 8, 9), kC));
    file.root["accessors"][0].erase("bufferView"); // then the rest is zero
    EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(kA, float3(7, 8, 9), kA));
}

TEST(GltfGeometry, NormalisedIntegersGoToTheGpuAsTheyAre) {
    TestFile file;
    const std::vector<int16_t> shorts{ -32767, 0, 32767, 0, 16384, 0, -32768, 1, 2 };
    file.attribute("POSITION", shorts, kShort, "VEC3", 3, true);
    file.root["bufferViews"][0]["byteStride"] = 6; // tight: some writers forget to pad to 4
    file.attribute("TEXCOORD_0", std::vector<uint16_t>{ 0, 65535, 1, 2, 3, 4 }, kUShort, "VEC2", 2, true);
    file.attribute("COLOR_0", std::vector<uint8_t>{ 255, 0, 51, 1, 2, 3, 4, 5, 6 }, kUByte, "VEC3", 3, true);
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(formatOf(primitive, shader::kAttributePosition), VertexFormat::Short4N);
    EXPECT_EQ(formatOf(primitive, shader::kAttributeUv0), VertexFormat::UShort2N);
    EXPECT_EQ(formatOf(primitive, shader::kAttributeColor), VertexFormat::UByte4N);
    EXPECT_EQ(positionOf(primitive, 0), float3(-1, 0, 1));
    EXPECT_EQ(positionOf(primitive, 1), float3(0, 16384 / 32767.0f, 0));
    EXPECT_EQ(positionOf(primitive, 2), float3(-1, 1 / 32767.0f, 2 / 32767.0f)); // -32768 is -1 too
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeColor, 0), float4(1, 0, 51 / 255.0f, 1));
    EXPECT_EQ(primitive.layout.buffers[0].stride, 8 + 8 + 4 + 4);
}

TEST(GltfGeometry, IntegersThatAreNotNormalisedBecomeFloats) {
    TestFile file;
    file.attribute("POSITION", std::vector<uint8_t>{ 0, 0, 0, 200, 0, 0, 0, 100, 0 }, kUByte, "VEC3", 3);
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(formatOf(primitive, shader::kAttributePosition), VertexFormat::Float3);
    EXPECT_EQ(positionOf(primitive, 1), float3(200, 0, 0));
    EXPECT_EQ(primitive.boundsMax, float3(200, 100, 0));
}

TEST(GltfGeometry, DefaultMorphWeightsShapeTheRestPose) {
    TestFile file = TestFile::triangle();
    const size_t target = file.add(std::vector<float>{ 0, 0, 2, 0, 0, 4, 0, 0, 6 }, kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    file.root["meshes"][0]["weights"] = { 0.5 };
    EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(float3(0, 0, 1), float3(1, 0, 2), float3(0, 1, 3)));
    file.root["nodes"][0]["weights"] = { 0.0 }; // a node overrides its mesh
    EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(kA, kB, kC));
}

TEST(GltfGeometry, NodesWithOtherMorphWeightsGetMeshesOfTheirOwn) {
    TestFile file = TestFile::triangle();
    const size_t target = file.add(std::vector<float>{ 0, 0, 1, 0, 0, 1, 0, 0, 1 }, kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0 }, { "mesh": 0, "weights": [ 3 ] }, { "mesh": 0 } ])");
    file.root["scenes"][0]["nodes"] = { 0, 1, 2 };
    const ModelData model = loaded(file);
    ASSERT_EQ(model.meshes.size(), 2u);
    EXPECT_EQ(model.nodes[0].mesh, model.nodes[2].mesh);
    EXPECT_EQ(model.meshes[model.nodes[1].mesh].primitives[0].boundsMin.z, 3.0f);
}

TestFile skinnedTriangle() {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("JOINTS_0", std::vector<uint8_t>{ 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0 }, kFloat, "VEC4", 4);
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "skin": 0, "translation": [ 100, 0, 0 ] },
        { "translation": [ 0, 0, 10 ], "children": [ 2 ] }, { "translation": [ 0, 5, 0 ] } ])");
    file.root["scenes"][0]["nodes"] = { 0, 1 };
    file.root["skins"] = Json::parse(R"([ { "joints": [ 1, 2 ] } ])");
    return file;
}

TEST(GltfGeometry, SkinsFollowTheirJointsAndNotTheirNode) {
    const ModelData model = loaded(skinnedTriangle());
    ASSERT_EQ(model.meshes.size(), 1u);
    // first joint (0, 0, 10), second (0, 5, 10); the third vertex is attached to both, and its weights sum to 2
    EXPECT_THAT(cornersOf(model.meshes[0].primitives[0]),
                ElementsAre(float3(0, 0, 10), float3(1, 5, 10), float3(0, 3.5f, 10)));
    // the mesh gets a root node of its own; its node in the file, and the joints, are nodes without a mesh
    ASSERT_EQ(model.nodes.size(), 4u);
    EXPECT_EQ(model.nodes[0].mesh, kNone);
    EXPECT_EQ(model.nodes[0].worldFromNode[3].x, 100);
    EXPECT_EQ(model.nodes[1].mesh, 0u);
    EXPECT_EQ(model.nodes[1].parent, kNone);
    EXPECT_EQ(model.nodes[1].worldFromNode, double4x4(1.0));
    EXPECT_EQ(model.nodes[3].parent, 2u);
}

TEST(GltfGeometry, InverseBindMatricesUndoTheBindPose) {
    TestFile file = skinnedTriangle();
    std::vector<float> matrices(32, 0.0f);
    for (const size_t i : { 0, 5, 10, 15, 16, 21, 26, 31 }) matrices[i] = 1;
    matrices[14] = -10, matrices[29] = -5, matrices[30] = -10; // translations of both joints, back
    file.root["skins"][0]["inverseBindMatrices"] = file.add(matrices, kFloat, "MAT4", 16);
    EXPECT_THAT(cornersOf(onlyPrimitive(file)), ElementsAre(kA, kB, kC));
}

TEST(GltfGeometry, MirroringJointsKeepTrianglesFacingTheirNormals) {
    TestFile file = skinnedTriangle();
    file.root["nodes"][1] = Json::parse(R"({ "scale": [ -1, 1, 1 ], "children": [ 2 ] })");
    const PrimitiveData primitive = onlyPrimitive(file);
    const std::vector<float3> corners = cornersOf(primitive);
    const float3 geometric = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    float3 n, t, b;
    shader::lib::tangentFrame(vertexValue(primitive, shader::kAttributeTangents, 0), n, t, b);
    EXPECT_NEAR(n.z, 1.0f, 1e-4f);
    EXPECT_GT(glm::dot(geometric, n), 0.0f);
}

TEST(GltfGeometry, AnimatedFilesSayThatTheyStandStill) {
    TestFile file = TestFile::triangle();
    EXPECT_TRUE(loaded(file).warnings.empty());
    file.root["animations"] = { Json::object() };
    EXPECT_THAT(loaded(file).warnings, ElementsAre(HasSubstr("drawn at rest")));
}

TEST(GltfGeometry, NodesMultiplyDownTheTreeInDouble) {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(R"([ { "translation": [ 10000000, 0, 0 ], "children": [ 1 ] },
        { "rotation": [ 0, 0, 0.7071067811865476, 0.7071067811865476 ], "scale": [ 2, 1, 1 ], "children": [ 2 ] },
        { "matrix": [ 1,0,0,0, 0,1,0,0, 0,0,1,0, 0.25,0,0,1 ], "mesh": 0 } ])");
    const ModelData model = loaded(file);
    ASSERT_EQ(model.nodes.size(), 3u);
    const double4 origin = model.nodes[2].worldFromNode * double4(0, 0, 0, 1);
    EXPECT_NEAR(origin.x, 1e7, 1e-6); // 0.25 along x, stretched by 2, turned to y
    EXPECT_NEAR(origin.y, 0.5, 1e-9);
    EXPECT_EQ(model.nodes[0].parent, kNone);
    for (uint32_t i = 1; i < 3; ++i) {
        NodeData const& node = model.nodes[i];
        EXPECT_EQ(node.parent, i - 1);
        EXPECT_EQ(node.worldFromNode, model.nodes[node.parent].worldFromNode * node.parentFromNode);
    }
}

TEST(GltfGeometry, AMatrixThatIsNotAffineLosesItsLastRowAndSaysSo) {
    TestFile file = TestFile::triangle();
    file.root["nodes"][0]["matrix"] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 7, 0, 0, 1 };
    const ModelData model = loaded(file);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("nodes[0].matrix: its last row is not 0 0 0 1")));
    EXPECT_EQ(model.nodes[0].parentFromNode[2], double4(0, 0, 1, 0));
    EXPECT_EQ(model.nodes[0].parentFromNode[3], double4(7, 0, 0, 1));
}

TEST(GltfGeometry, InstancingPlacesOneNodePerInstance) {
    TestFile file = TestFile::triangle();
    const size_t translations = file.add(std::vector<float>{ 1, 0, 0, 2, 0, 0, 3, 0, 0 }, kFloat, "VEC3", 3);
    file.root["nodes"][0]["translation"] = { 0, 10, 0 };
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = translations;
    const ModelData model = loaded(file);
    ASSERT_EQ(model.nodes.size(), 4u); // the file's node, with the instances below it
    EXPECT_EQ(model.nodes[0].mesh, kNone);
    for (uint32_t i = 1; i < 4; ++i) {
        EXPECT_EQ(model.nodes[i].parent, 0u);
        EXPECT_EQ(model.nodes[i].mesh, 0u);
    }
    EXPECT_EQ(model.nodes[3].parentFromNode[3], double4(3, 0, 0, 1));
    EXPECT_EQ(model.nodes[3].worldFromNode[3], double4(3, 10, 0, 1));
    EXPECT_EQ(model.meshes.size(), 1u);
}

TEST(GltfGeometry, UnusedVerticesAreDropped) {
    TestFile file;
    std::vector<float> positions(300, 5.0f);
    std::copy_n(std::array{ 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f }.begin(), 9, positions.begin() + 150);
    file.positions(positions);
    file.normals(std::vector<float>(300, 0.57735f));
    file.indices({ 50, 51, 52 });
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(primitive.vertexCount, 3u);
    EXPECT_THAT(cornersOf(primitive), ElementsAre(kA, kB, kC));
    EXPECT_EQ(primitive.boundsMax, float3(1, 1, 0));
}

TEST(GltfGeometry, ColoursAreWithinZeroAndOne) {
    TestFile file = TestFile::triangle();
    file.attribute("COLOR_0", std::vector<float>{ -1, 0.25f, 3e38f, 1, 2, 0.5f, 0, 0, 1, 1, 1, 1 }, kFloat, "VEC4", 4);
    const PrimitiveData primitive = onlyPrimitive(file);
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeColor, 0), float4(0, 0.25f, 1, 1));
    EXPECT_EQ(vertexValue(primitive, shader::kAttributeColor, 1), float4(1, 0.5f, 0, 0));
}

TEST(GltfGeometry, EmptyPrimitivesAreLeftOutWithAWarning) {
    TestFile file = TestFile::triangle();
    file.root["meshes"][0]["primitives"].push_back({ { "attributes", Json::object() } });
    const ModelData model = loaded(file);
    EXPECT_EQ(model.meshes[0].primitives.size(), 1u);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("meshes[0].primitives[1]: has no POSITION")));
}

} // namespace
} // namespace filament_core::assets::test
