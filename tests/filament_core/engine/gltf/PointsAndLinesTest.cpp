// SPDX-License-Identifier: Apache-2.0
// Points and lines of glTF files (section 3.9.7): what they look like with and without normals and tangents, and that
// every kind of primitive can be drawn with every kind of material.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Gltf.h>

#include <memory>

namespace filament_core {
namespace {

using assets::test::Json;
using assets::test::kFloat;
using assets::test::kUByte;
using assets::test::TestFile;
using test::MaterialStage;

constexpr uint32_t kPixelsASide = 16;

/// 4 x 4 texels of several colours.
constexpr const char* kLineTexels =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAYAAACp8Z5+AAAAP0lEQVR42iWKIRaAMBTD/sF6kn8a5CRyEomcRE72"
        "VqE8REWSFjpon9kFWlR7gCetO/Kh+KpSvSJ2HpqBvyLzAu/9LYz/yFTBAAAAAElFTkSuQmCC";

std::vector<float> repeated(std::initializer_list<float> value, size_t count) {
    std::vector<float> values;
    for (size_t i = 0; i < count; ++i) values.insert(values.end(), value);
    return values;
}

/// A horizontal line through the centres of a row of pixels, which lies in the plane z = 0 and fills the image.
TestFile lineFile(const char* material) {
    TestFile file;
    file.positions({ -1, 1.0f / kPixelsASide, 0, 1, 1.0f / kPixelsASide, 0 });
    file.primitive()["mode"] = 1;
    file.primitive()["material"] = 0;
    file.root["materials"] = { Json::parse(material) };
    file.root["images"] = { { { "uri", kLineTexels } } };
    file.root["textures"] = { { { "source", 0 } } };
    return file;
}

void useNormals(TestFile& file, std::initializer_list<float> normal = { 0, 0, 1 }) {
    file.normals(repeated(normal, 2));
}
void useTangents(TestFile& file) { file.attribute("TANGENT", repeated({ 1, 0, 0, 1 }, 2), kFloat, "VEC4", 4); }
void useCoordinates(TestFile& file) { file.attribute("TEXCOORD_0", repeated({ 0.3f, 0.3f }, 2), kFloat, "VEC2", 2); }

/// In the middle of the line, under a sun from the camera, in front of black.
float4 colorOf(TestFile const& file) {
    const Image picture = test::onBothApis([&](MaterialStage& stage) {
        Result<Model> model = loadGltf(stage.engine, GltfMemory{ .file = file.glb(), .name = "line.glb" });
        ASSERT_TRUE(model) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept);
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 3 } });
        stage.view.camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        stage.view.size = { kPixelsASide, kPixelsASide };
    });
    return test::halfPixel(picture, kPixelsASide / 2, kPixelsASide / 2 - 1);
}

constexpr const char* kBright = R"({ "pbrMetallicRoughness": { "baseColorFactor": [ 0.25, 0.5, 0, 0.5 ],
    "metallicFactor": 0 }, "emissiveFactor": [ 0.125, 0, 0.25 ],
    "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 2 } } })";

TEST(PointsAndLines, WithoutNormalsShowTheSumOfBaseColorAndEmission) {
    TestFile file = lineFile(kBright);
    EXPECT_EQ(colorOf(file), float4(0.5, 0.5, 0.5, 1));
    file.primitive()["mode"] = 3;
    EXPECT_EQ(colorOf(file), float4(0.5, 0.5, 0.5, 1)) << "a strip";
    file.attribute("COLOR_0", repeated({ 0.5f, 0.5f, 1, 1 }, 2), kFloat, "VEC4", 4);
    EXPECT_EQ(colorOf(file), float4(0.375, 0.25, 0.5, 1)) << "emission is not tinted";
    file.root["materials"][0]["extensions"]["KHR_materials_unlit"] = Json::object();
    EXPECT_EQ(colorOf(file), float4(0.125, 0.25, 0, 1)) << "KHR_materials_unlit has no emission";
}

