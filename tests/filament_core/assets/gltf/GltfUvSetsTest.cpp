// SPDX-License-Identifier: Apache-2.0
// Any set of texture coordinates serves any map: a model is generated for each set and map, and for pairs and fours of
// sets, and must have what the same model has with the sets moved to the first places.
#include "filament_core/assets/gltf/AnimatedProperty.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace filament_core::assets::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kSets = 8;

/// The coordinates of a set of the file: those of different sets are turned and scaled, so that tangents differ too.
std::vector<float> setOfCoordinates(int set) {
    const float s = 1 + static_cast<float>(set);
    return set % 2 == 0 ? std::vector<float>{ 0, 0, s, 0, 0, s, s, s } : std::vector<float>{ 0, s, 0, 0, s, s, s, 0 };
}

/// A square with eight sets; `order[n]` is the content of TEXCOORD_n.
TestFile fileWithSets(std::vector<int> const& order) {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 });
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    for (size_t n = 0; n < order.size(); ++n) {
        const std::string name = "TEXCOORD_" + std::to_string(n);
        file.attribute(name.c_str(), setOfCoordinates(order[n]), kFloat, "VEC2", 2);
    }
    file.indices({ 0, 1, 2, 2, 1, 3 });
    file.primitive()["material"] = 0;
    file.root["textures"] = { { { "source", 0 } } };
    file.root["images"] = { { { "uri",
                                "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8B"
                                "QDwAEhQGAhKmMIQAAAABJRU5ErkJggg==" } } };
    file.root["materials"] = { Json::parse(R"({ "extensions": {
        "KHR_materials_clearcoat": { "clearcoatFactor": 1 }, "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ] },
        "KHR_materials_anisotropy": { "anisotropyStrength": 0.5 }, "KHR_materials_specular": {},
        "KHR_materials_iridescence": { "iridescenceFactor": 1 }, "KHR_materials_volume": { "thicknessFactor": 1,
            "attenuationDistance": 1, "attenuationColor": [ 0.5, 0.5, 0.5 ] },
        "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 1, 1, 1 ] },
        "KHR_materials_transmission": { "transmissionFactor": 1 },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1 } } })") };
    return file;
}

std::vector<int> inOrder() {
    std::vector<int> order(kSets);
    for (int i = 0; i < kSets; ++i) order[static_cast<size_t>(i)] = i;
    return order;
}

void addMap(TestFile& file, std::string const& path, int set) {
    file.root["materials"][0][Json::json_pointer("/" + path)] = { { "index", 0 }, { "texCoord", set } };
}

/// The coordinates of a map at the corners of the triangles.
std::vector<float2> coordinatesOf(ModelData const& model, MapName map) {
    MaterialData material = model.materials[0];
    const uint32_t place = mapOf(material, map).uvSet;
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    std::vector<float2> coordinates;
    for (const uint32_t index : indicesOf(primitive)) {
        const auto location = static_cast<uint8_t>(shader::kAttributeUv0 + place);
        const float4 both = vertexValue(primitive, place < 2 ? location : shader::kAttributeCustom0, index);
        coordinates.push_back(place == 3 ? float2(both.z, both.w) : float2(both));
    }
    return coordinates;
}

std::vector<float2> cornersOfSet(int set) {
    const std::vector<float> values = setOfCoordinates(set);
    std::vector<float2> corners;
    for (const size_t i : { 0u, 1u, 2u, 2u, 1u, 3u }) corners.emplace_back(values[2 * i], values[2 * i + 1]);
    return corners;
}

std::vector<float4> framesAtCorners(ModelData const& model) {
    PrimitiveData const& primitive = model.meshes[0].primitives[0];
    std::vector<float4> frames;
    for (const uint32_t index : indicesOf(primitive))
        frames.push_back(vertexValue(primitive, shader::kAttributeTangents, index));
    return frames;
}

