// SPDX-License-Identifier: Apache-2.0
// KHR_animation_pointer as the loader reads it: pointers (RFC 6901), types, and what a file must have for them.
#include "filament_core/assets/gltf/AnimatedProperty.h"
#include "tests/filament_core/assets/gltf/GltfFuzzBody.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

using namespace test;

/// A triangle with a material, two morph targets, a light and a camera.
TestFile stage() {
    TestFile file = TestFile::triangle();
    file.root["materials"] = Json::parse(R"([ { "pbrMetallicRoughness": {}, "normalTexture": { "index": 0 },
        "extensions": { "KHR_materials_clearcoat": {} } } ])");
    file.root["textures"] = Json::parse(R"([ { "source": 0 } ])");
    file.root["images"] =
            Json::parse(R"([ { "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJ)"
                        R"(AAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==" } ])");
    file.primitive()["material"] = 0;
    const size_t target = file.add(std::vector<float>(9, 1.0f), kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } }, { { "POSITION", target } } };
    file.root["extensions"] = Json::parse(
            R"({ "KHR_lights_punctual": { "lights": [ { "type": "spot" }, { "type": "spot", "spot": {} } ] } })");
    file.root["cameras"] = Json::parse(R"([ { "type": "perspective", "perspective": { "yfov": 1, "znear": 0.1 } } ])");
    file.root["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = true;
    file.root["extensionsRequired"] = { "KHR_animation_pointer", "KHR_node_visibility" };
    return file;
}

struct Output {
    std::vector<float> values;
    const char* type = "SCALAR";
    const char* interpolation = "LINEAR";
    bool isBytes = false;
};

void addChannel(TestFile& file, std::string const& pointer, Output const& output) {
    const size_t numbers = std::string(output.type) == "SCALAR" ? 1 : static_cast<size_t>(output.type[3] - '0');
    const size_t input = file.add(std::vector<float>{ 0, 2 }, kFloat, "SCALAR", 1);
    const size_t values = output.isBytes ? file.add(std::vector<uint8_t>(output.values.begin(), output.values.end()),
                                                    kUByte, output.type, numbers)
                                         : file.add(output.values, kFloat, output.type, numbers);
    Json& animation = file.root["animations"][0];
    animation["samplers"].push_back(
            { { "input", input }, { "output", values }, { "interpolation", output.interpolation } });
    animation["channels"].push_back(
            { { "sampler", animation["samplers"].size() - 1 },
              { "target",
                { { "path", "pointer" },
                  { "extensions", { { "KHR_animation_pointer", { { "pointer", pointer } } } } } } } });
}

ModelData keptModel(TestFile const& file) {
    Result<ModelData> model = file.load({ .deformation = GltfDeformation::Kept });
    if (!model) {
        ADD_FAILURE() << model.error().message;
        return {};
    }
    EXPECT_EQ(brokenPromise(*model), nullptr);
    return std::move(*model);
}

ModelData keptWith(std::string const& pointer, Output const& output) {
    TestFile file = stage();
    addChannel(file, pointer, output);
    return keptModel(file);
}

TEST(GltfAnimationPointer, APointerBecomesAPropertyWithItsRestValue) {
    const ModelData model = keptWith("/materials/0/pbrMetallicRoughness/baseColorFactor",
                                     { .values = { 0, 0, 0, 1, 1, 0.5f, 0, 1 }, .type = "VEC4" });
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    ASSERT_EQ(model.animatedProperties.size(), 1u);
    EXPECT_EQ(model.animatedProperties[0].name, PropertyName::BaseColorFactor);
    EXPECT_EQ(model.animatedProperties[0].rest, float4(1));
    ASSERT_EQ(model.animations[0].channels.size(), 1u);
    EXPECT_EQ(model.animations[0].channels[0].path, AnimationPath::Property);
    EXPECT_TRUE(model.materials.at(0).isAnimated);
    EXPECT_EQ(model.animations[0].durationSeconds, 2);
}

TEST(GltfAnimationPointer, AnExtensionWithoutEffectStaysBecauseItMayHaveOneLater) {
    EXPECT_FALSE(keptModel(stage()).materials.at(0).clearCoat.isUsed());
    EXPECT_TRUE(keptWith("/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", { .values = { 0, 1 } })
                        .materials.at(0)
                        .clearCoat.isUsed());
}

TEST(GltfAnimationPointer, AHiddenNodeIsThereWhereAnAnimationCanShowIt) {
    TestFile file = stage();
    file.root["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    EXPECT_TRUE(keptModel(file).meshes.empty());
    addChannel(file, "/nodes/0/extensions/KHR_node_visibility/visible",
               { .values = { 0, 1 }, .interpolation = "STEP", .isBytes = true });
    const ModelData model = keptModel(file);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    EXPECT_EQ(model.meshes.size(), 1u);
    EXPECT_FALSE(model.nodes[0].isVisible);
}

TEST(GltfAnimationPointer, PosesAndWeightsAreTheChannelsThatTheyAreWithoutTheExtension) {
    TestFile file = stage();
    file.root["nodes"][0].erase("extensions");
    addChannel(file, "/nodes/0/rotation", { .values = { 0, 0, 0, 1, 0, 1, 0, 0 }, .type = "VEC4" });
    addChannel(file, "/nodes/0/weights", { .values = { 0, 0, 1, 1 } });
    addChannel(file, "/meshes/0/weights/1", { .values = { 0, 1 } });
    const ModelData model = keptModel(file);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    std::vector<AnimationChannel> const& channels = model.animations[0].channels;
    ASSERT_EQ(channels.size(), 3u);
    EXPECT_EQ(channels[0].path, AnimationPath::Rotation);
    EXPECT_TRUE(model.animations[0].samplers[channels[0].sampler].isRotation);
    EXPECT_EQ(channels[1].path, AnimationPath::Weights);
    EXPECT_EQ(channels[1].weight, kNone);
    EXPECT_EQ(channels[2].weight, 1u);
    EXPECT_TRUE(model.animatedProperties.empty());
}

class RefusedPointer : public testing::TestWithParam<const char*> {};

TEST_P(RefusedPointer, IsOneWarningThatNamesTheChannelAndTheModelLoads) {
    const ModelData model = keptWith(GetParam(), { .values = { 0, 1 } });
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find("animations[0].channels[0]"), std::string::npos) << model.warnings[0];
    EXPECT_TRUE(model.animations[0].channels.empty());
}

