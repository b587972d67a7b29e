// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// The message of the error that the file must produce.
std::string refusal(TestFile const& file, ErrorCode code = ErrorCode::Corrupt) {
    const Result<ModelData> model = file.load({ .name = "broken.glb" });
    if (model) return "was loaded";
    EXPECT_EQ(model.error().code, code) << model.error().message;
    EXPECT_THAT(model.error().message, StartsWith("broken.glb: "));
    EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    return model.error().message;
}

TEST(GltfBrokenFile, IndicesBetweenElementsNameTheElementAndTheCount) {
    TestFile file = TestFile::triangle();
    file.root["nodes"][0]["mesh"] = 5;
    EXPECT_THAT(refusal(file), HasSubstr("nodes[0].mesh: index 5 is out of range, the file has 1 meshes"));
    file.root["nodes"][0]["mesh"] = -1;
    EXPECT_THAT(refusal(file), HasSubstr("nodes[0].mesh: must be a non-negative integer, found number"));
    file.root["nodes"][0]["mesh"] = 0;
    file.primitive()["attributes"]["NORMAL"] = 9;
    EXPECT_THAT(refusal(file), HasSubstr("meshes[0].primitives[0].attributes.NORMAL: index 9"));
    file.primitive()["attributes"]["NORMAL"] = "x";
    EXPECT_THAT(refusal(file), HasSubstr("attributes.NORMAL: must be a non-negative integer, found string"));
}

TEST(GltfBrokenFile, AccessorsBeyondTheirViewAreRefused) {
    TestFile file = TestFile::triangle();
    file.root["accessors"][0]["count"] = 4;
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0]: 4 elements end at byte 48, bufferViews[0] has 36"));
    file.root["accessors"][0]["count"] = 3;
    file.root["accessors"][0]["byteOffset"] = 9007199254740992;
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0]: 3 elements end at byte 9007199254741028"));
    file.root["accessors"][0]["byteOffset"] = 1;
    EXPECT_THAT(refusal(file), HasSubstr("end at byte 37"));
}

TEST(GltfBrokenFile, HugeCountsAreRefusedBeforeAnythingIsAllocated) {
    TestFile file = TestFile::triangle();
    file.root["accessors"][0]["count"] = 1e15;
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("accessors[0].count"));
    file.root["accessors"][0]["count"] = 100000000;
    file.root["accessors"][0].erase("bufferView");
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("elements without a bufferView"));
}

TEST(GltfBrokenFile, ViewsBeyondTheirBufferAreRefused) {
    TestFile file = TestFile::triangle();
    file.root["bufferViews"][0]["byteLength"] = 37;
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: ends at byte 37, buffers[0] has 36"));
    file.root["bufferViews"][0]["byteLength"] = 36;
    file.root["buffers"] = { { { "byteLength", 64 } } };
    EXPECT_THAT(refusal(file), HasSubstr("buffers[0]: only 36 of 64 bytes are present"));
}

TEST(GltfBrokenFile, AttributesOfDifferentLengthAreRefused) {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1 });
    EXPECT_THAT(refusal(file), HasSubstr("meshes[0].primitives[0]: NORMAL has 2 elements, POSITION has 3"));
}

TEST(GltfBrokenFile, AttributesOfTheWrongTypeAreRefused) {
    TestFile file;
    file.attribute("POSITION", std::vector<float>{ 0, 0, 1, 1, 2, 2 }, kFloat, "VEC2", 2);
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0]: 2 components do not serve as POSITION"));
    file.root["accessors"][0]["type"] = "VEC9";
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0].type: 'VEC9'"));
    file.root["accessors"][0]["type"] = "VEC3";
    file.root["accessors"][0]["componentType"] = 5124;
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0].componentType"));
}

TEST(GltfBrokenFile, VertexIndicesOutOfRangeAreRefused) {
    TestFile file = TestFile::triangle();
    file.indices({ 0, 1, 3 });
    EXPECT_THAT(refusal(file), HasSubstr("meshes[0].primitives[0].indices: 3 is out of range, there are 3 vertices"));
}

