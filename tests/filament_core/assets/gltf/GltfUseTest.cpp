// SPDX-License-Identifier: Apache-2.0
// What the drawn scene does not use may be broken: each way to break an element is tried on one that the scene uses,
// which is an error, and on one that it does not use, which is a warning and changes nothing of the model.
#include "filament_core/assets/files/FileBytes.h"
#include "tests/filament_core/assets/FaultFile.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// An array of the file, with an element that is used and one that is not.
struct ElementKind {
    const char* array;      ///< JSON pointer
    const char* unused;     ///< is appended
    const char* use = "[]"; ///< patch that makes it used, of kinds of which usedFile() has none
};

constexpr ElementKind kBufferKind{ "/buffers", R"({ "byteLength": 3, "uri": "data:;base64,AAAA" })" };
constexpr ElementKind kViewKind{ "/bufferViews", R"({ "buffer": 0, "byteLength": 16 })" };
constexpr ElementKind kAccessorKind{ "/accessors", R"({ "componentType": 5126, "type": "SCALAR", "count": 1 })" };
constexpr ElementKind kMeshKind{ "/meshes", R"({ "primitives": [ { "attributes": { "POSITION": 0 } } ] })" };
constexpr ElementKind kNodeKind{ "/nodes", R"({ "mesh": 0 })" };
constexpr ElementKind kSkinKind{ "/skins", R"({ "joints": [ 1 ] })" };
constexpr ElementKind kImageKind{ "/images", R"({ "uri": "data:;base64,AAAA" })" };
constexpr ElementKind kSamplerKind{ "/samplers", "{}" };
constexpr ElementKind kMaterialKind{ "/materials", R"({ "pbrMetallicRoughness": {} })" };
constexpr ElementKind kTextureKind{ "/textures", R"({ "source": 0 })" };
constexpr ElementKind kCameraKind{ "/cameras",
                                   R"({ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } })" };
constexpr ElementKind kLightKind{ "/extensions/KHR_lights_punctual/lights", R"({ "type": "point" })" };
constexpr ElementKind kAnimationKind{ "/animations", R"({ "samplers": [ { "input": 3, "output": 4 } ],
    "channels": [ { "sampler": 0, "target": { "node": 2, "path": "translation" } } ] })",
                                      R"([ { "op": "add", "path": "/scenes/0/nodes/-", "value": 2 } ])" };
constexpr ElementKind kProfileKind{
    "/extensions/EXT_lights_ies/lights", R"({ "uri": "none.ies" })",
    R"([ { "op": "add", "path": "/nodes/0/extensions/EXT_lights_ies", "value": { "light": 0 } } ])"
};
constexpr ElementKind kImageBasedKind{
    "/extensions/EXT_lights_image_based/lights",
    R"({ "irradianceCoefficients": [[1,1,1],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]],
         "specularImageSize": 1, "specularImages": [ [ 0, 0, 0, 0, 0, 0 ] ] })",
    R"([ { "op": "add", "path": "/scenes/0/extensions", "value": { "EXT_lights_image_based": { "light": 0 } } } ])"
};

struct Breakage {
    ElementKind const& kind;
    const char* path;  ///< below the element; "": all of it
    const char* value; ///< null: the member is removed
    const char* text;  ///< of the message
};

