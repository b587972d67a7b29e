// SPDX-License-Identifier: Apache-2.0
// KHR_animation_pointer: a copy at some time has the bits of a file with the values of that time, on both APIs, and
// other copies stay as they are.
// Size: a table of properties, one row each.
#include "tests/filament_core/engine/RenderFixture.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <filament_core/Animator.h>
#include <filament_core/ModelCopy.h>

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace filament_core {
namespace {

/// 4 x 4 texels of several colours.
constexpr const char* kPicture =
        "iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAYAAACp8Z5+AAAAP0lEQVR42iWKIRaAMBTD/sF6kn8a5CRyEomcRE72VqE8REWSFjpo"
        "n9kFWlR7gCetO/Kh+KpSvSJ2HpqBvyLzAu/9LYz/yFTBAAAAAElFTkSuQmCC";

/// Three squares: layers on textures, also on lines without normals, a masked one, a body of glass; two lights and two
/// cameras.
constexpr const char* kFile =
        R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1, 2, 3, 4, 5 ] } ],
    "extensionsUsed": [ "KHR_animation_pointer", "KHR_lights_punctual", "KHR_node_visibility" ],
    "extensions": { "KHR_lights_punctual": { "lights": [
        { "type": "spot", "intensity": 900, "color": [ 1, 0.5, 0.25 ], "range": 40,
          "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } }, { "type": "point", "intensity": 300 } ] } },
    "nodes": [ { "mesh": 0, "translation": [ -3, 0, 0 ] }, { "mesh": 1 }, { "mesh": 2, "translation": [ 3, 0, 0 ] },
        { "translation": [ 0, 0, 5 ], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "translation": [ -2, 1, 2 ], "children": [ 6 ], "extensions": { "KHR_lights_punctual": { "light": 1 },
          "KHR_node_visibility": { "visible": true } } },
        { "name": "stand", "camera": 0, "extensions": { "KHR_node_visibility": { "visible": false } }, "mesh": 3,
          "translation": [ 0, 0, 1 ] },
        { "mesh": 0, "translation": [ 2, 2, -2 ], "scale": [ 0.5, 0.5, 0.5 ] } ],
    "cameras": [ { "type": "perspective", "name": "lens", "perspective": { "yfov": 0.5, "znear": 0.25, "aspectRatio": 2 } },
        { "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 2, "znear": 1, "zfar": 11 } } ],
    "materials": [
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0.5, 0.25, 1, 1 ], "metallicFactor": 0.25,
            "roughnessFactor": 0.5, "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": {
                "offset": [ 0, 0.5 ], "rotation": 0.25, "scale": [ 1, 0.5 ] } } } },
          "emissiveFactor": [ 0.125, 0, 0 ],
          "normalTexture": { "index": 0, "scale": 0.5 }, "occlusionTexture": { "index": 0, "strength": 0.5 },
          "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8 },
            "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25 },
            "KHR_materials_sheen": { "sheenColorFactor": [ 0.5, 0.5, 0 ], "sheenRoughnessFactor": 0.5 },
            "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [ 1, 0.5, 1 ] },
            "KHR_materials_ior": { "ior": 1.75 },
            "KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyRotation": 0.25 },
            "EXT_materials_bump": { "bumpFactor": 0.25, "bumpTexture": { "index": 0, "extensions": {
                "KHR_texture_transform": { "offset": [ 0.125, 0 ] } } } },
            "KHR_materials_iridescence": { "iridescenceFactor": 0.5, "iridescenceIor": 1.5,
                "iridescenceThicknessMaximum": 300 } } },
        { "alphaMode": "MASK", "alphaCutoff": 0.25,
          "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorFactor": [ 0.75, 0.75, 0.5, 0.5 ] },
          "extensions": { "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.25,
            "diffuseTransmissionColorFactor": [ 0.5, 1, 0.25 ] },
            "KHR_materials_volume": { "thicknessFactor": 0.75, "attenuationDistance": 1,
                "attenuationColor": [ 0.25, 0.5, 0.5 ] },
            "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 0.375, 0.5, 0.25 ],
                "scatterAnisotropy": 0.125 } } },
        { "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.5 },
            "KHR_materials_volume": { "thicknessFactor": 0.5, "attenuationDistance": 2,
                "attenuationColor": [ 0.5, 0.75, 1 ] },
            "KHR_materials_dispersion": { "dispersion": 0 } } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 1, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "material": 0 },
          { "mode": 3, "attributes": { "POSITION": 0, "TEXCOORD_0": 2 }, "material": 0 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "material": 1 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "material": 2 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "material": 3 } ] } ],
    "textures": [ { "source": 0 } ], "images": [ { "mimeType": "image/png", "uri": "data:image/png;base64,$TEXELS" } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 6, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 144, "componentType": 5126, "count": 6, "type": "VEC2" }$ACCESSORS ],
    "bufferViews": [ { "buffer": 0, "byteLength": 192 }$VIEWS ],
    "buffers": [ { "byteLength": $BYTES } ]$ANIMATIONS })";