TEST(PointsAndLines, WithoutNormalsBlendTheSumByAlpha) {
    TestFile file = lineFile(kBright);
    file.root["materials"][0]["alphaMode"] = "BLEND";
    EXPECT_EQ(float3(colorOf(file)), float3(0.25));
    file.root["materials"][0]["alphaMode"] = "MASK";
    EXPECT_EQ(float3(colorOf(file)), float3(0.5)) << "0.5 is not below the threshold";
    file.root["materials"][0]["alphaCutoff"] = 0.75;
    EXPECT_EQ(float3(colorOf(file)), float3(0)) << "masked away";
}

TEST(PointsAndLines, WithoutNormalsHaveTheirMaps) {
    TestFile file = lineFile(R"({ "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 0, 1 ] },
        "emissiveFactor": [ 1, 0, 1 ], "emissiveTexture": { "index": 0 } })");
    useCoordinates(file);
    const float4 emission = colorOf(file);
    EXPECT_GT(emission.x, 0);
    EXPECT_EQ(emission.y, 0);
    EXPECT_LT(emission.x + emission.z, 2) << "the map counts";
    file.root["materials"][0] = Json::parse(R"({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })");
    EXPECT_EQ(colorOf(file).x, emission.x) << "the same texel, as a base colour";
}

TEST(PointsAndLines, WithNormalsAreLitByThem) {
    constexpr const char* kMatteLine = R"({ "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1 } })";
    TestFile front = lineFile(kMatteLine), slanted = lineFile(kMatteLine), away = lineFile(kMatteLine);
    useNormals(front);
    useNormals(slanted, { 0.6f, 0, 0.8f });
    useNormals(away, { -1, 0, 0 });
    const float4 lit = colorOf(front), less = colorOf(slanted);
    EXPECT_GT(lit.x, 0.5f);
    EXPECT_NEAR(less.x / lit.x, 0.8, 0.02) << "Lambert, but for a trace of specular light";
    EXPECT_EQ(float3(colorOf(away)), float3(0));
}

TEST(PointsAndLines, HaveNormalMapsOnlyWithTangents) {
    constexpr const char* kPlain = R"({ "pbrMetallicRoughness": { "metallicFactor": 0 },
        "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1 } } })";
    constexpr const char* kMapped = R"({ "pbrMetallicRoughness": { "metallicFactor": 0 },
        "normalTexture": { "index": 0 }, "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1,
            "clearcoatNormalTexture": { "index": 0 } } } })";
    TestFile plain = lineFile(kPlain), mapped = lineFile(kMapped);
    for (TestFile* file : { &plain, &mapped }) {
        useNormals(*file);
        useCoordinates(*file);
    }
    EXPECT_EQ(colorOf(mapped), colorOf(plain));
    useTangents(mapped);
    EXPECT_NE(colorOf(mapped), colorOf(plain));
}

// ---------------------------------------------------------------------------------------------- all combinations

constexpr const char* kMaterials[] = {
    R"({ "name": "plain" })",
    R"({ "name": "maps", "normalTexture": { "index": 0 }, "occlusionTexture": { "index": 0, "texCoord": 1 },
        "emissiveTexture": { "index": 0, "texCoord": 1 }, "emissiveFactor": [ 1, 1, 1 ],
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 },
            "metallicRoughnessTexture": { "index": 0, "texCoord": 1 } } })",
    R"({ "name": "unlit", "extensions": { "KHR_materials_unlit": {} },
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 1 } } })",
    R"({ "name": "masked", "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })",
    R"({ "name": "blended", "alphaMode": "BLEND", "doubleSided": true })",
    R"({ "name": "layers", "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 1,
            "clearcoatNormalTexture": { "index": 0 } }, "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ] },
        "KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyTexture": { "index": 0 } },
        "KHR_materials_iridescence": { "iridescenceFactor": 1 },
        "EXT_materials_bump": { "bumpTexture": { "index": 0 } } } })",
    R"({ "name": "specular", "extensions": { "KHR_materials_pbrSpecularGlossiness": {
        "diffuseTexture": { "index": 0 }, "specularGlossinessTexture": { "index": 0 } } } })",
    R"({ "name": "thin", "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.5,
        "transmissionTexture": { "index": 0 } } } })",
    R"({ "name": "solid", "normalTexture": { "index": 0 }, "extensions": { "KHR_materials_transmission": {
        "transmissionFactor": 0.5 }, "KHR_materials_volume": { "thicknessFactor": 0.5 } } })",
};

struct OptionalAttribute {
    const char *name, *type;
    std::vector<float> values; ///< of six vertices
};