TEST(GltfBrokenFile, SparseIndicesOutOfRangeAreRefused) {
    TestFile file = TestFile::triangle();
    const std::array<uint32_t, 1> index{ 3 };
    file.root["accessors"][0]["sparse"] = {
        { "count", 1 },
        { "indices", { { "bufferView", file.addView(std::as_bytes(std::span(index))) }, { "componentType", 5125 } } },
        { "values", { { "bufferView", 0 } } }
    };
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0].sparse.indices: an index is out of range"));
    file.root["accessors"][0]["sparse"]["count"] = 4;
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0].sparse.count: 4"));
}

TEST(GltfBrokenFile, NodesMustFormAForest) {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0 }, { "children": [ 2 ] }, { "children": [ 1 ] } ])");
    file.root["scenes"][0]["nodes"] = { 1 };
    EXPECT_THAT(refusal(file), HasSubstr("cycle"));
    file.root["scenes"][0]["nodes"] = { 0 };
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "children": [ 0 ] } ])");
    EXPECT_THAT(refusal(file), HasSubstr("nodes[0].children: nodes[0]"));
    file.root["nodes"] = Json::parse(R"([ { "children": [ 2 ] }, { "children": [ 2 ] }, {} ])");
    file.root["scenes"][0]["nodes"] = { 0, 1 };
    EXPECT_THAT(refusal(file), HasSubstr("nodes[2] has another parent"));
}

TEST(GltfBrokenFile, DeepHierarchiesAreWalkedWithoutRecursion) {
    TestFile file = TestFile::triangle();
    constexpr int kDepth = 100'000; // a frame of 100 bytes each would overflow the stack
    Json nodes = Json::array();
    for (int i = 0; i + 1 < kDepth; ++i) nodes.push_back({ { "children", { i + 1 } } });
    nodes.push_back({ { "mesh", 0 } });
    file.root["nodes"] = std::move(nodes);
    EXPECT_EQ(loaded(file).nodes.size(), size_t{ kDepth });
}

TEST(GltfBrokenFile, DeeplyNestedJsonIsHarmless) {
    std::string text(1'000'000, '[');
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<ModelData> open = loadGltfFromMemory(std::as_bytes(std::span(text)), ".", jobs);
    EXPECT_FALSE(open);
    text = R"({ "asset": { "version": "2.0" }, "extras": )" + text + std::string(1'000'000, ']') + "}";
    EXPECT_TRUE(loadGltfFromMemory(std::as_bytes(std::span(text)), ".", jobs));
}

TEST(GltfBrokenFile, JsonErrorsNameTheByte) {
    jobs::JobSystem jobs({ .workers = 0 });
    const std::string text = R"({ "asset": nonsense })";
    const Result<ModelData> model = loadGltfFromMemory(std::as_bytes(std::span(text)), ".", jobs, { .name = "a.gltf" });
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().message, "a.gltf: the JSON is broken at byte 13");
}

TEST(GltfBrokenFile, WhatIsNoGltfSaysHowItBegins) {
    jobs::JobSystem jobs({ .workers = 0 });
    const auto message = [&](std::string const& text) {
        const auto model = loadGltfFromMemory(std::as_bytes(std::span(text)), ".", jobs, { .name = "a.glb" });
        return model ? "was loaded" : model.error().message;
    };
    EXPECT_EQ(message(""), "a.glb: the file is empty");
    EXPECT_THAT(message("glTX\2"), HasSubstr("a.glb: begins with the bytes 67 6C 54 58: neither a GLB"));
    EXPECT_THAT(message("\x89PNG"), HasSubstr("begins with the bytes 89 50 4E 47"));
    EXPECT_THAT(message("g"), HasSubstr("begins with the bytes 67: neither"));
    EXPECT_THAT(message("\xEF\xBB\xBF \n{ \"asset\": { \"version\": \"2.0\" } }"), "was loaded");
}

TEST(GltfBrokenFile, IntegersBeyond2To53SayThatTheyAreTooLarge) {
    TestFile file = TestFile::triangle();
    file.root["accessors"][0]["count"] = 9223372036854775808u; // 2^63
    EXPECT_THAT(refusal(file), HasSubstr("accessors[0].count: 9.2233720368547758e+18 is beyond 2^53"));
}

TEST(GltfBrokenFile, NumbersBeyondDoubleAreRefused) {
    jobs::JobSystem jobs({ .workers = 0 });
    const std::string text = R"({ "asset": { "version": "2.0" }, "x": 1e999 })";
    EXPECT_FALSE(loadGltfFromMemory(std::as_bytes(std::span(text)), ".", jobs));
}