struct Pointed {
    const char* pointer;
    const char *inFile, *changed; ///< text of the file, and what it is with the value
    std::vector<float> value;
    bool isBoolean = false;
};

void replace(std::string& text, std::string const& what, std::string const& by) {
    const size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
}

using Bytes = std::vector<std::byte>;

template <class T>
void append(Bytes& bytes, std::vector<T> const& values) {
    const auto* first = reinterpret_cast<std::byte const*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(T));
}

/// A .glb with an animation of all channels, then one of each; their only key is at 0 seconds.
Bytes glbWith(std::vector<Pointed> const& channels, std::string text = kFile) {
    Bytes binary;
    const auto isRight = [](int corner) { return corner == 1 || corner == 3 || corner == 4; };
    const auto isTop = [](int corner) { return corner == 2 || corner == 4 || corner == 5; };
    for (int i = 0; i < 6; ++i) append<float>(binary, { isRight(i) ? 1.0f : -1.0f, isTop(i) ? 1.0f : -1.0f, 0 });
    for (int i = 0; i < 6; ++i) append<float>(binary, { 0, 0, 1 });
    for (int i = 0; i < 6; ++i) append<float>(binary, { isRight(i) ? 1.0f : 0.0f, isTop(i) ? 1.0f : 0.0f });
    std::string accessors, views, samplers, targets;
    append<float>(binary, { 0 });
    for (Pointed const& channel : channels) {
        constexpr const char* kTypes[] = { "SCALAR", "VEC2", "VEC3", "VEC4" };
        const size_t begin = binary.size(), index = static_cast<size_t>(&channel - channels.data());
        if (channel.isBoolean) append<uint8_t>(binary, { static_cast<uint8_t>(channel.value[0]), 0, 0, 0 });
        if (!channel.isBoolean) append(binary, channel.value);
        const std::string comma = index == 0 ? "" : ", ";
        views +=
                fmt::format(R"(, {{ "buffer": 0, "byteOffset": {}, "byteLength": {} }})", begin, binary.size() - begin);
        accessors += fmt::format(R"(, {{ "bufferView": {}, "componentType": {}, "count": 1, "type": "{}" }})",
                                 index + 2, channel.isBoolean ? 5121 : 5126, kTypes[channel.value.size() - 1]);
        samplers += fmt::format(R"({}{{ "input": 3, "output": {}, "interpolation": "STEP" }})", comma, index + 4);
        targets += fmt::format(R"({}{{ "sampler": {}, "target": {{ "path": "pointer", "extensions": {{
            "KHR_animation_pointer": {{ "pointer": "{}" }} }} }} }})",
                               comma, index, channel.pointer);
    }
    std::string animations = fmt::format(R"({{ "samplers": [ {} ], "channels": [ {} ] }})", samplers, targets);
    for (size_t i = 0; i < channels.size(); ++i) {
        animations += fmt::format(R"(, {{ "samplers": [ {{ "input": 3, "output": {}, "interpolation": "STEP" }} ],
            "channels": [ {{ "sampler": 0, "target": {{ "path": "pointer", "extensions": {{
                "KHR_animation_pointer": {{ "pointer": "{}" }} }} }} }} ] }})",
                                  i + 4, channels[i].pointer);
    }
    const bool isAnimated = !channels.empty();
    replace(text, "$TEXELS", kPicture);
    replace(text, "$ACCESSORS",
            isAnimated ? R"(, { "bufferView": 1, "componentType": 5126, "count": 1, "type": "SCALAR" })" + accessors
                       : "");
    replace(text, "$VIEWS", isAnimated ? R"(, { "buffer": 0, "byteOffset": 192, "byteLength": 4 })" + views : "");
    replace(text, "$BYTES", std::to_string(binary.size()));
    replace(text, "$ANIMATIONS", isAnimated ? R"(, "animations": [ )" + animations + " ]" : "");
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes glb;
    const auto word = [](size_t value) { return static_cast<uint32_t>(value); };
    append<uint32_t>(glb, { 0x46546C67, 2, word(28 + text.size() + binary.size()), word(text.size()), 0x4E4F534A });
    append<char>(glb, { text.begin(), text.end() });
    append<uint32_t>(glb, { word(binary.size()), 0x004E4942 });
    glb.insert(glb.end(), binary.begin(), binary.end());
    return glb;
}

