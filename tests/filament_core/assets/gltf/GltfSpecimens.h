// SPDX-License-Identifier: Apache-2.0
/// GltfSpecimens: whole glTF files of every kind, and what damages them, for tests that load damaged ones.
#pragma once

#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/assets/blocks/BasisWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/assets/gltf/ImageBasedLightFile.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"
#include "toolkit/paths/Paths.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::assets::test {

/// The two parts of a .glb, so that mutating one leaves the container valid.
struct Specimen {
    std::string json;
    Bytes binary;
};

inline Specimen specimenFrom(Json const& root, Bytes binary) { return { root.dump(), std::move(binary) }; }

inline constexpr const char* kSpecimenExtensions = R"({
    "EXT_materials_bump": { "bumpFactor": 0.5, "bumpTexture": { "index": 1, "texCoord": 1 } },
    "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatTexture": { "index": 0 },
        "clearcoatRoughnessTexture": { "index": 1 }, "clearcoatNormalTexture": { "index": 0 } },
    "KHR_materials_sheen": { "sheenColorFactor": [ 1, 1, 1 ], "sheenColorTexture": { "index": 0 },
        "sheenRoughnessTexture": { "index": 1, "texCoord": 1 } },
    "KHR_materials_specular": { "specularFactor": 0.5, "specularColorFactor": [ 2, 2, 2 ] },
    "KHR_materials_anisotropy": { "anisotropyStrength": 0.5, "anisotropyRotation": 1 },
    "KHR_materials_iridescence": { "iridescenceFactor": 1, "iridescenceThicknessTexture": { "index": 0 } },
    "KHR_materials_ior": { "ior": 1.4 }, "KHR_materials_transmission": { "transmissionFactor": 1 },
    "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [ 0.5, 0.5, 0.5 ] },
    "KHR_materials_dispersion": { "dispersion": 1 },
    "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 1 },
    "KHR_materials_volume_scatter": { "multiscatterColorFactor": [ 0.5, 0.25, 1 ], "scatterAnisotropy": 0.5,
        "multiscatterColorTexture": { "index": 1 } } })";
inline constexpr const char* kSpecimenLight =
        R"({ "type": "spot", "spot": {}, "extensions": { "FILAMENT_light": {
    "version": 1, "color": [ 2, 1, 0.5 ], "intensity": 7, "castsShadows": false, "contactShadows": true,
    "lightChannels": 3, "sourceRadius": 0.5, "area": { "shape": "rect", "width": 2, "height": 3, "luminance": 9,
    "twoSided": true, "visible": true }, "image": { "aspect": 1, "words": "data:application/octet-stream;base64,)"
        "AQAAAAEAAAAAAAAAAAAAAAUAAABCCCGEQgghhEIIIYRCCCGEQgghhEIIIYRCCCGEQgghhEIIIYQ="
        R"(" } } } })";
inline constexpr const char* kSpecimenLuminaire = R"({ "type": "spot", "spot": {}, "extensions": { "FILAMENT_light": {
    "version": 1, "profile": { "peak": 100, "lumens": 300, "words": "data:application/octet-stream;base64,)"
                                                  "AgAAAAEAAAA4+CI///8AgA=="
                                                  R"(" } } } })";
inline constexpr const char* kSpecimenSun = R"({ "type": "directional", "extensions": { "FILAMENT_light": {
    "version": 1, "angularRadius": 2, "showsDisc": true, "haloSize": 20, "haloFalloff": 90 } } })";
inline constexpr const char* kSpecimenGlossiness = R"({ "KHR_materials_pbrSpecularGlossiness": {
    "diffuseFactor": [ 1, 0, 1, 0.5 ], "glossinessFactor": 0.5, "specularGlossinessTexture": { "index": 0 } } })";