TEST(GltfUvSets, AnySetServesAnyMap) {
    for (TexturePath const& path : texturePaths()) {
        for (int set = 0; set < kSets; ++set) {
            TestFile file = fileWithSets(inOrder());
            addMap(file, path.path, set);
            const ModelData model = loaded(file);
            EXPECT_EQ(coordinatesOf(model, path.map), cornersOfSet(set)) << path.path << " " << set;
            EXPECT_THAT(model.warnings, IsEmpty()) << path.path << " " << set;
            if (set == 1) continue; // it has a place of its own

            std::vector<int> swapped = inOrder();
            std::swap(swapped[0], swapped[static_cast<size_t>(set)]);
            TestFile other = fileWithSets(swapped);
            addMap(other, path.path, 0);
            const ModelData expected = loaded(other);
            EXPECT_EQ(model.meshes[0].primitives[0].vertices, expected.meshes[0].primitives[0].vertices)
                    << path.path << " " << set;
            EXPECT_EQ(model.meshes[0].primitives[0].indices, expected.meshes[0].primitives[0].indices);
        }
    }
}

TEST(GltfUvSets, AnyPairOfSetsServesAPairOfMaps) {
    for (int first = 0; first < kSets; ++first) {
        for (int second = 0; second < kSets; ++second) {
            if (first == second) continue;
            TestFile file = fileWithSets(inOrder());
            addMap(file, "pbrMetallicRoughness/baseColorTexture", first);
            addMap(file, "normalTexture", second);
            const ModelData model = loaded(file);
            EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(first)) << first << " " << second;
            EXPECT_EQ(coordinatesOf(model, MapName::Normal), cornersOfSet(second)) << first << " " << second;
            EXPECT_THAT(model.warnings, IsEmpty());

            TestFile other = fileWithSets({ first, second });
            addMap(other, "pbrMetallicRoughness/baseColorTexture", 0);
            addMap(other, "normalTexture", 1);
            EXPECT_EQ(framesAtCorners(model), framesAtCorners(loaded(other))) << first << " " << second;
        }
    }
}

/// Base colour and emission have one of the first two sets, the other maps any of the four.
int placeOf(MapName map, size_t index) {
    if (map == MapName::BaseColor) return 0;
    return map == MapName::Emissive ? 1 : static_cast<int>(index % 4);
}

TEST(GltfUvSets, FourSetsServeAllMapsOfAMaterial) {
    for (int first = 0; first < kSets; ++first) {
        for (const int step : { 1, 3, 5, 7 }) {
            std::vector<int> sets;
            for (int i = 0; i < 4; ++i) sets.push_back((first + i * step) % kSets);
            TestFile file = fileWithSets(inOrder()), other = fileWithSets(sets);
            for (size_t i = 0; i < texturePaths().size(); ++i) {
                TexturePath const& path = texturePaths()[i];
                const int place = placeOf(path.map, i);
                addMap(file, path.path, sets[static_cast<size_t>(place)]);
                addMap(other, path.path, place);
            }
            const ModelData model = loaded(file), expected = loaded(other);
            EXPECT_THAT(model.warnings, IsEmpty());
            for (size_t i = 0; i < texturePaths().size(); ++i) {
                const MapName map = texturePaths()[i].map;
                EXPECT_EQ(coordinatesOf(model, map), cornersOfSet(sets[static_cast<size_t>(placeOf(map, i))]))
                        << texturePaths()[i].path << " " << first << " " << step;
            }
            EXPECT_EQ(framesAtCorners(model), framesAtCorners(expected)) << first << " " << step;
            EXPECT_EQ(model.meshes[0].primitives[0].vertices.size(), expected.meshes[0].primitives[0].vertices.size());
        }
    }
}

TEST(GltfUvSets, SetsThatNoMapUsesAreNotKept) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 3);
    EXPECT_EQ(formatOf(onlyPrimitive(file), shader::kAttributeCustom0), backend::VertexFormat::None);
}

TEST(GltfUvSets, TheTransformOfATextureNamesItsSetToo) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "emissiveTexture", 1);
    file.root["materials"][0]["emissiveTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 6;
    EXPECT_EQ(coordinatesOf(loaded(file), MapName::Emissive), cornersOfSet(6));
}