INSTANTIATE_TEST_SUITE_P(
        Pointers, RefusedPointer,
        testing::Values("", "materials/0/alphaCutoff", "/materials/1/alphaCutoff", "/materials/00/alphaCutoff",
                        "/materials/-1/alphaCutoff", "/materials/0/alphaMode", "/materials/0/alphaCutoff/",
                        "/materials/0/pbrMetallicRoughness/baseColorFactor/0", "/materials/0/doubleSided",
                        "/materials/0/occlusionTexture/strength", "/materials/99999999999999999999/alphaCutoff",
                        "/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor",
                        "/materials/0/normalTexture/extensions/KHR_texture_transform/rotation", "/nodes/0/matrix",
                        "/extensions/KHR_lights_punctual/lights/0/range",
                        "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", "/cameras/0/perspective/zfar",
                        "/cameras/0/orthographic/xmag", "/meshes/0/weights/7", "/scenes/0/nodes", "/nodes/0/~2name",
                        "/nodes/0/name", "/extras/x"));

struct Mistyped {
    const char* pointer;
    Output output;
};
class MistypedValues : public testing::TestWithParam<Mistyped> {};

TEST_P(MistypedValues, AreOneWarningAndNoChannel) {
    const ModelData model = keptWith(GetParam().pointer, GetParam().output);
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_NE(model.warnings[0].find("animations[0].channels[0]"), std::string::npos) << model.warnings[0];
    EXPECT_TRUE(model.animations[0].channels.empty());
}

constexpr const char* kVisible = "/nodes/0/extensions/KHR_node_visibility/visible";
INSTANTIATE_TEST_SUITE_P(Types, MistypedValues,
                         testing::Values(Mistyped{ "/materials/0/emissiveFactor", { .values = { 0, 0, 0, 1, 1, 1 } } },
                                         Mistyped{ "/materials/0/alphaCutoff",
                                                   { .values = { 0, 0, 0, 1, 1, 1 }, .type = "VEC3" } },
                                         Mistyped{ kVisible, { .values = { 0, 1 }, .interpolation = "STEP" } },
                                         Mistyped{ kVisible, { .values = { 0, 1 }, .isBytes = true } }));

TEST(GltfAnimationPointer, ARestModelDoesNotKeepWhatNoAnimationCanChange) {
    TestFile file = stage();
    addChannel(file, "/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", { .values = { 0, 1 } });
    const ModelData model = loaded(file);
    EXPECT_TRUE(model.animatedProperties.empty());
    for (MaterialData const& material : model.materials) EXPECT_FALSE(material.clearCoat.isUsed());
}

TEST(AnimatedProperties, EveryPropertyHasOneRowAndEveryMapOneTexture) {
    for (size_t i = 0; i < propertyRows().size(); ++i)
        EXPECT_EQ(propertyRows()[i].name, static_cast<PropertyName>(i)) << propertyRows()[i].pointer;
    for (auto map = MapName::BaseColor; map <= MapName::Multiscatter;
         map = static_cast<MapName>(static_cast<int>(map) + 1)) {
        EXPECT_EQ(std::ranges::count(texturePaths(), map, &TexturePath::map), 1);
    }
}

// Curves overshoot, and files lie: what is written keeps the promises of the data.
TEST(AnimatedProperties, ValuesAreClampedToTheRangesOfTheFormat) {
    MaterialData material;
    LightData light{ .type = LightType::Spot };
    CameraData lens, box{ .isParallel = true, .nearMeters = 0, .farMeters = 10, .aspect = 1 };
    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    ModelData none;
    for (const float number : { -1e30f, -1.0f, 0.0f, 0.5f, 2.0f, 1e30f, infinity, -infinity, nan }) {
        for (PropertyRow const& row : propertyRows()) {
            const float4 value(number);
            if (row.owner == PropertyOwner::Material)
                setValue(material, row.name,
                         row.name >= PropertyName::UvOffset && row.name <= PropertyName::UvScale ? MapName::Normal
                                                                                                 : MapName::None,
                         value);
            if (row.owner == PropertyOwner::Light) setValue(light, row.name, value);
            if (row.owner != PropertyOwner::Camera) continue;
            const bool isOfBox = row.name >= PropertyName::CameraXmag;
            setValue(isOfBox ? box : lens, row.name, value);
            EXPECT_EQ(brokenPromise(none, isOfBox ? box : lens), nullptr) << row.pointer << ": " << number;
        }
        EXPECT_EQ(brokenPromise(none, material), nullptr) << number;
        EXPECT_EQ(brokenPromise(none, light), nullptr) << number;
        EXPECT_LT(light.innerConeRadians, light.outerConeRadians);
    }
}

} // namespace
} // namespace filament_core::assets