/// Textures of both kinds, layers and variants, lights, morph targets, a skin, sparse data, strips: a bit of
/// everything.
inline Specimen writtenSpecimen() {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("_FILAMENT_TANGENTS", std::vector<int16_t>{ 0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, -32767 },
                   kShort, "VEC4", 4, true);
    file.attribute("TEXCOORD_0", std::vector<uint16_t>{ 0, 0, 65535, 0, 0, 65535 }, kUShort, "VEC2", 2, true);
    file.attribute("COLOR_0", std::vector<float>(9, 0.5f), kFloat, "VEC3", 3);
    file.attribute("JOINTS_0", std::vector<uint8_t>(12, 0), kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>(12, 0.25f), kFloat, "VEC4", 4);
    file.indices({ 0, 1, 2, 2, 1 });
    file.primitive()["mode"] = 5;
    const size_t target = file.add(std::vector<float>(9, 1.0f), kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target }, { "NORMAL", target } } };
    file.root["meshes"][0]["weights"] = { 0.5 };
    const std::array<uint16_t, 2> where{ 0, 2 };
    const std::array<float, 6> what{ 1, 2, 3, 4, 5, 6 };
    file.root["accessors"][0]["sparse"] = {
        { "count", 2 },
        { "indices", { { "bufferView", file.addView(std::as_bytes(std::span(where))) }, { "componentType", 5123 } } },
        { "values", { { "bufferView", file.addView(std::as_bytes(std::span(what))) } } }
    };
    const std::vector<std::byte> pixels(5 * 3 * 4, std::byte{ 77 });
    file.root["images"] = { { { "bufferView", file.addView(glbImageFromPixels("i", 5, 3, pixels)->file) } } };
    file.root["samplers"] = { { { "minFilter", 9984 } } };
    const std::vector<std::byte> others(2 * 4, std::byte{ 99 });
    file.root["images"].push_back({ { "bufferView", file.addView(glbImageFromPixels("j", 2, 1, others)->file) } });
    file.root["textures"] = { { { "source", 0 }, { "sampler", 0 } }, { { "source", 1 }, { "sampler", 0 } } };
    file.root["materials"] = Json::parse(R"([ { "normalTexture": { "index": 0, "scale": 0.5 },
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": {
        "offset": [ 0.5, 0 ], "rotation": 1, "scale": [ 2, 2 ] } } } } } ])");
    file.root["materials"].push_back({ { "extensions", Json::parse(kSpecimenExtensions) } });
    file.root["materials"].push_back({ { "extensions", Json::parse(kSpecimenGlossiness) } });
    file.root["extensions"]["KHR_materials_variants"]["variants"] =
            Json::parse(R"([ { "name": "a" }, { "name": "b" } ])");
    file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] =
            Json::parse(R"([ { "material": 1, "variants": [ 0 ] }, { "material": 2, "variants": [ 1 ] } ])");
    file.primitive()["material"] = 0;
    file.root["skins"] = Json::parse(R"([ { "joints": [ 1 ] } ])");
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "skin": 0, "children": [ 1 ] }, { "scale": [ 1, 2, 3 ],
        "extensions": { "KHR_lights_punctual": { "light": 0 },
        "EXT_lights_ies": { "light": 0, "multiplier": 2, "color": [ 1, 0.5, 0.25 ] } } } ])");
    const std::string_view luminaire = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 3 2 1 2 0 0 0\n1 1 9\n"
                                       "0 45 90\n0 90\n100 70 5\n100 80 9\n";
    file.root["extensions"]["EXT_lights_ies"]["lights"] = { { { "bufferView",
                                                                file.addView(std::as_bytes(std::span(luminaire))) },
                                                              { "mimeType", "application/x-ies-lm-63" } } };
    file.root["extensions"]["KHR_lights_punctual"]["lights"] =
            Json::array({ Json::parse(kSpecimenLight), Json::parse(kSpecimenSun), Json::parse(kSpecimenLuminaire) });
    for (int light = 1; light <= 2; ++light) {
        file.root["nodes"].push_back({ { "extensions", { { "KHR_lights_punctual", { { "light", light } } } } } });
        file.root["nodes"][0]["children"].push_back(light + 1);
    }
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// KHR_animation_pointer: properties of every owner, poses and weights; with levels of detail of which one is listed
/// twice.
inline Specimen pointerSpecimen() {
    TestFile file = TestFile::triangle();
    const size_t target = file.add(std::vector<float>(9, 1.0f), kFloat, "VEC3", 3);
    file.primitive()["targets"] = { { { "POSITION", target } } };
    file.primitive()["material"] = 0;
    file.root["materials"] = { { { "pbrMetallicRoughness", Json::object() },
                                 { "extensions", Json::parse(kSpecimenExtensions) } } };
    file.root["materials"][0]["extensions"].erase("KHR_materials_clearcoat");
    file.root["materials"][0]["extensions"].erase("KHR_materials_sheen");
    file.root["materials"][0]["extensions"]["KHR_materials_iridescence"].erase("iridescenceThicknessTexture");
    file.root["materials"][0]["extensions"]["EXT_materials_bump"].erase("bumpTexture");
    file.root["materials"][0]["extensions"]["KHR_materials_volume_scatter"].erase("multiscatterColorTexture");
    file.root["nodes"][0]["camera"] = 0;
    file.root["nodes"][0]["extensions"] =
            Json::parse(R"({ "KHR_node_visibility": { "visible": false }, "KHR_lights_punctual": { "light": 0 },
                "MSFT_lod": { "ids": [ 1, 2 ] } })");
    file.root["nodes"].push_back(Json::parse(R"({ "mesh": 0, "extensions": { "MSFT_lod": { "ids": [ 2 ] } } })"));
    file.root["nodes"].push_back(Json::parse(R"({ "mesh": 0 })"));
    file.root["scenes"][0]["nodes"] = Json::array({ 0, 1, 2 });
    file.root["cameras"] = Json::parse(R"([ { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1,
        "znear": 0, "zfar": 2 } } ])");
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({ Json::parse(kSpecimenLight) });
    Json& animation = file.root["animations"][0];
    const size_t times = file.add(std::vector<float>{ 0, 1 }, kFloat, "SCALAR", 1);
    const std::array outputs{ file.add(std::vector<float>{ -9, 9 }, kFloat, "SCALAR", 1),
                              file.add(std::vector<uint8_t>{ 0, 1 }, kUByte, "SCALAR", 1),
                              file.add(std::vector<float>(6, 0.5f), kFloat, "VEC3", 3) };
    for (const size_t output : outputs)
        animation["samplers"].push_back({ { "input", times }, { "output", output }, { "interpolation", "STEP" } });
    const std::pair<const char*, int> channels[] = {
        { "/nodes/0/extensions/KHR_node_visibility/visible", 1 },
        { "/materials/0/pbrMetallicRoughness/roughnessFactor", 0 },
        { "/materials/0/extensions/KHR_materials_volume/attenuationColor", 2 },
        { "/materials/0/extensions/KHR_materials_volume_scatter/multiscatterColorFactor", 2 },
        { "/materials/0/extensions/KHR_materials_volume_scatter/scatterAnisotropy", 0 },
        { "/materials/0/extensions/KHR_materials_ior/ior", 0 },
        { "/materials/0/extensions/EXT_materials_bump/bumpFactor", 0 },
        { "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 0 },
        { "/extensions/KHR_lights_punctual/lights/0/intensity", 0 },
        { "/cameras/0/orthographic/ymag", 0 },
        { "/cameras/0/orthographic/zfar", 0 },
        { "/nodes/0/translation", 2 },
        { "/meshes/0/weights/0", 0 },
    };
    for (auto const& [pointer, sampler] : channels)
        animation["channels"].push_back(
                { { "sampler", sampler },
                  { "target",
                    { { "path", "pointer" },
                      { "extensions", { { "KHR_animation_pointer", { { "pointer", pointer } } } } } } } });
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// A model of the asset folder with its buffer embedded, so that its bytes can be damaged, too.
inline Specimen assetSpecimen(std::filesystem::path const& path) {
    const Bytes file = *readGltfFile(path);
    if (path.extension() == ".glb") {
        uint32_t length = 0;
        std::memcpy(&length, &file[12], 4);
        auto const* text = reinterpret_cast<const char*>(file.data() + 20);
        return { std::string(text, length), Bytes(file.begin() + 28 + length, file.end()) };
    }
    Json root = Json::parse(std::string(reinterpret_cast<const char*>(file.data()), file.size()));
    Bytes binary = *readGltfUri(root["buffers"][0]["uri"].get<std::string>(), path.parent_path());
    root["buffers"][0].erase("uri");
    return specimenFrom(root, std::move(binary));
}

/// An image-based light with two levels.
inline Specimen lightSpecimen() {
    TestFile file = fileWithLight(2, 2, [](uint32_t level, uint32_t face, uint32_t x, uint32_t y) {
        return (face * 50 + level * 3 + x * 20 + y) * 0x010101u | 0x80000000u;
    });
    lightOf(file)["rotation"] = { 0.5, 0.5, 0.5, 0.5 };
    lightOf(file)["intensity"] = 3;
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// Lightmaps: blocks with an openness in a file of its own, and shared exponents, with two levels of three.
inline Specimen lightmapSpecimen() {
    const Bytes bc6 = Ktx2Writer{
        .format = 143, .width = 8, .height = 4, .levels = { Bytes(32, std::byte{ 0x63 }), Bytes(16) }
    }.file();
    const Bytes bc4 = Ktx2Writer{
        .format = 139, .width = 8, .height = 4, .levels = { Bytes(16, std::byte{ 0x91 }), Bytes(8) }
    }.file();
    const Bytes shared = Ktx2Writer{
        .format = 123, .width = 4, .height = 4, .levels = { Bytes(64, std::byte{ 0x7A }), Bytes(16) }
    }.file();
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.indices({ 0, 1, 2 });
    for (Bytes const& image : { bc6, bc4, shared })
        file.root["images"].push_back({ { "bufferView", file.addView(image) } });
    file.root["textures"] = Json::parse(R"([ { "extensions": { "FILAMENT_lightmap": { "source": 0, "openness": 1 } } },
        { "extensions": { "FILAMENT_lightmap": { "source": 2 } } } ])");
    file.root["materials"] = Json::parse(R"([
        { "extensions": { "FILAMENT_lightmap": { "lightmapTexture": { "index": 0 }, "intensity": 16 } } },
        { "extensions": { "FILAMENT_lightmap": { "lightmapTexture": { "index": 1 } } } } ])");
    file.primitive()["material"] = 0;
    file.root["meshes"][0]["primitives"].push_back(file.primitive());
    file.root["meshes"][0]["primitives"][1]["material"] = 1;
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// A texture of ETC1S and one of UASTC.
inline Specimen basisSpecimen() {
    BasisWriter writer(8, 8, false, 1);
    std::vector<blocks::Texel8> texels;
    const Bytes slice = writer.slice(12, 9, texels);
    Ktx2Writer etc1s{ .format = 0,
                      .width = 12,
                      .height = 9,
                      .compression = 1,
                      .model = 163,
                      .transfer = 2,
                      .channels = { 0 },
                      .levels = { slice } };
    etc1s.globalData = writer.globalData({ { .length = static_cast<uint32_t>(slice.size()) } });
    const Ktx2Writer uastc{ .format = 0,
                            .width = 4,
                            .height = 4,
                            .model = 166,
                            .transfer = 1,
                            .channels = { 0 },
                            .levels = { Bytes(16, std::byte{ 0x37 }), Bytes(16), Bytes(16) } };
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    for (Bytes const& image : { etc1s.file(), uastc.file() })
        file.root["images"].push_back({ { "bufferView", file.addView(image) }, { "mimeType", "image/ktx2" } });
    file.root["textures"] = Json::parse(R"([ { "extensions": { "KHR_texture_basisu": { "source": 0 } } },
        { "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 } } } ])");
    file.root["materials"] =
            Json::parse(R"([ { "emissiveTexture": { "index": 0 }, "normalTexture": { "index": 1 } } ])");
    file.root["extensionsUsed"] = { "KHR_texture_basisu", "EXT_texture_webp" };
    file.primitive()["material"] = 0;
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// Strips that restart, nodes that picks pass through, and textures of ASTC and DDS.
inline Specimen restartSpecimen() {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.indices({ 0, 1, 2 });
    file.primitive()["mode"] = 5;
    file.primitive()["material"] = 0;
    const size_t all = file.add(std::vector<uint16_t>{ 0, 1, 2, 65535, 0, 1, 2 }, kUShort, "SCALAR", 1);
    file.root["meshes"][0]["primitives"].push_back(file.primitive());
    file.root["meshes"][0]["extensions"]["EXT_mesh_primitive_restart"]["primitiveGroups"] = {
        { { "primitives", { 0, 1 } }, { "indices", all } }
    };
    file.root["nodes"][0]["extensions"] = Json::parse(R"({ "KHR_node_selectability": { "selectable": false },
        "KHR_node_hoverability": { "hoverable": false } })");
    const Bytes astc =
            Ktx2Writer{ .format = 165, .width = 8, .height = 8, .levels = { Bytes(64, std::byte{ 0x52 }) } }.file();
    const Bytes dds = DdsWriter{ .dxgi = 98, .width = 8, .height = 4, .texels = Bytes(32, std::byte{ 0x40 }) }.file();
    for (Bytes const& image : { astc, dds }) file.root["images"].push_back({ { "bufferView", file.addView(image) } });
    file.root["textures"] = Json::parse(R"([ { "extensions": { "EXT_texture_astc": { "source": 0 } } },
        { "extensions": { "MSFT_texture_dds": { "source": 1 } } } ])");
    file.root["materials"] =
            Json::parse(R"([ { "emissiveTexture": { "index": 0 }, "normalTexture": { "index": 1 } } ])");
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// Splats of degree 1, with integers of both signs, and others that no node shows.
inline Specimen splatSpecimen() {
    TestFile file;
    file.positions({ 0, 0, 0, 1, 0, 0 });
    const std::string prefix = "KHR_gaussian_splatting:";
    const auto attribute = [&](std::string const& name, auto const& values, Component type, const char* of,
                               size_t size) {
        file.attribute((prefix + name).c_str(), values, type, of, size, type != kFloat);
    };
    attribute("ROTATION", std::vector<int8_t>{ 0, 0, 0, 127, 90, 0, 0, 90 }, kByte, "VEC4", 4);
    attribute("SCALE", std::vector<uint16_t>{ 900, 90, 9, 100, 200, 300 }, kUShort, "VEC3", 3);
    attribute("OPACITY", std::vector<uint8_t>{ 200, 255 }, kUByte, "SCALAR", 1);
    for (const char* name : { "0_COEF_0", "1_COEF_0", "1_COEF_1", "1_COEF_2" })
        attribute(std::string("SH_DEGREE_") + name, std::vector<float>{ 1, 2, 3, -1, 0, 0.5f }, kFloat, "VEC3", 3);
    file.primitive()["mode"] = 0;
    file.primitive()["extensions"]["KHR_gaussian_splatting"] = { { "kernel", "ellipse" },
                                                                 { "colorSpace", "srgb_rec709_display" },
                                                                 { "projection", "perspective" } };
    file.root["meshes"].push_back(file.root["meshes"][0]);
    file.root["meshes"][1]["primitives"][0]["mode"] = 4;
    file.root["buffers"] = { { { "byteLength", file.binary.size() } } };
    return specimenFrom(file.root, file.binary);
}

/// Written ones, and models of the asset folder if there is one.
inline std::vector<Specimen> allSpecimens() {
    std::vector<Specimen> specimens{ writtenSpecimen(), lightSpecimen(), basisSpecimen(),   pointerSpecimen(),
                                     restartSpecimen(), splatSpecimen(), lightmapSpecimen() };
    if (tools::assetDir().empty()) return specimens;
    for (const char* name :
         { "Box-Draco/Box.gltf", "BoxMeshopt/BoxMeshopt.glb", "BoxInterleaved/BoxInterleaved.gltf",
           "AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf", "SimpleInstancing/SimpleInstancing.glb",
           "UnlitTest/UnlitTest.glb", "BoxAnimated/BoxAnimated.glb", "RiggedFigure/RiggedFigure.glb",
           "TextureCoordinateTest/TextureCoordinateTest.glb", "VertexColorTest/VertexColorTest.glb" }) {
        specimens.push_back(assetSpecimen(tools::assetDir() / "models" / name));
    }
    return specimens;
}

/// Damages JSON and bytes at random.
class Scratcher {
public:
    explicit Scratcher(uint32_t seed) : mRandom(seed) {}

    void scratch(Specimen& specimen) {
        for (size_t i = below(4) + 1; i > 0; --i) {
            switch (below(4)) {
            case 0:
                replaceNumber(specimen.json);
                break;
            case 1:
                replaceCharacter(specimen.json);
                break;
            case 2:
                moveText(specimen.json);
                break;
            default:
                flipBits(specimen.binary);
                break;
            }
        }
    }

private:
    size_t below(size_t count) { return count == 0 ? 0 : mRandom() % count; }

    /// Replaces one number of the file, often by a nasty one.
    void replaceNumber(std::string& text) {
        static constexpr std::array kNumbers{ "-1",
                                              "0",
                                              "1",
                                              "2",
                                              "3",
                                              "7",
                                              "255",
                                              "65535",
                                              "65536",
                                              "4294967295",
                                              "4294967296",
                                              "9007199254740992",
                                              "18446744073709551615",
                                              "1e308",
                                              "-1e308",
                                              "0.5",
                                              "1e-320",
                                              "5121",
                                              "5126",
                                              "null",
                                              "\"x\"" };
        const size_t start = text.find_first_of("0123456789", below(text.size()));
        if (start == std::string::npos) return;
        const size_t end = std::min(text.find_first_not_of("0123456789.eE+-", start), text.size());
        text.replace(start, end - start, kNumbers[below(kNumbers.size())]);
    }

    void replaceCharacter(std::string& text) {
        if (!text.empty()) text[below(text.size())] = static_cast<char>(mRandom());
    }

    /// Removes a piece, or duplicates it.
    void moveText(std::string& text) {
        const size_t start = below(text.size()), length = below(32);
        if (below(2) == 0) {
            text.erase(start, length);
        } else {
            text.insert(start, text.substr(start, length));
        }
    }

    void flipBits(Bytes& bytes) {
        if (bytes.empty()) return;
        for (size_t i = below(8) + 1; i > 0; --i) bytes[below(bytes.size())] ^= static_cast<std::byte>(1u << below(8));
    }

    std::mt19937 mRandom;
};

} // namespace filament_core::assets::test
