// SPDX-License-Identifier: Apache-2.0
/// Files for tests of stages, small enough to be read at once: models with everything that a document edits, a
/// material, skies.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace filament_core::view {

/// A body, which has another paint in variant "race", and a head with morph targets; three lights, a camera, an
/// animation. `marks` in the text are replaced, so that files differ.
inline constexpr std::string_view kCar =
        R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ],
    "extensionsUsed": [ "KHR_materials_variants", "KHR_lights_punctual" ],
    "extensions": { "KHR_materials_variants": { "variants": [ { "name": "race" } ] },
        "KHR_lights_punctual": { "lights": [ { "type": "point", "name": "lamp", "intensity": 300 },
            { "type": "directional", "intensity": 3000 }, { "type": "spot", "name": "beam", "intensity": 500 } ] } },
    "nodes": [ { "mesh": 0, "name": "body", "children": [ 1, 2, 3, 4, 5 ] },
        { "mesh": 1, "name": "head", "translation": [ 0.6, 0.3, 0.2 ] },
        { "name": "seat", "camera": 0, "translation": [ 0, 0, 5 ] },
        { "name": "socket", "translation": [ 0, 0, 1 ], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        { "name": "sky", "rotation": [ -0.5, 0, 0, 0.8660254 ], "extensions": { "KHR_lights_punctual": { "light": 1 } } },
        { "name": "front", "translation": [ 0.5, 0.5, 2 ], "extensions": { "KHR_lights_punctual": { "light": 2 } } } ],
    "cameras": [ { "name": "driver", "type": "perspective", "perspective": { "yfov": 1, "znear": 0.25 } } ],
    "materials": [
        { "name": "paint", "doubleSided": true, "pbrMetallicRoughness": { "baseColorFactor": [ COLOR, 1 ], "metallicFactor": 0 } },
        { "name": "race paint", "doubleSided": true, "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ], "metallicFactor": 0 } },
        { "name": "skin", "doubleSided": true, "pbrMetallicRoughness": { "metallicFactor": 0.25, "roughnessFactor": 0.5 } } ],
    "meshes": [
        { "name": "shell", "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0, "extensions": {
            "KHR_materials_variants": { "mappings": [ { "material": 1, "variants": [ 0 ] } ] } } } ] },
        { "name": "face", "weights": [ 0, 0.25 ], "extras": { "targetNames": [ "smile", "blink" ] }, "primitives": [
            { "attributes": { "POSITION": 0 }, "material": 2, "targets": [ { "POSITION": 1 }, { "POSITION": 1 } ] } ] } ],
    "animations": [ { "name": "drive", "samplers": [ { "input": 2, "output": 3 } ],
        "channels": [ { "sampler": 0, "target": { "node": 0, "path": "translation" } } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] },
        { "bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "VEC3" },
        { "bufferView": 0, "byteOffset": 72, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [ 0 ], "max": [ 1 ] },
        { "bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 2, "type": "VEC3" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 104 } ],
    "buffers": [ { "byteLength": 104, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA=" } ] })";

inline std::string carText(std::string_view color) {
    std::string text(kCar);
    return text.replace(text.find("COLOR"), 5, color);
}

inline std::string materialText(std::string_view color) {
    return "// show: mesh=sphere tint=0.8,0.4,0.2\nmaterial { name : ball, shadingModel : unlit,\n"
           "    variantFilter : [ skinning, fog, ssr, vsm, shadowReceiver, dynamicLighting, directionalLighting ],\n"
           "    parameters : [ { type : float3, name : tint }, { type : float, name : rough } ] }\n"
           "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n"
           "    material.baseColor = vec4(materialParams.tint * " +
           std::string(color) + ", 1.0); material.baseColor.r += 0.1 * materialParams.rough; } }\n";
}

/// A sky that is brighter above, of 32 x 16 pixels (Ward 1991, "Real Pixels": four bytes a pixel, not compressed).
inline std::string skyText(int red) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n";
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            text += static_cast<char>(red);
            text += static_cast<char>(200 - 10 * y);
            text += static_cast<char>(100 + 3 * x);
            text += static_cast<char>(128);
        }
    }
    return text;
}

/// A folder of this process, removed with it: car.gltf, cab.gltf, ball.mat, day.hdr, dusk.hdr, warm.cube.
class StageFolder {
public:
    StageFolder() : mPath(std::filesystem::temp_directory_path() / ("stage-files-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(mPath);
        write("car.gltf", carText("0, 0.2, 1"));
        write("cab.gltf", carText("1, 0.8, 0"));
        write("ball.mat", materialText("vec3(1.0)"));
        write("day.hdr", skyText(150));
        write("dusk.hdr", skyText(240));
        write("warm.cube", "LUT_1D_SIZE 2\n0 0 0\n1 0.8 0.5\n");
    }
    ~StageFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    StageFolder(StageFolder const&) = delete;
    StageFolder& operator=(StageFolder const&) = delete;

    std::filesystem::path write(std::string const& name, std::string_view text) const {
        std::ofstream(mPath / name, std::ios::binary) << text;
        return mPath / name;
    }
    std::filesystem::path operator/(std::string const& name) const { return mPath / name; }

private:
    std::filesystem::path mPath;
};

} // namespace filament_core::view
