// SPDX-License-Identifier: Apache-2.0
// The errors of the Khronos glTF-Validator (its ISSUES.md) that concern what this loader reads: each with a file that
// has it, and what the loader answers. A file that is right except for that code comes from wholeFile().
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using ::testing::HasSubstr;

enum class Answer : uint8_t {
    Error,   ///< the file is refused
    Warning, ///< repaired with a warning
    Ignored, ///< loaded without a word; the reason stands in the row
};

struct Case {
    const char* code;  ///< of the validator
    const char* patch; ///< RFC 6902
    Answer answer;
    const char* text;      ///< part of the message; of Ignored: the reason
    const char* poke = ""; ///< "accessor component value", replaces a float of the data
};

enum Accessors { kPosition, kNormal, kUv, kJoints, kWeights, kTarget, kBind, kTimes, kTurns, kIndices };

/// One of everything: a skinned, morphed, animated, textured triangle, a camera, a lamp.
TestFile wholeFile() {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.attribute("JOINTS_0", std::vector<uint16_t>(12, 0), kUShort, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 }, kFloat, "VEC4", 4);
    const size_t target = file.add(std::vector<float>(9, 0.1f), kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    file.add(std::vector<float>{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }, kFloat, "MAT4", 16);
    file.add(std::vector<float>{ 0, 1 }, kFloat, "SCALAR", 1);
    file.add(std::vector<float>{ 0, 0, 0, 1, 0, 0, 0, 1 }, kFloat, "VEC4", 4);
    file.indices({ 0, 1, 2 });
    file.primitive()["material"] = 0;
    file.root.merge_patch(Json::parse(R"({
        "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
        "nodes": [ { "mesh": 0, "skin": 0, "weights": [ 0.5 ] }, { "rotation": [ 0, 0, 0, 1 ], "camera": 0 } ],
        "cameras": [ { "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } } ],
        "skins": [ { "joints": [ 1 ], "inverseBindMatrices": 6, "skeleton": 1 } ],
        "animations": [ { "samplers": [ { "input": 7, "output": 8 } ],
                          "channels": [ { "sampler": 0, "target": { "node": 1, "path": "rotation" } } ] } ],
        "extensionsUsed": [ "KHR_lights_punctual" ],
        "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point" } ] } },
        "materials": [ { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ],
        "textures": [ { "source": 0, "sampler": 0 } ], "samplers": [ {} ],
        "images": [ { "mimeType": "image/png", "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==" } ]
    })"));
    return file;
}

void poke(TestFile& file, const char* words) {
    int accessor = 0, component = 0;
    float value = 0;
    if (std::sscanf(words, "%d %d %f", &accessor, &component, &value) != 3) return;
    Json const& view =
            file.root["bufferViews"][file.root["accessors"][static_cast<size_t>(accessor)]["bufferView"].get<size_t>()];
    std::memcpy(&file.binary[view["byteOffset"].get<size_t>() + 4 * static_cast<size_t>(component)], &value, 4);
}

constexpr auto kError = Answer::Error, kWarning = Answer::Warning, kIgnored = Answer::Ignored;