const Breakage kBreakages[] = {
    { kBufferKind, "", "7", "must be an object" },
    { kBufferKind, "/byteLength", nullptr, "byteLength" },
    { kBufferKind, "/byteLength", "-1", "byteLength" },
    { kBufferKind, "/byteLength", "\"x\"", "byteLength" },
    { kBufferKind, "/byteLength", "1e30", "beyond 2^53" },
    { kBufferKind, "/byteLength", "4000", "of 4000 bytes are present" },
    { kBufferKind, "/uri", "\"none.bin\"", "none.bin" },
    { kBufferKind, "/uri", "\"../none.bin\"", "outside the folder" },
    { kBufferKind, "/uri", "\"http://example.org/a.bin\"", "not a file beside the model" },
    { kBufferKind, "/uri", "5", "uri: must be a string" },
    { kViewKind, "", "[]", "must be an object" },
    { kViewKind, "/buffer", "99", "buffer: index 99" },
    { kViewKind, "/buffer", nullptr, "buffer: missing" },
    { kViewKind, "/byteLength", nullptr, "byteLength" },
    { kViewKind, "/byteLength", "99999", "ends at byte" },
    { kViewKind, "/byteOffset", "\"x\"", "byteOffset" },
    { kViewKind, "/byteStride", "5000", "byteStride" },
    { kViewKind, "/extensions", R"({ "EXT_meshopt_compression": {} })", "EXT_meshopt_compression.buffer: missing" },
    { kViewKind, "/extensions",
      R"({ "EXT_meshopt_compression": { "buffer": 0, "byteLength": 8, "byteStride": 4, "count": 2, "mode": "X" } })",
      "'X'" },
    { kViewKind, "/extensions",
      R"({ "EXT_meshopt_compression": { "buffer": 0, "byteLength": 8, "byteStride": 4, "count": 2,
           "mode": "ATTRIBUTES" } })",
      "meshopt stream is broken" },
    { kAccessorKind, "", "null", "must be an object" },
    { kAccessorKind, "/componentType", "5124", "componentType" },
    { kAccessorKind, "/componentType", nullptr, "componentType" },
    { kAccessorKind, "/type", "\"VEC9\"", "VEC9" },
    { kAccessorKind, "/type", nullptr, "type" },
    { kAccessorKind, "/count", nullptr, "count" },
    { kAccessorKind, "/count", "1e15", "beyond the limit" },
    { kAccessorKind, "/bufferView", "99", "bufferView: index 99" },
    { kAccessorKind, "/byteOffset", "-1", "byteOffset" },
    { kAccessorKind, "/normalized", "\"x\"", "normalized" },
    { kAccessorKind, "/sparse", R"({ "count": 1 })", "sparse.indices.bufferView: missing" },
    { kMeshKind, "", "7", "must be an object" },
    { kMeshKind, "/primitives", "7", "primitives: must be an array" },
    { kMeshKind, "/primitives/0/attributes/POSITION", "99", "POSITION: index 99" },
    { kMeshKind, "/primitives/0/indices", "99", "indices: index 99" },
    { kMeshKind, "/primitives/0/material", "99", "material: index 99" },
    { kMeshKind, "/primitives/0/mode", "9", "mode: 9" },
    { kMeshKind, "/primitives/0/targets", "5", "targets: must be an array" },
    { kMeshKind, "/primitives/0/extensions", R"({ "KHR_draco_mesh_compression": { "bufferView": 99 } })", "index 99" },
    { kMeshKind, "/primitives/0/extensions",
      R"({ "KHR_materials_variants": { "mappings": [ { "material": 99, "variants": [] } ] } })", "index 99" },
    { kMeshKind, "/weights", "\"x\"", "weights" },
    { kNodeKind, "", "7", "must be an object" },
    { kNodeKind, "/mesh", "99", "mesh: index 99" },
    { kNodeKind, "/skin", "99", "skin: index 99" },
    { kNodeKind, "/camera", "99", "camera: index 99" },
    { kNodeKind, "/children", "[ 99 ]", "children[0]: index 99" },
    { kNodeKind, "/children", "\"x\"", "children: must be an array" },
    { kNodeKind, "/children", "[ 1 ]", "another parent already" },
    { kNodeKind, "/translation", "[ 1 ]", "translation: must be an array of 3 numbers" },
    { kNodeKind, "/rotation", "\"x\"", "rotation" },
    { kNodeKind, "/matrix", "[ 1 ]", "matrix" },
    { kNodeKind, "/weights", "[ \"x\" ]", "weights" },
    { kNodeKind, "/extensions", R"({ "KHR_lights_punctual": { "light": 99 } })", "light: index 99" },
    { kNodeKind, "/extensions", R"({ "EXT_mesh_gpu_instancing": { "attributes": { "SCALE": 99 } } })",
      "SCALE: index 99" },
    { kSkinKind, "", "7", "must be an object" },
    { kSkinKind, "/joints", "[ 99 ]", "joints[0]: index 99" },
    { kSkinKind, "/joints", "\"x\"", "joints: must be an array" },
    { kSkinKind, "/inverseBindMatrices", "99", "inverseBindMatrices: index 99" },
    { kImageKind, "", "{}", "needs a uri or a bufferView" },
    { kImageKind, "", "7", "must be an object" },
    { kImageKind, "/bufferView", "0", "not both" },
    { kImageKind, "/bufferView", "99", "bufferView: index 99" },
    { kImageKind, "/uri", "5", "uri: must be a string" },
    { kSamplerKind, "", "7", "must be an object" },
    { kSamplerKind, "/minFilter", "\"x\"", "minFilter" },
    { kSamplerKind, "/wrapS", "-1", "wrapS" },
    { kMaterialKind, "", "7", "must be an object" },
    { kMaterialKind, "/pbrMetallicRoughness", "5", "pbrMetallicRoughness: must be an object" },
    { kMaterialKind, "/pbrMetallicRoughness/baseColorTexture", R"({ "index": 99 })", "index: index 99" },
    { kMaterialKind, "/pbrMetallicRoughness/baseColorTexture", "{}", "index: missing" },
    { kMaterialKind, "/pbrMetallicRoughness/metallicFactor", "\"x\"", "metallicFactor" },
    { kMaterialKind, "/pbrMetallicRoughness/baseColorFactor", "[ 1 ]", "baseColorFactor" },
    { kMaterialKind, "/alphaMode", "5", "alphaMode" },
    { kMaterialKind, "/doubleSided", "1", "doubleSided" },
    { kMaterialKind, "/extensions", R"({ "KHR_materials_sheen": { "sheenColorFactor": [ 1 ] } })", "sheenColorFactor" },
    { kMaterialKind, "/normalTexture", R"({ "index": 0, "texCoord": -1 })", "texCoord" },
    { kTextureKind, "", "7", "must be an object" },
    { kTextureKind, "/source", "99", "source: index 99" },
    { kTextureKind, "/sampler", "99", "sampler: index 99" },
    { kTextureKind, "/extensions", R"({ "KHR_texture_basisu": { "source": 99 } })", "source: index 99" },
    { kCameraKind, "", "7", "must be an object" },
    { kCameraKind, "/perspective", "5", "perspective: must be an object" },
    { kCameraKind, "/perspective/yfov", "\"x\"", "yfov" },
    { kCameraKind, "/type", "5", "type" },
    { kLightKind, "", "7", "must be an object" },
    { kLightKind, "/intensity", "\"x\"", "intensity" },
    { kLightKind, "/color", "[ 1 ]", "color" },
    { kAnimationKind, "/samplers/0/input", "99", "input: index 99" },
    { kAnimationKind, "/samplers/0/output", nullptr, "output: missing" },
    { kAnimationKind, "/channels/0/sampler", "99", "sampler: index 99" },
    { kAnimationKind, "/samplers/0", "7", "must be an object" },
    { kProfileKind, "", "{}", "needs a uri or a bufferView" },
    { kProfileKind, "/mimeType", "\"text\"", "mimeType" },
    { kProfileKind, "/bufferView", "99", "bufferView: index 99" },
    { kImageBasedKind, "", "7", "must be an object" },
    { kImageBasedKind, "/irradianceCoefficients", nullptr, "irradianceCoefficients" },
    { kImageBasedKind, "/specularImageSize", "3", "not a power of two" },
    { kImageBasedKind, "/specularImages", "[ [ 99 ] ]", "has 1 images instead of 6" },
    { kImageBasedKind, "/specularImages", nullptr, "specularImages" },
};