TEST(GltfBrokenFile, OtherVersionsAreUnsupported) {
    TestFile file = TestFile::triangle();
    file.root["asset"]["version"] = "1.0";
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("asset.version: '1.0'"));
    file.root.erase("asset");
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("asset.version"));
}

TEST(GltfBrokenFile, TruncatedContainersNameTheChunk) {
    const Bytes whole = TestFile::triangle().glb();
    jobs::JobSystem jobs({ .workers = 0 });
    Bytes cut(whole.begin(), whole.end() - 8);
    EXPECT_THAT(loadGltfFromMemory(cut, ".", jobs).error().message, HasSubstr("the GLB header promises"));
    const auto length = static_cast<uint32_t>(cut.size());
    std::memcpy(&cut[8], &length, 4); // a header that agrees with the cut
    EXPECT_THAT(loadGltfFromMemory(cut, ".", jobs).error().message, HasSubstr("GLB chunk 1 has 36 bytes, only 28"));
    EXPECT_THAT(loadGltfFromMemory(std::span(whole).first(6), ".", jobs).error().message,
                HasSubstr("header is cut off"));
}

TEST(GltfBrokenFile, BuffersWithoutDataAreRefusedWhenTheyAreRead) {
    TestFile file = TestFile::triangle();
    file.root["buffers"] = { { { "byteLength", 36 } }, { { "byteLength", 36 } } };
    EXPECT_TRUE(file.load());
    file.root["bufferViews"][0]["buffer"] = 1;
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: buffers[1] has no data"));
}

TEST(GltfBrokenFile, FilesOutsideTheFolderAreNotOpened) {
    for (const char* uri : { "../secret.bin", "a/../../secret.bin", "/etc/hostname", "%2e%2e/secret.bin" }) {
        TestFile file = TestFile::triangle();
        file.root["buffers"] = { { { "byteLength", 36 }, { "uri", uri } } };
        EXPECT_THAT(refusal(file, ErrorCode::InvalidArgument), HasSubstr("lies outside the folder of the file")) << uri;
    }
    for (const char* uri : { "http://example.org/a.bin", "file:///etc/hostname" }) {
        TestFile file = TestFile::triangle();
        file.root["buffers"] = { { { "byteLength", 36 }, { "uri", uri } } };
        EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("not a file beside the model")) << uri;
    }
}

TEST(GltfBrokenFile, MissingFilesAreNamed) {
    TestFile file = TestFile::triangle();
    file.root["buffers"] = { { { "byteLength", 36 }, { "uri", "nowhere.bin" } } };
    EXPECT_THAT(refusal(file, ErrorCode::NotFound), AllOf(HasSubstr("buffers[0]"), HasSubstr("nowhere.bin")));
    file.root["buffers"] = { { { "byteLength", 36 }, { "uri", "." } } };
    EXPECT_THAT(refusal(file, ErrorCode::Unreadable), HasSubstr("not a regular file"));
    jobs::JobSystem jobs({ .workers = 0 });
    const Result<ModelData> model = loadGltf("no/such/model.glb", jobs);
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().code, ErrorCode::NotFound);
}

TEST(GltfBrokenFile, BrokenImagesAreNamed) {
    TestFile file = TestFile::triangle();
    file.root["images"] = { { { "uri", "data:image/png;base64,iVBORw0KGgoAAAANSUhEUg==" } } };
    file.root["textures"] = { { { "source", 0 } } };
    file.root["materials"] = { { { "emissiveTexture", { { "index", 0 } } } } };
    file.primitive()["material"] = 0;
    EXPECT_THAT(refusal(file), HasSubstr("images[0]"));
    file.root["images"] = { { { "uri", "data:image/png;base64,####" } } };
    EXPECT_THAT(refusal(file), AllOf(HasSubstr("images[0]"), HasSubstr("not base64")));
    file.root["images"] = { Json::object() };
    EXPECT_THAT(refusal(file), HasSubstr("images[0]: needs a uri or a bufferView"));
}