const Case kCases[] = {
    // schema
    { "INVALID_INDEX", R"([{"op":"replace","path":"/nodes/0/mesh","value":-1}])", kError, "nodes[0].mesh" },
    { "TYPE_MISMATCH", R"([{"op":"replace","path":"/nodes/0/mesh","value":"a"}])", kError, "found string" },
    { "ARRAY_TYPE_MISMATCH", R"([{"op":"replace","path":"/scenes/0/nodes","value":["a"]}])", kError, "scenes[0]" },
    { "ARRAY_LENGTH_NOT_IN_LIST", R"([{"op":"replace","path":"/nodes/1/rotation","value":[0,0,1]}])", kError,
      "rotation" },
    { "UNDEFINED_PROPERTY", R"([{"op":"remove","path":"/accessors/0/componentType"}])", kError, "componentType" },
    { "VALUE_NOT_IN_LIST", R"([{"op":"replace","path":"/accessors/0/type","value":"VEC5"}])", kError, "VEC5" },
    { "VALUE_NOT_IN_RANGE", R"([{"op":"add","path":"/materials/0/pbrMetallicRoughness/metallicFactor","value":2}])",
      kWarning, "metallicFactor" },
    { "ONE_OF_MISMATCH", R"([{"op":"add","path":"/images/0/bufferView","value":0}])", kError, "not both" },
    { "INVALID_URI", R"([{"op":"replace","path":"/images/0/uri","value":"data:image/png;base64,*"}])", kError,
      "images[0]" },
    { "UNEXPECTED_PROPERTY", R"([{"op":"add","path":"/nodes/0/mesg","value":1}])", kIgnored,
      "later minor versions add properties" },
    { "DUPLICATE_ELEMENTS", R"([{"op":"add","path":"/scenes/0/nodes/1","value":0}])", kError, "listed twice" },
    // links
    { "UNRESOLVED_REFERENCE/mesh", R"([{"op":"replace","path":"/nodes/0/mesh","value":7}])", kError, "out of range" },
    { "UNRESOLVED_REFERENCE/skin", R"([{"op":"replace","path":"/nodes/0/skin","value":7}])", kError, "out of range" },
    { "UNRESOLVED_REFERENCE/camera", R"([{"op":"replace","path":"/nodes/1/camera","value":7}])", kError,
      "nodes[1].camera: index 7 is out of range" },
    { "UNRESOLVED_REFERENCE/skeleton", R"([{"op":"replace","path":"/skins/0/skeleton","value":7}])", kIgnored,
      "a hint for editors, not read" },
    { "UNRESOLVED_REFERENCE/scene", R"([{"op":"replace","path":"/scene","value":1}])", kError, "scene: index 1" },
    { "UNRESOLVED_REFERENCE/sceneOfNone",
      R"([{"op":"remove","path":"/scenes"},{"op":"replace","path":"/scene","value":0}])", kError, "scene: index 0" },
    { "UNRESOLVED_REFERENCE/joint", R"([{"op":"replace","path":"/skins/0/joints/0","value":7}])", kError,
      "skins[0].joints" },
    { "UNRESOLVED_REFERENCE/texture",
      R"([{"op":"replace","path":"/materials/0/pbrMetallicRoughness/baseColorTexture/index","value":7}])", kError,
      "out of range" },
    { "UNRESOLVED_REFERENCE/image", R"([{"op":"replace","path":"/textures/0/source","value":7}])", kError,
      "out of range" },
    { "UNRESOLVED_REFERENCE/sampler", R"([{"op":"replace","path":"/textures/0/sampler","value":7}])", kError,
      "out of range" },
    { "UNRESOLVED_REFERENCE/input", R"([{"op":"replace","path":"/animations/0/samplers/0/input","value":70}])", kError,
      "out of range" },
    { "ACCESSOR_TOO_LONG", R"([{"op":"replace","path":"/accessors/0/count","value":4}])", kError, "end at byte" },
    { "BUFFER_VIEW_TOO_LONG", R"([{"op":"replace","path":"/bufferViews/0/byteLength","value":99999}])", kError,
      "ends at byte" },
    { "ACCESSOR_SMALL_BYTESTRIDE", R"([{"op":"add","path":"/bufferViews/0/byteStride","value":4}])", kIgnored,
      "elements overlap, as in an indexed curve; they are inside of the view" },
    { "NODE_LOOP", R"([{"op":"add","path":"/nodes/1/children","value":[1]}])", kError, "nodes[1].children" },
    { "NODE_PARENT_OVERRIDE",
      R"([{"op":"add","path":"/nodes/0/children","value":[1]},{"op":"add","path":"/nodes/1/children","value":[1]}])",
      kError, "another parent" },
    { "SCENE_NON_ROOT_NODE", R"([{"op":"add","path":"/nodes/0/children","value":[1]}])", kError, "not a root" },
    { "NODE_SKINNED_MESH_WITHOUT_SKIN", R"([{"op":"remove","path":"/nodes/0/skin"}])", kIgnored,
      "drawn at rest, as viewers do" },
    { "NODE_SKIN_WITH_NON_SKINNED_MESH", R"([{"op":"remove","path":"/meshes/0/primitives/0/attributes/JOINTS_0"}])",
      kWarning, "no joints or weights" },
    { "INVALID_IBM_ACCESSOR_COUNT", R"([{"op":"replace","path":"/skins/0/joints","value":[1,1]}])", kError,
      "do not match" },
    { "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", R"([{"op":"replace","path":"/accessors/1/count","value":2}])", kError,
      "NORMAL has 2 elements" },
    { "MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT",
      R"([{"op":"replace","path":"/accessors/5/count","value":2}])", kError, "morph target has 2" },
    { "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
      R"([{"op":"replace","path":"/accessors/1/type","value":"VEC2"}])", kError, "do not serve as NORMAL" },
    { "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
      R"([{"op":"replace","path":"/accessors/9/type","value":"VEC2"},{"op":"replace","path":"/accessors/9/count","value":1}])",
      kError, "accessors[9]" },
    { "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", "[]", kIgnored, "bounds are computed from the data" },
    { "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", R"([{"op":"replace","path":"/accessors/8/count","value":1}])",
      kWarning, "left out" },
    { "ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT",
      R"([{"op":"replace","path":"/animations/0/samplers/0/input","value":0}])", kError, "accessors[0]" },
    { "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
      R"([{"op":"replace","path":"/animations/0/channels/0/target/path","value":"weights"}])", kWarning,
      "no morph targets" },
    { "UNSUPPORTED_EXTENSION", R"([{"op":"add","path":"/extensionsUsed/-","value":"EXT_wax"}])", kWarning, "EXT_wax" },
    { "UNSUPPORTED_EXTENSION/required", R"([{"op":"add","path":"/extensionsRequired","value":["EXT_wax"]}])", kError,
      "required" },
    { "TEXTURE_INVALID_IMAGE_MIME_TYPE", R"([{"op":"replace","path":"/images/0/mimeType","value":"image/webp"}])",
      kIgnored, "the bytes of the file decide" },
    // semantics
    { "UNKNOWN_ASSET_MAJOR_VERSION", R"([{"op":"replace","path":"/asset/version","value":"3.0"}])", kError, "'3.0'" },
    { "UNKNOWN_ASSET_MINOR_VERSION", R"([{"op":"replace","path":"/asset/version","value":"2.9"}])", kIgnored,
      "minor versions are compatible" },
    { "ASSET_MIN_VERSION_GREATER_THAN_VERSION", R"([{"op":"add","path":"/asset/minVersion","value":"2.1"}])", kError,
      "asset.minVersion: '2.1'" },
    { "ROTATION_NON_UNIT", R"([{"op":"replace","path":"/nodes/1/rotation","value":[0,0,0,2]}])", kWarning,
      "nodes[1].rotation: its length is not 1" },
    { "NODE_MATRIX_NON_TRS",
      R"([{"op":"replace","path":"/nodes/1","value":{"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}}])", kWarning,
      "last row" },
    { "MESH_INVALID_WEIGHTS_COUNT", R"([{"op":"add","path":"/meshes/0/weights","value":[1,1]}])", kWarning,
      "meshes[0].weights: 2 weights for 1 morph targets" },
    { "NODE_WEIGHTS_INVALID", R"([{"op":"replace","path":"/nodes/0/weights","value":[1,1,1]}])", kWarning,
      "nodes[0].weights: 3 weights for 1 morph targets" },
    { "MESH_PRIMITIVE_NO_POSITION", R"([{"op":"remove","path":"/meshes/0/primitives/0/attributes/POSITION"}])",
      kWarning, "no POSITION" },
    { "MESH_PRIMITIVE_INVALID_ATTRIBUTE", R"([{"op":"add","path":"/meshes/0/primitives/0/attributes/HEAT","value":0}])",
      kIgnored, "attributes of applications are not read" },
    { "CAMERA_ZFAR_LEQUAL_ZNEAR", R"([{"op":"add","path":"/cameras/0/perspective/zfar","value":0.01}])", kIgnored,
      "cameras are not read" },
    { "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES",
      R"([{"op":"replace","path":"/extensions/KHR_lights_punctual/lights/0","value":{"type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5}}},
          {"op":"add","path":"/nodes/1/extensions","value":{"KHR_lights_punctual":{"light":0}}}])",
      kWarning, "inner cone" },
    { "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", R"([{"op":"add","path":"/bufferViews/0/byteStride","value":5000}])", kError,
      "byteStride" },
    { "MATERIAL_ALPHA_CUTOFF_INVALID_MODE", R"([{"op":"add","path":"/materials/0/alphaCutoff","value":0.5}])", kIgnored,
      "the cutoff of other modes is not read" },
    // data
    { "ACCESSOR_MIN_MISMATCH", R"([{"op":"add","path":"/accessors/0/min","value":[-9,-9,-9]}])", kIgnored,
      "bounds are computed from the data" },
    { "ACCESSOR_MAX_MISMATCH", R"([{"op":"add","path":"/accessors/0/max","value":[0.5,0.5,0.5]}])", kIgnored,
      "bounds are computed from the data" },
    { "ACCESSOR_INVALID_FLOAT", "[]", kWarning, "not finite", "0 4 nan" },
    { "ACCESSOR_VECTOR3_NON_UNIT", "[]", kIgnored, "normals are normalised", "1 2 5" },
    { "ACCESSOR_WEIGHTS_NON_NORMALIZED", "[]", kIgnored, "weights are normalised", "4 0 0.5" },
    { "ACCESSOR_ANIMATION_INPUT_NON_INCREASING", "[]", kWarning, "1 earlier than the one before", "7 1 -1" },
    { "ACCESSOR_ANIMATION_INPUT_NEGATIVE", "[]", kWarning, "do not grow from 0 on: 1 before 0", "7 0 -1" },
    { "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION", "[]", kIgnored, "rotations are normalised",
      "8 3 2" },
    { "ACCESSOR_INVALID_IBM", "[]", kIgnored, "the last row is not used", "6 3 1" },
    { "ACCESSOR_INDEX_OOB", R"([{"op":"replace","path":"/meshes/0/primitives/0/indices","value":3}])", kError,
      "accessors[3]" },
    { "ACCESSOR_JOINTS_INDEX_OOB", "[]", kError, "joint that its skin lacks", "3 0 1.4e-45" },
    { "IMAGE_UNRECOGNIZED_FORMAT", R"([{"op":"replace","path":"/images/0/uri","value":"data:;base64,AAAA"}])", kError,
      "none of PNG, JPEG, WebP, AVIF, KTX2 and DDS" },
    { "IMAGE_UNEXPECTED_EOS",
      R"([{"op":"replace","path":"/images/0/uri","value":"data:;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAA="}])",
      kError, "cut short" },
    { "IO_ERROR", R"([{"op":"replace","path":"/images/0/uri","value":"none.png"}])", kError, "none.png" },
};