/// A textured, skinned, animated triangle with a lamp and a camera: everything of it is used but node 2, which no scene
/// lists.
TestFile usedFile() {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0 });
    file.attribute("JOINTS_0", std::vector<uint8_t>(12, 0), kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 }, kFloat, "VEC4", 4);
    file.add(std::vector<float>{ 0, 1 }, kFloat, "SCALAR", 1);
    file.add(std::vector<float>(6, 1.0f), kFloat, "VEC3", 3);
    file.primitive()["material"] = 0;
    file.root.merge_patch(Json::parse(R"({
        "scenes": [ { "nodes": [ 0, 1 ] } ],
        "nodes": [ { "mesh": 0, "skin": 0, "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } }, {},
                   {} ],
        "cameras": [ { "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } } ],
        "skins": [ { "joints": [ 1 ] } ],
        "animations": [ { "samplers": [ { "input": 3, "output": 4 } ],
                          "channels": [ { "sampler": 0, "target": { "node": 1, "path": "translation" } } ] } ],
        "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point" } ] },
                        "EXT_lights_ies": { "lights": [] }, "EXT_lights_image_based": { "lights": [] } },
        "materials": [ { "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } } ],
        "textures": [ { "source": 0, "sampler": 0 } ], "samplers": [ {} ],
        "images": [ { "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==" } ]
    })"));
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return file;
}

void applyPatch(TestFile& file, const char* text) { file.root = file.root.patch(Json::parse(text)); }