TEST(GltfBrokenFile, CompressedStreamsThatAreBrokenAreNamed) {
    TestFile file = TestFile::triangle();
    file.primitive()["extensions"]["KHR_draco_mesh_compression"] = { { "bufferView", 0 },
                                                                     { "attributes", { { "POSITION", 0 } } } };
    EXPECT_THAT(refusal(file), HasSubstr("meshes[0].primitives[0]: the Draco stream is broken"));
    file = TestFile::triangle();
    Json meshopt{
        { "buffer", 0 }, { "byteLength", 36 }, { "byteStride", 12 }, { "count", 3 }, { "mode", "ATTRIBUTES" }
    };
    file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = meshopt;
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: the meshopt stream is broken"));
    meshopt["count"] = 1'000'000'000;
    file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = meshopt;
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: 36 compressed bytes cannot hold"));
    meshopt["byteStride"] = 7;
    file.root["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = meshopt;
    EXPECT_THAT(refusal(file), HasSubstr("bufferViews[0]: the byteStride of ATTRIBUTES must be a multiple of 4"));
}

TEST(GltfBrokenFile, JointsThatTheSkinLacksAreRefused) {
    TestFile file = TestFile::triangle();
    file.attribute("JOINTS_0", std::vector<uint8_t>(12, 1), kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>(12, 0.25f), kFloat, "VEC4", 4);
    file.root["skins"] = Json::parse(R"([ { "joints": [ 0 ] } ])");
    file.root["nodes"][0]["skin"] = 0;
    EXPECT_THAT(refusal(file), HasSubstr("names a joint that its skin lacks"));
    file.root["skins"] = Json::parse(R"([ { "joints": [] } ])");
    EXPECT_THAT(refusal(file), HasSubstr("skins[0]: 0 joints"));
}

TEST(GltfBrokenFile, TransformsThatOverflowAreRefused) {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(
            R"([ { "scale": [ 1e200, 1, 1 ], "children": [ 1 ] }, { "scale": [ 1e200, 1, 1 ], "mesh": 0 } ])");
    EXPECT_THAT(refusal(file), HasSubstr("nodes[1]: its transform is not finite"));
}

// A scene has 2^20 handles of a type; a file of some kilobytes can request more.
TEST(GltfBrokenFile, ScenesOfMoreNodesThanTheEngineHoldsAreRefused) {
    TestFile file = TestFile::triangle();
    const size_t translations =
            file.addAccessor({ { "componentType", int(kFloat) }, { "count", 300'000 }, { "type", "VEC3" } });
    Json node{ { "mesh", 0 } };
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = translations;
    file.root["nodes"] = { node };
    EXPECT_EQ(loaded(file).nodes.size(), 300'001u);
    file.root["nodes"] = { node, node };
    file.root["scenes"][0]["nodes"] = { 0, 1 };
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("more than 500000 nodes and instances"));
    file.root["accessors"][translations]["count"] = 1'048'576;
    EXPECT_THAT(refusal(file),
                HasSubstr("nodes[0]: the instance attributes differ in length, or are more than 500000"));
}

TEST(GltfBrokenFile, NodesThatPlaceMorePrimitivesThanTheEngineHoldsAreRefused) {
    TestFile file = TestFile::triangle();
    Json nodes = Json::array(), roots = Json::array();
    for (int i = 0; i < 1001; ++i) {
        nodes.push_back({ { "mesh", 0 } });
        roots.push_back(i);
    }
    Json& primitives = file.root["meshes"][0]["primitives"];
    while (primitives.size() < 500) primitives.push_back(Json(primitives[0]));
    file.root["nodes"] = std::move(nodes);
    file.root["scenes"][0]["nodes"] = std::move(roots);
    EXPECT_THAT(refusal(file, ErrorCode::Unsupported), HasSubstr("places 500500 primitives and variants"));
}

TEST(GltfBrokenFile, WarningsStopGrowing) {
    TestFile file = TestFile::triangle();
    Json materials = Json::array();
    for (int i = 0; i < 200; ++i) materials.push_back({ { "alphaMode", "FOG" } });
    file.root["materials"] = std::move(materials);
    const ModelData model = loaded(file);
    ASSERT_EQ(model.warnings.size(), 65u);
    EXPECT_EQ(model.warnings.back(), "136 more warnings are not shown");
}

} // namespace
} // namespace filament_core::assets::test