class Validator : public ::testing::TestWithParam<Case> {};

TEST_P(Validator, GetsTheAnswerOfTheTable) {
    Case const& row = GetParam();
    TestFile file = wholeFile();
    file.root = file.root.patch(Json::parse(row.patch));
    poke(file, row.poke);
    const Result<ModelData> model = file.load({ .deformation = GltfDeformation::Kept });
    if (row.answer == kError) {
        ASSERT_FALSE(model) << "was loaded";
        EXPECT_THAT(model.error().message, HasSubstr(row.text));
        return;
    }
    ASSERT_TRUE(model) << model.error().message;
    if (row.answer == kWarning)
        EXPECT_THAT(model->warnings, ::testing::Contains(HasSubstr(row.text)));
    else
        EXPECT_THAT(model->warnings, ::testing::IsEmpty()) << "ignored because " << row.text;
}

std::string nameOf(::testing::TestParamInfo<Case> const& each) {
    std::string name = each.param.code;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Codes, Validator, ::testing::ValuesIn(kCases), nameOf);

// ---------------------------------------------------------------------------------------------- the container

/// A .glb in pieces, in the order in which they are written.
struct Container {
    struct Chunk {
        uint32_t type = 0;
        std::string data;
        int claims = 0; ///< bytes that its header claims beyond those that are there
    };
    uint32_t magic = 0x46546C67, version = 2;
    int claims = 0; ///< of all files
    std::vector<Chunk> chunks;
    std::string rest;  ///< behind the last chunk, counted by the length
    std::string extra; ///< behind that, and not counted
    size_t cut = ~size_t{ 0 };

