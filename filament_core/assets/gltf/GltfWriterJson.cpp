// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfWriterJson.h"

#include "base/math/Elementary.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

void useExtension(const char* name, Json& root) {
    Json& used = root["extensionsUsed"];
    if (used.is_null()) used = Json::array();
    if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

template <class T>
void addUnlessDefault(Json& object, const char* key, T value, T fallback) {
    if (value != fallback) object[key] = value;
}

int wrapNumber(backend::WrapMode wrap) {
    switch (wrap) {
    case backend::WrapMode::ClampToEdge:
        return 33071;
    case backend::WrapMode::MirroredRepeat:
        return 33648;
    case backend::WrapMode::Repeat:
        break;
    }
    return 10497;
}

Json samplerJson(Sampler const& sampler) {
    const bool isNearest = sampler.minFilter == backend::Filter::Nearest;
    int minFilter = isNearest ? 9728 : 9729;
    if (sampler.mipFilter == backend::MipFilter::Nearest) minFilter = isNearest ? 9984 : 9985;
    if (sampler.mipFilter == backend::MipFilter::Linear) minFilter = isNearest ? 9986 : 9987;
    return { { "magFilter", sampler.magFilter == backend::Filter::Nearest ? 9728 : 9729 },
             { "minFilter", minFilter },
             { "wrapS", wrapNumber(sampler.wrapU) },
             { "wrapT", wrapNumber(sampler.wrapV) } };
}

/// The inverse of the loader's textureTransform(): columns (c sx, -s sx), (s sy, c sy), (ox, oy).
Json transformJson(float3x3 const& m) {
    const float rotation = elementary::atan2(-m[0].y, m[0].x);
    const float scaleX = elementary::hypot(m[0].x, m[0].y);
    const float mirror = m[0].x * m[1].y - m[0].y * m[1].x < 0 ? -1.0f : 1.0f;
    const float scaleY = mirror * elementary::hypot(m[1].x, m[1].y);
    return { { "offset", { m[2].x, m[2].y } }, { "rotation", rotation }, { "scale", { scaleX, scaleY } } };
}

/// Textures and samplers; each combination once.
class TextureWriter {
public:
    explicit TextureWriter(Json& root) : mRoot(root) {}

    Json info(TextureRef const& reference) {
        Json json{ { "index", textureFor(reference) } };
        addUnlessDefault(json, "texCoord", reference.uvSet, 0u);
        if (reference.hasTransform) {
            json["extensions"]["KHR_texture_transform"] = transformJson(reference.uvTransform);
            useExtension("KHR_texture_transform", mRoot);
        }
        return json;
    }

private:
    static size_t findOrAdd(Json& list, Json const& value) {
        if (list.is_null()) list = Json::array();
        const auto found = std::find(list.begin(), list.end(), value);
        const auto index = static_cast<size_t>(found - list.begin());
        if (found == list.end()) list.push_back(value);
        return index;
    }

    size_t textureFor(TextureRef const& reference) {
        const size_t sampler = findOrAdd(mRoot["samplers"], samplerJson(reference.sampler));
        return findOrAdd(mRoot["textures"], { { "sampler", sampler }, { "source", reference.image } });
    }

    Json& mRoot;
};

Json coreJson(MaterialData const& material, TextureWriter& textures) {
    Json core = Json::object();
    const float4 base = material.baseColorFactor;
    if (base != float4(1.0f)) core["baseColorFactor"] = { base.x, base.y, base.z, base.w };
    addUnlessDefault(core, "metallicFactor", material.metallicFactor, 1.0f);
    addUnlessDefault(core, "roughnessFactor", material.roughnessFactor, 1.0f);
    if (material.baseColor.image != kNone) core["baseColorTexture"] = textures.info(material.baseColor);
    if (material.metallicRoughness.image != kNone) {
        core["metallicRoughnessTexture"] = textures.info(material.metallicRoughness);
    }
    return core;
}

void addAlpha(MaterialData const& material, Json& json) {
    if (material.alphaMode == AlphaMode::Blend) json["alphaMode"] = "BLEND";
    if (material.alphaMode != AlphaMode::Mask) return;
    json["alphaMode"] = "MASK";
    addUnlessDefault(json, "alphaCutoff", material.alphaCutoff, 0.5f);
}

void addVolume(TransmissionData const& transmission, Json& json, Json& root) {
    const float3 color = transmission.attenuationColor;
    Json volume{ { "thicknessFactor", transmission.thicknessMeters },
                 { "attenuationColor", { color.x, color.y, color.z } } };
    if (std::isfinite(transmission.attenuationDistanceMeters))
        volume["attenuationDistance"] = transmission.attenuationDistanceMeters;
    json["extensions"]["KHR_materials_volume"] = std::move(volume);
    useExtension("KHR_materials_volume", root);
}

void addTransmission(MaterialData const& material, Json& json, Json& root) {
    if (material.transmission.isUsed()) {
        json["extensions"]["KHR_materials_transmission"] = { { "transmissionFactor", material.transmission.factor } };
        useExtension("KHR_materials_transmission", root);
    }
    if (material.diffuseTransmission.isUsed()) {
        const float3 color = material.diffuseTransmission.color;
        json["extensions"]["KHR_materials_diffuse_transmission"] = {
            { "diffuseTransmissionFactor", material.diffuseTransmission.factor },
            { "diffuseTransmissionColorFactor", { color.x, color.y, color.z } }
        };
        useExtension("KHR_materials_diffuse_transmission", root);
    }
    if (material.transmission.isSolid() || material.scatters()) addVolume(material.transmission, json, root);
    if (!material.scatters()) return;
    const float3 color = material.volumeScatter.color;
    json["extensions"]["KHR_materials_volume_scatter"] = { { "multiscatterColorFactor", { color.x, color.y, color.z } },
                                                           { "scatterAnisotropy", material.volumeScatter.anisotropy } };
    useExtension("KHR_materials_volume_scatter", root);
}

void addBump(BumpData const& bump, TextureWriter& textures, Json& json, Json& root) {
    json["extensions"]["EXT_materials_bump"] = { { "bumpTexture", textures.info(bump.map) } };
    addUnlessDefault(json["extensions"]["EXT_materials_bump"], "bumpFactor", bump.factor, 1.0f);
    useExtension("EXT_materials_bump", root);
}

void addMaterialExtensions(MaterialData const& material, Json& json, Json& root) {
    if (material.unlit) {
        json["extensions"]["KHR_materials_unlit"] = Json::object();
        useExtension("KHR_materials_unlit", root);
    }
    if (material.emissiveStrength != 1.0f) {
        json["extensions"]["KHR_materials_emissive_strength"] = { { "emissiveStrength", material.emissiveStrength } };
        useExtension("KHR_materials_emissive_strength", root);
    }
    addTransmission(material, json, root);
}

Json materialJson(MaterialData const& material, TextureWriter& textures, Json& root) {
    Json json{ { "name", material.name }, { "pbrMetallicRoughness", coreJson(material, textures) } };
    if (material.normal.image != kNone) {
        json["normalTexture"] = textures.info(material.normal);
        addUnlessDefault(json["normalTexture"], "scale", material.normalScale, 1.0f);
    }
    if (material.occlusion.image != kNone) {
        json["occlusionTexture"] = textures.info(material.occlusion);
        addUnlessDefault(json["occlusionTexture"], "strength", material.occlusionStrength, 1.0f);
    }
    if (material.emissive.image != kNone) json["emissiveTexture"] = textures.info(material.emissive);
    const float3 emissive = material.emissiveFactor;
    if (emissive != float3(0.0f)) json["emissiveFactor"] = { emissive.x, emissive.y, emissive.z };
    addAlpha(material, json);
    addUnlessDefault(json, "doubleSided", material.doubleSided, false);
    if (material.bump.map.image != kNone) addBump(material.bump, textures, json, root);
    addMaterialExtensions(material, json, root);
    return json;
}

Json imageBasedLightJson(GlbImageBasedLight const& light) {
    Json irradiance = Json::array(), levels = Json::array();
    for (double3 const& c : light.irradiance) irradiance.push_back({ c.x, c.y, c.z });
    for (auto const& level : light.levels) levels.push_back(level);
    Json json = Json::object();
    if (!light.name.empty()) json["name"] = light.name;
    double4 const& r = light.rotation;
    if (r != double4(0, 0, 0, 1)) json["rotation"] = { r.x, r.y, r.z, r.w };
    addUnlessDefault(json, "intensity", light.intensity, 1.0f);
    json["irradianceCoefficients"] = std::move(irradiance);
    json["specularImageSize"] = light.size;
    json["specularImages"] = std::move(levels);
    return json;
}

Json nodeJson(GlbNode const& node, Json& root) {
    Json json{ { "name", node.name } };
    if (node.parentFromNode != double4x4(1.0)) {
        Json matrix = Json::array();
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) matrix.push_back(node.parentFromNode[column][row]);
        }
        json["matrix"] = std::move(matrix);
    }
    if (node.mesh != kNone) json["mesh"] = node.mesh;
    if (!node.children.empty()) json["children"] = node.children;
    if (node.light != kNone) {
        json["extensions"]["KHR_lights_punctual"] = { { "light", node.light } };
        useExtension("KHR_lights_punctual", root);
    }
    return json;
}

} // namespace