/// The element is there already, or is added at the end.
void breakElement(TestFile& file, Breakage const& breakage, size_t index) {
    const std::string path = std::string(breakage.kind.array) + "/" + std::to_string(index) + breakage.path;
    Json change{ { "path", path }, { "op", breakage.value ? "add" : "remove" } };
    if (breakage.value && *breakage.path == '\0') change["op"] = "replace";
    if (breakage.value) change["value"] = Json::parse(breakage.value);
    const Json::json_pointer at(path);
    if (!breakage.value && !file.root.contains(at)) return; // it is missing already
    file.root = file.root.patch(Json::array({ change }));
}

Result<ModelData> loadKept(TestFile const& file) { return file.load({ .deformation = GltfDeformation::Kept }); }

void expectSameModel(ModelData const& a, ModelData const& b) {
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (size_t m = 0; m < a.meshes.size(); ++m) {
        ASSERT_EQ(a.meshes[m].primitives.size(), b.meshes[m].primitives.size());
        for (size_t p = 0; p < a.meshes[m].primitives.size(); ++p) {
            EXPECT_EQ(a.meshes[m].primitives[p].vertices, b.meshes[m].primitives[p].vertices);
            EXPECT_EQ(a.meshes[m].primitives[p].indices, b.meshes[m].primitives[p].indices);
            EXPECT_EQ(a.meshes[m].primitives[p].material, b.meshes[m].primitives[p].material);
        }
    }
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (size_t i = 0; i < a.nodes.size(); ++i) {
        EXPECT_EQ(a.nodes[i].worldFromNode, b.nodes[i].worldFromNode);
        EXPECT_EQ(a.nodes[i].mesh, b.nodes[i].mesh);
        EXPECT_EQ(a.nodes[i].light, b.nodes[i].light);
        EXPECT_EQ(a.nodes[i].camera, b.nodes[i].camera);
    }
    ASSERT_EQ(a.images.size(), b.images.size());
    for (size_t i = 0; i < a.images.size(); ++i) EXPECT_EQ(a.images[i].data, b.images[i].data);
    EXPECT_EQ(a.materials.size(), b.materials.size());
    EXPECT_EQ(a.skins.size(), b.skins.size());
    EXPECT_EQ(a.imageBasedLight.has_value(), b.imageBasedLight.has_value());
    ASSERT_FALSE(a.animations.empty());
    EXPECT_EQ(a.animations[0].samplers[0].values, b.animations[0].samplers[0].values);
    EXPECT_EQ(a.animations[0].channels.size(), b.animations[0].channels.size());
}

class GltfUseOf : public ::testing::TestWithParam<Breakage> {};

TEST_P(GltfUseOf, DecidesWhetherAFaultIsAnError) {
    Breakage const& breakage = GetParam();
    const TestFile whole = usedFile();
    const Result<ModelData> without = loadKept(whole);
    ASSERT_TRUE(without) << without.error().message;

    TestFile unused = whole;
    Json& array = unused.root.at(Json::json_pointer(breakage.kind.array));
    const size_t last = array.size();
    array.push_back(Json::parse(breakage.kind.unused));
    if (&breakage.kind == &kNodeKind && std::string_view(breakage.value) == "[ 1 ]")
        unused.root["nodes"][0]["children"] = { 1 }, unused.root["scenes"][0]["nodes"] = { 0 };
    ASSERT_TRUE(loadKept(unused)) << loadKept(unused).error().message;
    TestFile used = unused; // of kinds that have no other one, the same element, made used
    breakElement(unused, breakage, last);
    const Result<ModelData> model = loadKept(unused);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_THAT(model->warnings, ElementsAre(AllOf(HasSubstr(breakage.text), HasSubstr("nothing that is drawn"))));
    expectSameModel(*model, *without);

    const bool hasUsed = std::string_view(breakage.kind.use) == "[]";
    breakElement(used, breakage, hasUsed ? 0 : last);
    applyPatch(used, breakage.kind.use);
    if (&breakage.kind == &kNodeKind && std::string_view(breakage.value) == "[ 1 ]")
        used.root["nodes"][0].erase("children"), used.root["nodes"][last]["children"] = { 1 },
                                                 used.root["nodes"][0]["children"] = { 1 },
                                                 used.root["scenes"][0]["nodes"] = { 0, last };
    const Result<ModelData> refused = loadKept(used);
    ASSERT_FALSE(refused) << "was loaded";
    EXPECT_THAT(refused.error().message, HasSubstr(breakage.text));
}