    Bytes bytes() const {
        std::string file(12, '\0');
        for (Chunk const& chunk : chunks) {
            append(file, static_cast<uint32_t>(chunk.data.size()) + static_cast<uint32_t>(chunk.claims));
            append(file, chunk.type);
            file += chunk.data;
        }
        file += rest;
        const std::array<uint32_t, 3> header{ magic, version,
                                              static_cast<uint32_t>(file.size()) + static_cast<uint32_t>(claims) };
        std::memcpy(file.data(), header.data(), sizeof(header));
        file = (file + extra).substr(0, cut);
        const auto all = std::as_bytes(std::span(file));
        return { all.begin(), all.end() };
    }

    static void append(std::string& file, uint32_t word) {
        file.append(reinterpret_cast<const char*>(&word), sizeof(word));
    }
};

constexpr uint32_t kJson = 0x4E4F534A, kBin = 0x004E4942, kUnknown = 0x21584157;

struct ContainerCase {
    const char* code;
    Answer answer;
    const char* text;
    void (*damage)(Container&);
};

const ContainerCase kContainerCases[] = {
    { "GLB_INVALID_MAGIC", kError, "neither a GLB", [](Container& c) { c.magic ^= 0x20; } },
    { "GLB_INVALID_VERSION", kError, "GLB version 1 is not 2", [](Container& c) { c.version = 1; } },
    { "GLB_LENGTH_TOO_SMALL", kError, "no JSON chunk",
      [](Container& c) { c.claims = 12 - static_cast<int>(c.bytes().size()); } },
    { "GLB_LENGTH_TOO_SMALL/header", kError, "promises 4 bytes",
      [](Container& c) { c.claims = 4 - static_cast<int>(c.bytes().size()); } },
    { "GLB_LENGTH_MISMATCH", kError, "the GLB header promises", [](Container& c) { c.claims = 4; } },
    { "GLB_EXTRA_DATA", kIgnored, "the length says where the file ends", [](Container& c) { c.extra = "tail"; } },
    { "GLB_CHUNK_LENGTH_UNALIGNED", kIgnored, "nothing is read in words of four bytes",
      [](Container& c) { c.chunks[0].data += " "; } },
    { "GLB_CHUNK_TOO_BIG", kError, "GLB chunk 1 has", [](Container& c) { c.chunks[1].claims = 4; } },
    { "GLB_CHUNK_TOO_BIG/2^32", kError, "GLB chunk 1 has 4294967295 bytes",
      [](Container& c) { c.chunks[1].claims = -1 - static_cast<int>(c.chunks[1].data.size()); } },
    { "GLB_EMPTY_CHUNK", kError, "no JSON chunk", [](Container& c) { c.chunks[0].data.clear(); } },
    { "GLB_EMPTY_BIN_CHUNK", kError, "buffers[0]", [](Container& c) { c.chunks[1].data.clear(); } },
    { "GLB_DUPLICATE_CHUNK/json", kIgnored, "the first one counts",
      [](Container& c) {
          c.chunks.push_back({ kJson, "{}  " });
      } },
    { "GLB_DUPLICATE_CHUNK/bin", kIgnored, "the first one counts",
      [](Container& c) {
          c.chunks.push_back({ kBin, "more" });
      } },
    { "GLB_UNEXPECTED_FIRST_CHUNK", kError, "the first GLB chunk is not JSON",
      [](Container& c) { std::swap(c.chunks[0], c.chunks[1]); } },
    { "GLB_UNEXPECTED_BIN_CHUNK", kError, "buffers[0]",
      [](Container& c) {
          c.chunks.insert(c.chunks.begin() + 1, { kUnknown, "wax." });
      } },
    { "GLB_UNKNOWN_CHUNK_TYPE", kIgnored, "section 4.4.3: unknown chunks are ignored",
      [](Container& c) {
          c.chunks.push_back({ kUnknown, "wax." });
      } },
    { "GLB_UNEXPECTED_END_OF_HEADER", kError, "the GLB header is cut off", [](Container& c) { c.cut = 10; } },
    { "GLB_UNEXPECTED_END_OF_CHUNK_HEADER", kError, "the GLB ends 5 bytes into a chunk header",
      [](Container& c) { c.rest = "space"; } },
    { "GLB_UNEXPECTED_END_OF_CHUNK_DATA", kError, "the GLB header promises",
      [](Container& c) { c.cut = c.bytes().size() - 4; } },
};