std::string changedFile(std::vector<Pointed> const& channels) {
    std::string text = kFile;
    for (Pointed const& channel : channels) replace(text, channel.inFile, channel.changed);
    return text;
}

const std::vector<Pointed>& properties() {
    static const std::vector<Pointed> kAll{
        { "/materials/0/pbrMetallicRoughness/baseColorFactor",
          "[ 0.5, 0.25, 1, 1 ]",
          "[ 1, 0.5, 0, 1 ]",
          { 1, 0.5f, 0, 1 } },
        { "/materials/0/pbrMetallicRoughness/metallicFactor",
          "\"metallicFactor\": 0.25",
          "\"metallicFactor\": 1",
          { 1 } },
        { "/materials/0/pbrMetallicRoughness/roughnessFactor",
          "\"roughnessFactor\": 0.5",
          "\"roughnessFactor\": 0.75",
          { 0.75f } },
        { "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset",
          "[ 0, 0.5 ]",
          "[ 0.25, 1 ]",
          { 0.25f, 1 } },
        { "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation",
          "\"rotation\": 0.25",
          "\"rotation\": 1.5",
          { 1.5f } },
        { "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale",
          "\"scale\": [ 1, 0.5 ]",
          "\"scale\": [ 2, 3 ]",
          { 2, 3 } },
        { "/materials/0/emissiveFactor", "[ 0.125, 0, 0 ]", "[ 0.25, 0.5, 0 ]", { 0.25f, 0.5f, 0 } },
        { "/materials/0/normalTexture/scale", "\"scale\": 0.5", "\"scale\": 2", { 2 } },
        { "/materials/0/occlusionTexture/strength", "\"strength\": 0.5", "\"strength\": 0.25", { 0.25f } },
        { "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength",
          "\"emissiveStrength\": 8",
          "\"emissiveStrength\": 32",
          { 32 } },
        { "/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor",
          "\"clearcoatFactor\": 0.5",
          "\"clearcoatFactor\": 0.75",
          { 0.75f } },
        { "/materials/0/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor",
          "\"clearcoatRoughnessFactor\": 0.25",
          "\"clearcoatRoughnessFactor\": 0.5",
          { 0.5f } },
        { "/materials/0/extensions/KHR_materials_sheen/sheenColorFactor",
          "[ 0.5, 0.5, 0 ]",
          "[ 0, 0.5, 1 ]",
          { 0, 0.5f, 1 } },
        { "/materials/0/extensions/KHR_materials_sheen/sheenRoughnessFactor",
          "\"sheenRoughnessFactor\": 0.5",
          "\"sheenRoughnessFactor\": 1",
          { 1 } },
        { "/materials/0/extensions/KHR_materials_specular/specularFactor",
          "\"specularFactor\": 0.5",
          "\"specularFactor\": 1",
          { 1 } },
        { "/materials/0/extensions/KHR_materials_specular/specularColorFactor",
          "[ 1, 0.5, 1 ]",
          "[ 2, 0, 0.5 ]",
          { 2, 0, 0.5f } },
        { "/materials/0/extensions/KHR_materials_ior/ior", "\"ior\": 1.75", "\"ior\": 2.5", { 2.5f } },
        { "/materials/0/extensions/KHR_materials_anisotropy/anisotropyStrength",
          "\"anisotropyStrength\": 0.5",
          "\"anisotropyStrength\": 1",
          { 1 } },
        { "/materials/0/extensions/KHR_materials_anisotropy/anisotropyRotation",
          "\"anisotropyRotation\": 0.25",
          "\"anisotropyRotation\": 1.5",
          { 1.5f } },
        { "/materials/0/extensions/KHR_materials_iridescence/iridescenceFactor",
          "\"iridescenceFactor\": 0.5",
          "\"iridescenceFactor\": 1",
          { 1 } },
        { "/materials/0/extensions/KHR_materials_iridescence/iridescenceIor",
          "\"iridescenceIor\": 1.5",
          "\"iridescenceIor\": 2",
          { 2 } },
        { "/materials/0/extensions/KHR_materials_iridescence/iridescenceThicknessMaximum",
          "\"iridescenceThicknessMaximum\": 300",
          "\"iridescenceThicknessMaximum\": 500",
          { 500 } },
        { "/materials/0/extensions/EXT_materials_bump/bumpFactor", "\"bumpFactor\": 0.25", "\"bumpFactor\": 1", { 1 } },
        { "/materials/0/extensions/EXT_materials_bump/bumpTexture/extensions/KHR_texture_transform/offset",
          "[ 0.125, 0 ]",
          "[ 0.5, 0.25 ]",
          { 0.5f, 0.25f } },
        { "/materials/1/alphaCutoff", "\"alphaCutoff\": 0.25", "\"alphaCutoff\": 0.75", { 0.75f } },
        { "/materials/1/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionFactor",
          "\"diffuseTransmissionFactor\": 0.25",
          "\"diffuseTransmissionFactor\": 1",
          { 1 } },
        { "/materials/1/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorFactor",
          "[ 0.5, 1, 0.25 ]",
          "[ 1, 0, 0.5 ]",
          { 1, 0, 0.5f } },
        { "/materials/1/extensions/KHR_materials_volume_scatter/multiscatterColorFactor",
          "[ 0.375, 0.5, 0.25 ]",
          "[ 0, 1, 0.75 ]",
          { 0, 1, 0.75f } },
        { "/materials/1/extensions/KHR_materials_volume_scatter/scatterAnisotropy",
          "\"scatterAnisotropy\": 0.125",
          "\"scatterAnisotropy\": 0.75",
          { 0.75f } },
        { "/materials/2/extensions/KHR_materials_transmission/transmissionFactor",
          "\"transmissionFactor\": 0.5",
          "\"transmissionFactor\": 1",
          { 1 } },
        { "/materials/2/extensions/KHR_materials_volume/thicknessFactor",
          "\"thicknessFactor\": 0.5",
          "\"thicknessFactor\": 2",
          { 2 } },
        { "/materials/2/extensions/KHR_materials_volume/attenuationDistance",
          "\"attenuationDistance\": 2",
          "\"attenuationDistance\": 0.25",
          { 0.25f } },
        { "/materials/2/extensions/KHR_materials_volume/attenuationColor",
          "[ 0.5, 0.75, 1 ]",
          "[ 1, 0.125, 0.5 ]",
          { 1, 0.125f, 0.5f } },
        { "/materials/2/extensions/KHR_materials_dispersion/dispersion",
          "\"dispersion\": 0",
          "\"dispersion\": 8",
          { 8 } },
        { "/extensions/KHR_lights_punctual/lights/0/color",
          "[ 1, 0.5, 0.25 ]",
          "[ 0.25, 0.5, 1 ]",
          { 0.25f, 0.5f, 1 } },
        { "/extensions/KHR_lights_punctual/lights/0/intensity", "\"intensity\": 900", "\"intensity\": 3000", { 3000 } },
        { "/extensions/KHR_lights_punctual/lights/0/range", "\"range\": 40", "\"range\": 5.25", { 5.25f } },
        { "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle",
          "\"innerConeAngle\": 0.25",
          "\"innerConeAngle\": 0.125",
          { 0.125f } },
        { "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
          "\"outerConeAngle\": 0.5",
          "\"outerConeAngle\": 1",
          { 1 } },
        { "/nodes/5/extensions/KHR_node_visibility/visible", "\"visible\": false", "\"visible\": true", { 1 }, true },
        { "/nodes/4/extensions/KHR_node_visibility/visible", "\"visible\": true", "\"visible\": false", { 0 }, true },
        { "/nodes/2/translation", "\"translation\": [ 3, 0, 0 ]", "\"translation\": [ 3, 1, 0 ]", { 3, 1, 0 } },
    };
    return kAll;
}