void addNodes(GlbScene const& scene, Json& root) {
    std::vector<bool> hasParent(scene.nodes.size(), false);
    Json nodes = Json::array(), roots = Json::array();
    for (GlbNode const& node : scene.nodes) {
        for (const uint32_t child : node.children) hasParent[child] = true;
        nodes.push_back(nodeJson(node, root));
    }
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (!hasParent[i]) roots.push_back(i);
    }
    Json entry{ { "name", scene.name } };
    if (!roots.empty()) entry["nodes"] = std::move(roots);
    if (scene.imageBasedLight) entry["extensions"]["EXT_lights_image_based"] = { { "light", 0 } };
    root["scene"] = 0;
    root["scenes"] = Json::array({ std::move(entry) });
    if (!nodes.empty()) root["nodes"] = std::move(nodes);
}

void addMaterials(GlbScene const& scene, Json& root) {
    if (scene.materials.empty()) return;
    TextureWriter textures(root);
    Json materials = Json::array();
    for (MaterialData const& material : scene.materials) materials.push_back(materialJson(material, textures, root));
    root["materials"] = std::move(materials);
}

Json materialJson(MaterialData const& material, Json& root) {
    TextureWriter textures(root);
    return materialJson(material, textures, root);
}

Json textureInfoJson(TextureRef const& reference, Json& root) { return TextureWriter(root).info(reference); }

void addLights(GlbScene const& scene, Json& root) {
    if (scene.imageBasedLight) {
        root["extensions"]["EXT_lights_image_based"]["lights"] =
                Json::array({ imageBasedLightJson(*scene.imageBasedLight) });
        useExtension("EXT_lights_image_based", root);
    }
    if (scene.lights.empty()) return;
    Json lights = Json::array();
    for (LightData const& light : scene.lights) {
        lights.push_back(punctualLightJson(light));
        if (lights.back().contains("extensions")) useExtension("FILAMENT_light", root);
    }
    root["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights);
    useExtension("KHR_lights_punctual", root);
}

} // namespace filament_core::assets