std::string nameOfBreakage(::testing::TestParamInfo<Breakage> const& each) {
    std::string name = std::string(each.param.kind.array) + each.param.path + "_" + std::to_string(each.index);
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return name.substr(1);
}

INSTANTIATE_TEST_SUITE_P(Breakages, GltfUseOf, ::testing::ValuesIn(kBreakages), nameOfBreakage);

TEST(GltfUse, UnknownKindsOfLightsAreLeftOut) {
    for (const char* type : { "\"area\"", "\"\"" }) {
        TestFile file = usedFile();
        file.root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = Json::parse(type);
        const Result<ModelData> model = loadKept(file);
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("is none of directional, point and spot")));
        for (NodeData const& node : model->nodes) EXPECT_EQ(node.light, kNone);
    }
}

TEST(GltfUse, ArraysThatAreNoneCountAsEmpty) {
    for (const char* array : { "animations", "cameras", "images", "extensions" }) {
        TestFile file = TestFile::triangle();
        file.root[array] = 5;
        EXPECT_THAT(loaded(file).warnings, ElementsAre(AllOf(HasSubstr(array), HasSubstr("it counts as empty"))));
    }
    TestFile file = TestFile::triangle();
    file.root["meshes"] = 5;
    EXPECT_THAT(file.load().error().message, HasSubstr("nodes[0].mesh: index 0 is out of range"));
}

TEST(GltfUse, NamesThatAreNoTextsAreIgnored) {
    TestFile file = usedFile();
    for (const char* array : { "meshes", "nodes", "skins", "materials", "cameras", "animations" }) {
        file.root[array][0]["name"] = 7;
    }
    const Result<ModelData> model = loadKept(file);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->warnings.size(), 6u);
    EXPECT_THAT(model->warnings[0], HasSubstr("meshes[0].name: must be a string, found number; it is ignored"));
}

TEST(GltfUse, LinksOfNodesThatAreNotDrawnGiveWay) {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(
            R"([ { "children": [ 2 ] }, { "children": [ 2, 3 ] }, { "mesh": 0 }, {}, { "children": [ 4 ] },
                 { "children": [ 6 ] }, { "children": [ 5 ] } ])");
    const ModelData model = loaded(file);
    EXPECT_EQ(model.nodes.size(), 2u);
    EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("nodes[1].children: nodes[2] has another parent already"),
                                            HasSubstr("nodes[4].children: nodes[4] has another parent already"),
                                            HasSubstr("the children links form a cycle")));
}

TEST(GltfUse, NodesAboveJointsAreUsed) {
    TestFile file = usedFile();
    file.root["scenes"][0]["nodes"] = { 0 };
    file.root["nodes"][2] = Json::parse(R"({ "children": [ 1 ], "translation": [ 0, 0 ] })");
    EXPECT_THAT(loadKept(file).error().message, HasSubstr("nodes[2].translation"));
}

TEST(GltfUse, ChannelsThatMoveNothingDrawnMayHaveBrokenData) {
    TestFile file = usedFile();
    file.root["accessors"].push_back({ { "componentType", 5126 }, { "type", "SCALAR" }, { "count", 999 } });
    file.root["accessors"].back()["bufferView"] = 0;
    Json& animation = file.root["animations"][0];
    animation["samplers"].push_back({ { "input", 5 }, { "output", 4 } });
    animation["channels"].push_back(Json::parse(R"({ "sampler": 1, "target": { "node": 2, "path": "scale" } })"));
    const Result<ModelData> model = loadKept(file);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->animations[0].channels.size(), 1u);
    EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("accessors[5]: 999 elements end at byte")));
    animation["channels"].push_back(Json::parse(R"({ "sampler": 1, "target": { "node": 1, "path": "scale" } })"));
    EXPECT_THAT(loadKept(file).error().message, HasSubstr("accessors[5]: 999 elements end at byte"));
}

TEST(GltfUse, FilesWithAnUnusedBrokenPartAreDrawn) {
    SKIP_WITHOUT_FAULT_FILES();
    for (const char* name : { "unused_broken_image.gltf", "unused_broken_buffer.glb" }) {
        jobs::JobSystem jobs({ .workers = 0 });
        const Result<ModelData> model = loadGltf(faultFile(name), jobs);
        ASSERT_TRUE(model) << model.error().message;
        ASSERT_EQ(model->meshes.size(), 1u);
        EXPECT_GT(model->meshes[0].primitives.size(), 0u);
        EXPECT_FALSE(model->warnings.empty());
    }
}

} // namespace
} // namespace filament_core::assets::test
