// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/GltfMaterials.h"

#include "filament_core/base/Log.h"

#include <array>

namespace filament {
namespace {

using assets::AlphaMode;
using assets::kNone;
using assets::MaterialData;
using assets::TextureRef;

/// One map of a glTF material: the stem of its parameters and constants, and what the file says about it.
struct Map {
    const char*
            stem; ///< baseColor -> baseColorMap, baseColorUvMatrix; hasBaseColorMap, baseColorUv, baseColorTransform
    const char* has;
    TextureRef const& ref;
};

std::array<Map, 5> mapsOf(MaterialData const& material) {
    return { {
            { "baseColor", "hasBaseColorMap", material.baseColor },
            { "metallicRoughness", "hasMetallicRoughnessMap", material.metallicRoughness },
            { "normal", "hasNormalMap", material.normal },
            { "occlusion", "hasOcclusionMap", material.occlusion },
            { "emissive", "hasEmissiveMap", material.emissive },
    } };
}

// Occlusion in red, roughness and metallic of the same texture: the usual packing. One fetch serves both.
bool sharesTexel(TextureRef const& a, TextureRef const& b) {
    return a.image != kNone && a.image == b.image && a.sampler == b.sampler && a.uvSet == b.uvSet &&
           a.uvTransform == b.uvTransform;
}

// An unlit material has a base colour only.
size_t mapCount(MaterialData const& material) { return material.unlit ? 1 : 5; }

std::string packageName(MaterialData const& material) {
    std::string name = material.unlit ? "gltf_unlit_" : "gltf_lit_";
    switch (material.alphaMode) {
    case AlphaMode::Opaque:
        return name + "opaque";
    case AlphaMode::Mask:
        return name + "masked";
    case AlphaMode::Blend:
        return name + "blended";
    }
    return name + "opaque";
}

std::vector<MaterialConstant> constantsOf(MaterialData const& material, bool hasVertexColor) {
    std::vector<MaterialConstant> constants{ { "hasVertexColor", hasVertexColor } };
    const auto maps = mapsOf(material);
    for (size_t i = 0; i < mapCount(material); ++i) {
        Map const& map = maps[i];
        if (map.ref.image == kNone) continue;
        constants.push_back({ map.has, true });
        if (map.ref.uvSet != 0)
            constants.push_back({ std::string(map.stem) + "Uv", static_cast<int32_t>(map.ref.uvSet) });
        if (map.ref.hasTransform) constants.push_back({ std::string(map.stem) + "Transform", true });
    }
    if (!material.unlit && sharesTexel(material.occlusion, material.metallicRoughness)) {
        constants.push_back({ "occlusionInMetallicRoughness", true });
    }
    return constants;
}

std::string keyOf(std::string package, std::vector<MaterialConstant> const& constants) {
    for (MaterialConstant const& constant : constants) {
        package += '|' + constant.name + '=';
        package += std::visit([](auto value) { return std::to_string(value); }, constant.value);
    }
    return package;
}

// The engine's own packages know their parameters: a failure is a defect of this file.
void require(Result<void> const& result) {
    if (!result) log(Severity::Error, "{}", result.error().message);
    FILAMENT_ASSERT(result.ok(), "the glTF materials have the parameters that GltfMaterials sets");
}

} // namespace

Material GltfMaterials::materialFor(MaterialData const& material, bool hasVertexColor) {
    const std::string package = packageName(material);
    std::vector<MaterialConstant> constants = constantsOf(material, hasVertexColor);
    Material& shared = mMaterials[keyOf(package, constants)];
    if (!shared) {
        mModel.materials.push_back({}); // whoever makes something here has already a place for it
        auto created = mEngine.createMaterial({ mEngine.enginePackage(package), std::move(constants), package });
        if (!created) log(Severity::Error, "{}", created.error().message);
        FILAMENT_ASSERT(created.ok(), "the glTF materials have the constants that GltfMaterials sets");
        shared = mModel.materials.back() = *created;
    }
    return shared;
}

MaterialInstance GltfMaterials::instanceFor(MaterialData const& material, bool hasVertexColor) {
    const Material parent = materialFor(material, hasVertexColor);
    mModel.instances.push_back({});
    const MaterialInstance instance = mModel.instances.back() = mEngine.createInstance(parent, material.name);
    mEngine.instances.get(instance).raster.cullingDisabled = material.doubleSided;
    setParameters(instance, material);
    return instance;
}

void GltfMaterials::setParameters(MaterialInstance instance, MaterialData const& material) {
    require(mEngine.set(instance, "baseColorFactor", material.baseColorFactor));
    if (material.alphaMode == AlphaMode::Mask) require(mEngine.set(instance, "_maskThreshold", material.alphaCutoff));
    if (!material.unlit) {
        require(mEngine.set(instance, "metallicFactor", material.metallicFactor));
        require(mEngine.set(instance, "roughnessFactor", material.roughnessFactor));
        require(mEngine.set(instance, "normalScale", material.normalScale));
        require(mEngine.set(instance, "occlusionStrength", material.occlusionStrength));
        require(mEngine.set(instance, "emissiveFactor", material.emissiveFactor * material.emissiveStrength));
    }
    const auto maps = mapsOf(material);
    for (size_t i = 0; i < mapCount(material); ++i) {
        Map const& map = maps[i];
        if (map.ref.image == kNone) continue;
        const std::string stem = map.stem;
        require(mEngine.set(instance, stem + "Map", mTextures[map.ref.image], map.ref.sampler));
        if (map.ref.hasTransform) require(mEngine.set(instance, stem + "UvMatrix", map.ref.uvTransform));
    }
}

} // namespace filament