class ContainerValidator : public ::testing::TestWithParam<ContainerCase> {};

TEST_P(ContainerValidator, GetsTheAnswerOfTheTable) {
    TestFile file = wholeFile();
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    std::string text = file.root.dump();
    text.resize((text.size() + 3) & ~size_t{ 3 }, ' ');
    Container container{ .chunks = { { kJson, text },
                                     { kBin,
                                       { reinterpret_cast<const char*>(file.binary.data()), file.binary.size() } } } };
    jobs::JobSystem jobs({ .workers = 0 });
    const auto load = [&] {
        return loadGltfFromMemory(container.bytes(), ".", jobs, { .deformation = GltfDeformation::Kept });
    };
    ASSERT_TRUE(load()) << "whole before it is damaged";
    GetParam().damage(container);
    const Result<ModelData> model = load();
    ASSERT_EQ(model.ok(), GetParam().answer != kError) << (model ? "was loaded" : model.error().message);
    if (model)
        EXPECT_THAT(model->warnings, ::testing::IsEmpty()) << "ignored because " << GetParam().text;
    else
        EXPECT_THAT(model.error().message, HasSubstr(GetParam().text));
}

std::string nameOfContainer(::testing::TestParamInfo<ContainerCase> const& each) {
    std::string name = each.param.code;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Codes, ContainerValidator, ::testing::ValuesIn(kContainerCases), nameOfContainer);

TEST(ValidatorTable, StartsFromAFileWithoutAnyOfThem) {
    const Result<ModelData> model = wholeFile().load({ .deformation = GltfDeformation::Kept });
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, ::testing::IsEmpty());
}

} // namespace
} // namespace filament_core::assets::test