TEST(GltfUvSets, MapsOfAFifthSetAreNamed) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 4);
    addMap(file, "occlusionTexture", 2);
    addMap(file, "emissiveTexture", 5);
    addMap(file, "normalTexture", 7);
    addMap(file, "extensions/KHR_materials_volume/thicknessTexture", 3);
    const ModelData model = loaded(file);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(4));
    EXPECT_EQ(coordinatesOf(model, MapName::Emissive), cornersOfSet(5));
    EXPECT_EQ(coordinatesOf(model, MapName::Normal), cornersOfSet(7));
    EXPECT_EQ(coordinatesOf(model, MapName::Occlusion), cornersOfSet(2));
    EXPECT_EQ(coordinatesOf(model, MapName::Thickness), cornersOfSet(4)) << "the first of the four";
    EXPECT_THAT(model.warnings, ElementsAre(AllOf(HasSubstr("thicknessTexture"), HasSubstr("TEXCOORD_3"))));
}

TEST(GltfUvSets, ColorsOfOnePrimitiveHaveTwoSets) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 5);
    addMap(file, "normalTexture", 4);
    file.root["extensions"]["KHR_materials_variants"]["variants"] = { { { "name", "a" } }, { { "name", "b" } } };
    Json& mappings = file.primitive()["extensions"]["KHR_materials_variants"]["mappings"];
    for (const int set : { 6, 7 }) {
        const Json info{ { "index", 0 }, { "texCoord", set } };
        file.root["materials"].push_back({ { "pbrMetallicRoughness", { { "baseColorTexture", info } } } });
        mappings.push_back({ { "material", set - 5 }, { "variants", { set - 6 } } });
    }
    ModelData model = loaded(file);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(5));
    EXPECT_EQ(coordinatesOf(model, MapName::Normal), cornersOfSet(4));
    std::swap(model.materials[0], model.materials[1]);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(6));
    EXPECT_THAT(model.warnings,
                ElementsAre(AllOf(HasSubstr("materials[2]/pbrMetallicRoughness"), HasSubstr("TEXCOORD_7"))));
}

TEST(GltfUvSets, MapsThatAreNotDrawnTakeNoPlace) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "normalTexture", 2);
    addMap(file, "occlusionTexture", 3);
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 7);
    file.root["materials"][0]["extensions"] = { { "KHR_materials_unlit", Json::object() } };
    const ModelData model = loaded(file);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(7));
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(GltfUvSets, MaterialsOfOnePrimitiveAgree) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 5);
    file.root["materials"].push_back({ { "emissiveTexture", { { "index", 0 }, { "texCoord", 3 } } } });
    file.root["extensions"]["KHR_materials_variants"]["variants"] = { { { "name", "a" } } };
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = { { { "material", 1 },
                                                                               { "variants", { 0 } } } };
    ModelData model = loaded(file);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(5));
    std::swap(model.materials[0], model.materials[1]);
    EXPECT_EQ(coordinatesOf(model, MapName::Emissive), cornersOfSet(3));
}

TEST(GltfUvSets, ASetThatAPrimitiveLacksIsItsFirst) {
    TestFile file = fileWithSets({ 0, 1 });
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 4);
    EXPECT_EQ(coordinatesOf(loaded(file), MapName::BaseColor), cornersOfSet(0));
}

TEST(GltfUvSets, UnusedSetsMayBeBroken) {
    TestFile file = fileWithSets(inOrder());
    addMap(file, "pbrMetallicRoughness/baseColorTexture", 3);
    file.primitive()["attributes"]["TEXCOORD_6"] = 99;
    const ModelData model = loaded(file);
    EXPECT_EQ(coordinatesOf(model, MapName::BaseColor), cornersOfSet(3));
    EXPECT_THAT(model.warnings, ElementsAre(AllOf(HasSubstr("TEXCOORD_6: index 99"), HasSubstr("is left out"))));
}

} // namespace
} // namespace filament_core::assets::test