std::vector<OptionalAttribute> const& optionalAttributes() {
    static const std::vector<OptionalAttribute> attributes{
        { "NORMAL", "VEC3", repeated({ 0, 0, 1 }, 6) },       { "TANGENT", "VEC4", repeated({ 1, 0, 0, 1 }, 6) },
        { "COLOR_0", "VEC4", repeated({ 1, 0.5, 1, 1 }, 6) }, { "TEXCOORD_0", "VEC2", repeated({ 0.25, 0.5 }, 6) },
        { "TEXCOORD_1", "VEC2", repeated({ 0.5, 0.75 }, 6) },
    };
    return attributes;
}

enum class Deformation : uint8_t { None, Morphed, Skinned };

/// A mesh whose primitives of this mode have every subset of the attributes, with one material.
TestFile filesOfAllVertices(int mode, const char* material, Deformation deformation) {
    TestFile file;
    const size_t positions =
            file.add<float>({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0 }, kFloat, "VEC3", 3);
    const size_t joints = file.add<uint8_t>(std::vector<uint8_t>(24, 0), kUByte, "VEC4", 4);
    const size_t weights = file.add(repeated({ 1, 0, 0, 0 }, 6), kFloat, "VEC4", 4);
    const size_t moved = file.add(repeated({ 0, 0.25, 0 }, 6), kFloat, "VEC3", 3);
    std::vector<size_t> accessors;
    for (OptionalAttribute const& attribute : optionalAttributes())
        accessors.push_back(file.add(attribute.values, kFloat, attribute.type, attribute.values.size() / 6));
    Json primitives = Json::array();
    for (uint32_t subset = 0; subset < 1u << accessors.size(); ++subset) {
        Json primitive{ { "mode", mode }, { "material", 0 }, { "attributes", { { "POSITION", positions } } } };
        for (size_t i = 0; i < accessors.size(); ++i)
            if (subset >> i & 1) primitive["attributes"][optionalAttributes()[i].name] = accessors[i];
        if (deformation == Deformation::Morphed) {
            primitive["targets"] = { { { "POSITION", moved } } };
            if (subset & 1) primitive["targets"][0]["NORMAL"] = moved;
            if ((subset & 3) == 3) primitive["targets"][0]["TANGENT"] = moved;
        }
        if (deformation == Deformation::Skinned) {
            primitive["attributes"]["JOINTS_0"] = joints;
            primitive["attributes"]["WEIGHTS_0"] = weights;
        }
        primitives.push_back(primitive);
    }
    file.root["meshes"][0]["primitives"] = primitives;
    if (deformation == Deformation::Morphed) file.root["meshes"][0]["weights"] = { 0.5 };
    if (deformation == Deformation::Skinned) {
        file.root["nodes"][0]["skin"] = 0;
        file.root["skins"] = { { { "joints", { 0 } } } };
    }
    file.root["materials"] = { Json::parse(material) };
    file.root["images"] = { { { "uri", kLineTexels } } };
    file.root["textures"] = { { { "source", 0 } } };
    return file;
}

class EveryPrimitive : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Modes, EveryPrimitive, testing::Range(0, 7));

TEST_P(EveryPrimitive, CanBeDrawnWithEveryMaterialAndAnyVertices) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 1, .validation = true });
    ASSERT_TRUE(engine) << engine.error().message;
    Renderer renderer(*engine);
    const View view{ .camera = Camera::lookAt({ 1, 0.5, 3 }, { 1, 0.5, 0 }), .size = { 16, 16 } };
    for (const char* material : kMaterials) {
        for (const Deformation deformation : { Deformation::None, Deformation::Morphed, Deformation::Skinned }) {
            const TestFile file = filesOfAllVertices(GetParam(), material, deformation);
            Result<Model> model =
                    loadGltf(*engine, GltfMemory{ .file = file.glb(), .name = material }, { .deformable = true });
            ASSERT_TRUE(model) << model.error().message;
            Scene scene(*engine);
            scene.add(*model);
            ASSERT_TRUE(renderer.renderToImage(scene, view));
            EXPECT_EQ(renderer.statistics().visible, 32u) << material;
        }
    }
    test::expectNoErrors(*engine);
}

} // namespace
} // namespace filament_core