class AnimationPointer : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
    }
    void TearDown() override {
        if (engine) test::expectNoErrors(*engine);
    }

    Model load(Bytes const& glb) {
        auto model = loadGltf(*engine, GltfMemory{ .file = glb });
        if (!model) test::expectNoErrors(*engine);
        EXPECT_TRUE(model) << model.error().message;
        EXPECT_TRUE(model->warnings().empty()) << model->warnings().front();
        return std::move(*model);
    }
    Image draw(Scene& scene) {
        // Of one colour, it would look the same through glass of any dispersion.
        const test::SkyObjects sky(*engine, { .base = float3(1), .slope = float3(0.9f, -0.4f, 0) });
        sky.shine(scene, { .exposure = { .aperture = 4, .shutterSeconds = 1 } }); // 19 lux
        const View view{ .camera = Camera::lookAt({ 1, 1, 9 }, { 0, 0.25, 0 }, { .verticalFovDegrees = 40 }),
                         .size = { 96, 40 } };
        return test::renderLinear(*engine, scene, view);
    }
    Image drawFile(std::string const& text) {
        const Model model = load(glbWith({}, text));
        Scene scene(*engine);
        scene.add(model);
        return draw(scene);
    }

    std::optional<Engine> engine;
};

TEST_P(AnimationPointer, EveryPropertyShows) {
    const Model model = load(glbWith(properties()));
    Scene scene(*engine);
    Animator animator(model, scene, scene.add(model));
    const Image rest = draw(scene);
    for (uint32_t i = 0; i < properties().size(); ++i) {
        animator.apply(i + 1, 0);
        EXPECT_GT(test::differenceOf(draw(scene), rest).pixels, 0u) << properties()[i].pointer;
        animator.rest();
    }
    EXPECT_EQ(test::differenceOf(draw(scene), rest).pixels, 0u);
}

