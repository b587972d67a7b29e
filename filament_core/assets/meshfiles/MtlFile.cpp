// SPDX-License-Identifier: Apache-2.0
// Wavefront, "Material Library File (.mtl)"; Pr, Pm and norm: Exocortex, "Extending the OBJ/MTL format" (2014).
#include "filament_core/assets/meshfiles/MeshFile.h"
#include "filament_core/assets/meshfiles/MeshWords.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr size_t kMostMaterials = 100'000;
constexpr float kMostEmission = 1e6f;

/// How many numbers an option of a map may have.
size_t argumentsOf(std::string_view option) {
    if (option == "-o" || option == "-s" || option == "-t") return 3;
    return option == "-mm" ? 2 : 1;
}

/// The name of a map behind its options, which do not count.
std::string mapOf(std::string_view line, Diagnostics& diagnostics) {
    for (std::string_view rest = line;;) {
        std::string_view before = rest;
        const std::string_view word = takeWord(rest);
        if (!word.starts_with('-') || word.size() < 2) return std::string(trimmed(before));
        diagnostics.warn("options of maps are not read");
        const size_t most = argumentsOf(word);
        for (size_t i = 0; i < most; ++i) {
            before = rest;
            const std::string_view argument = takeWord(rest);
            if (i > 0 && !floatOf(argument)) { // fewer than it may have
                rest = before;
                break;
            }
        }
    }
}

/// One number stands for all three.
float3 colorOf(std::string_view line, float3 fallback, float most) {
    std::array<float, 3> n{};
    size_t count = 0;
    while (count < 3) {
        const std::optional<float> number = floatOf(takeWord(line));
        if (!number) break;
        n[count++] = std::clamp(*number, 0.0f, most);
    }
    if (count == 0) return fallback;
    return count < 3 ? float3(n[0]) : float3(n[0], n[1], n[2]);
}

float clampedNumber(std::string_view line, float fallback, float low, float high) {
    const std::optional<float> number = floatOf(takeWord(line));
    return number ? std::clamp(*number, low, high) : fallback;
}

void readValue(std::string_view word, std::string_view line, MeshFileMaterial& material, Diagnostics& diagnostics) {
    if (word == "Kd") {
        material.baseColor = float4(colorOf(line, float3(material.baseColor), 1), material.baseColor.w);
    } else if (word == "Ke") {
        material.emissive = colorOf(line, material.emissive, kMostEmission);
    } else if (word == "Ns") {
        // the width of a Blinn-Phong lobe: alpha^2 = 2 / (n + 2), and alpha is the roughness squared. Walter et al.
        // 2007, section 5.2
        const float exponent = clampedNumber(line, 0, 0, 1e6f);
        material.roughness = std::sqrt(std::sqrt(2 / (exponent + 2)));
    } else if (word == "Pr") {
        material.roughness = clampedNumber(line, material.roughness, 0, 1);
    } else if (word == "Pm") {
        material.metallic = clampedNumber(line, material.metallic, 0, 1);
    } else if (word == "d") {
        material.baseColor.w = clampedNumber(line, material.baseColor.w, 0, 1);
    } else if (word == "Tr") {
        material.baseColor.w = 1 - clampedNumber(line, 1 - material.baseColor.w, 0, 1);
    } else if (word == "map_Kd") {
        material.baseColorMap = mapOf(line, diagnostics);
    } else if (word == "map_Ke") {
        material.emissiveMap = mapOf(line, diagnostics);
        if (material.emissive == float3(0.0f)) material.emissive = float3(1.0f);
    } else if (word == "norm") {
        material.normalMap = mapOf(line, diagnostics);
    } else if (word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" || word == "refl") {
        diagnostics.warn("of the maps of materials only map_Kd, map_Ke and norm are read");
    }
}

} // namespace

void readMtl(std::string_view text, std::vector<MeshFileMaterial>& materials, Diagnostics& diagnostics) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const size_t before = materials.size();
    MeshFileMaterial* material = nullptr;
    while (!text.empty()) {
        std::string_view line = takeLine(text);
        line = line.substr(0, line.find('#'));
        const std::string_view word = takeWord(line);
        if (word == "newmtl") {
            if (materials.size() == kMostMaterials) {
                diagnostics.warn("more than {} materials", kMostMaterials);
                break;
            }
            material = &materials.emplace_back(MeshFileMaterial{ .name = std::string(trimmed(line)) });
        } else if (material) {
            readValue(word, line, *material, diagnostics);
        }
    }
    for (MeshFileMaterial& read : std::span(materials).subspan(before)) // a map stands for the colour, before or after
        if (!read.baseColorMap.empty()) read.baseColor = float4(float3(1.0f), read.baseColor.w);
}

} // namespace filament_core::assets