TEST_P(AnimationPointer, ACopyHasTheBitsOfAFileWithTheValuesOfItsTime) {
    const Model model = load(glbWith(properties()));
    Scene scene(*engine);
    const Node copy = scene.add(model);
    Animator animator(model, scene, copy);
    const Image before = draw(scene);
    animator.apply(0, 0);
    EXPECT_EQ(test::differenceOf(draw(scene), drawFile(changedFile(properties()))).pixels, 0u);
    animator.rest();
    EXPECT_EQ(test::differenceOf(draw(scene), before).pixels, 0u);
}

TEST_P(AnimationPointer, OneCopyMovesAndTheOthersDoNot) {
    const Model model = load(glbWith(properties()));
    Scene alone(*engine), both(*engine);
    double4x4 away(1.0);
    away[3].x = 1000;
    alone.add(model);
    both.add(model);
    Animator(model, both, both.add(model, away)).apply(0, 0);
    EXPECT_EQ(test::differenceOf(draw(alone), draw(both)).pixels, 0u);
}

INSTANTIATE_TEST_SUITE_P(Apis, AnimationPointer, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

class AnimationPointerParts : public testing::Test {
protected:
    Result<Engine> engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
};

TEST_F(AnimationPointerParts, CamerasOfACopyAreThoseOfItsTime) {
    ASSERT_TRUE(engine.ok());
    const auto model = loadGltf(
            *engine, GltfMemory{ .file = glbWith({ { "/cameras/0/perspective/yfov", "", "", { 1 } },
                                                   { "/cameras/0/perspective/znear", "", "", { 0.5f } },
                                                   { "/cameras/0/perspective/aspectRatio", "", "", { 3 } } }) });
    ASSERT_TRUE(model) << model.error().message;
    Scene scene(*engine);
    const Node copy = scene.add(*model), other = scene.add(*model);
    Animator(*model, scene, copy).apply(0, 0);
    const auto lensOf = [&](Node root) { return ModelCopy::of(scene, root)->camera("lens")->lens; };
    EXPECT_FLOAT_EQ(lensOf(copy).verticalFovDegrees, 57.29578f);
    EXPECT_EQ(lensOf(copy).nearMeters, 0.5f);
    EXPECT_EQ(lensOf(copy).aspect, 3);
    EXPECT_EQ(lensOf(other).nearMeters, 0.25f);
}

TEST_F(AnimationPointerParts, AModelWithoutSuchChannelsHasNoMaterialsOfItsOwn) {
    ASSERT_TRUE(engine.ok());
    const auto model =
            loadGltf(*engine, GltfMemory{ .file = glbWith({ { "/nodes/2/translation", "", "", { 3, 1, 0 } } }) });
    ASSERT_TRUE(model) << model.error().message;
    Scene scene(*engine);
    const Node copy = scene.add(*model);
    Animator(*model, scene, copy).apply(0, 0);
    for (CopyMaterial const& material : ModelCopy::of(scene, copy)->materials()) EXPECT_FALSE(material.isOwn);
}

} // namespace
} // namespace filament_core
