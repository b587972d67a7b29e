// SPDX-License-Identifier: Apache-2.0
// The extensions of materials, one function each. Ranges are those of the specifications; an unlimited range ends
// where 16 bits do, because shaders may compute in them.
#include "filament_core/assets/gltf/GltfParseMaterial.h"

namespace filament_core::assets {
namespace {

constexpr float kMaxHalf = 65504;
constexpr float kMaxDispersion = 100; // an Abbe number of 0.2; diamond has 55
constexpr float kMaxFilmIor = 100;
constexpr float kMinAttenuationMeters = 1e-6f;

/// The extensions object of one material, and the number of textures that it may refer to.
struct Extensions {
    JsonNode const& material;
    size_t textureCount;

    JsonNode at(const char* name) const { return material.extension(name); }
    GltfTextureInfo texture(JsonNode const& extension, const char* name) const {
        return parseTextureInfo(extension[name], textureCount);
    }
};

float3 parseColor(JsonNode const& node, double fallback, double high) {
    const auto color = parseFactors<3>(node, fallback, 0, high);
    return { color[0], color[1], color[2] };
}

void parseClearCoat(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_clearcoat");
    ClearCoatData& coat = material.values.clearCoat;
    coat.factor = node["clearcoatFactor"].numberInRange(0, 0, 1);
    coat.roughness = node["clearcoatRoughnessFactor"].numberInRange(0, 0, 1);
    coat.normalScale = node["clearcoatNormalTexture"]["scale"].numberInRange(1, -kMaxFloat, kMaxFloat);
    material.clearCoat = { extensions.texture(node, "clearcoatTexture"),
                           extensions.texture(node, "clearcoatRoughnessTexture") };
    material.clearCoatNormal = extensions.texture(node, "clearcoatNormalTexture");
}

void parseSheen(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_sheen");
    material.values.sheen.color = parseColor(node["sheenColorFactor"], 0, 1);
    material.values.sheen.roughness = node["sheenRoughnessFactor"].numberInRange(0, 0, 1);
    material.sheen = { extensions.texture(node, "sheenColorTexture"),
                       extensions.texture(node, "sheenRoughnessTexture") };
}

void parseSpecular(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_specular");
    SpecularData& specular = material.values.specular;
    specular.factor = node["specularFactor"].numberInRange(1, 0, 1);
    specular.color = parseColor(node["specularColorFactor"], 1, kMaxHalf);
    material.specular = { extensions.texture(node, "specularColorTexture"),
                          extensions.texture(node, "specularTexture") };
    specular.hasTexture = material.specular.first.texture != kNone || material.specular.second.texture != kNone;
}

void parseAnisotropy(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_anisotropy");
    AnisotropyData& anisotropy = material.values.anisotropy;
    anisotropy.strength = node["anisotropyStrength"].numberInRange(0, 0, 1);
    anisotropy.rotationRadians = node["anisotropyRotation"].numberInRange(0, -kMaxFloat, kMaxFloat);
    material.anisotropy = extensions.texture(node, "anisotropyTexture");
}

void parseBump(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("EXT_materials_bump");
    material.values.bump.factor = node["bumpFactor"].numberInRange(1, -kMaxHalf, kMaxHalf);
    material.bump = extensions.texture(node, "bumpTexture");
}

void parseIridescence(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_iridescence");
    IridescenceData& film = material.values.iridescence;
    film.factor = node["iridescenceFactor"].numberInRange(0, 0, 1);
    film.ior = node["iridescenceIor"].numberInRange(1.3f, 1, kMaxFilmIor);
    film.thicknessMinNanometers = node["iridescenceThicknessMinimum"].numberInRange(100, 0, kMaxHalf);
    film.thicknessMaxNanometers = node["iridescenceThicknessMaximum"].numberInRange(400, 0, kMaxHalf);
    material.iridescence = { extensions.texture(node, "iridescenceTexture"),
                             extensions.texture(node, "iridescenceThicknessTexture") };
}

/// KHR_materials_ior: 0 stands for an infinite index.
void parseIor(Extensions const& extensions, MaterialData& values) {
    const JsonNode ior = extensions.at("KHR_materials_ior")["ior"];
    values.ior = ior.exists() && ior.number(1.5) == 0 ? kOpaqueIor : ior.numberInRange(1.5f, 1, kOpaqueIor);
}

void parseDiffuseTransmission(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_diffuse_transmission");
    material.values.diffuseTransmission.factor = node["diffuseTransmissionFactor"].numberInRange(0, 0, 1);
    material.values.diffuseTransmission.color = parseColor(node["diffuseTransmissionColorFactor"], 1, 1);
    material.diffuseTransmission = { extensions.texture(node, "diffuseTransmissionColorTexture"),
                                     extensions.texture(node, "diffuseTransmissionTexture") };
}

void parseVolume(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_volume");
    if (!node.exists()) return;
    if (!extensions.at("KHR_materials_transmission").exists() &&
        !extensions.at("KHR_materials_diffuse_transmission").exists()) {
        node.diagnostics().warn("{}: needs KHR_materials_transmission and is left out without it", node.path());
        return;
    }
    TransmissionData& volume = material.values.transmission;
    volume.thicknessMeters = node["thicknessFactor"].numberInRange(0, 0, kMaxHalf);
    volume.attenuationColor = parseColor(node["attenuationColor"], 1, 1);
    if (const JsonNode distance = node["attenuationDistance"]; distance.exists())
        volume.attenuationDistanceMeters = distance.numberInRange(1, kMinAttenuationMeters, kMaxFloat);
    material.transmission.second = extensions.texture(node, "thicknessTexture");
}

/// The published draft and files of its time name the colour multiscatterColor; later texts, multiscatterColorFactor.
void parseVolumeScatter(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_volume_scatter");
    if (!node.exists()) return;
    if (!extensions.at("KHR_materials_volume").exists()) {
        node.diagnostics().warn("{}: needs KHR_materials_volume and is left out without it", node.path());
        return;
    }
    VolumeScatterData& scatter = material.values.volumeScatter;
    const JsonNode color = node["multiscatterColorFactor"];
    scatter.color = parseColor(color.exists() ? color : node["multiscatterColor"], 0, 1);
    scatter.anisotropy = node["scatterAnisotropy"].numberInRange(0, -kMaxScatterAnisotropy, kMaxScatterAnisotropy);
    material.multiscatter = extensions.texture(node, "multiscatterColorTexture");
}

void parseTransmission(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("KHR_materials_transmission");
    material.values.transmission.factor = node["transmissionFactor"].numberInRange(0, 0, 1);
    material.transmission.first = extensions.texture(node, "transmissionTexture");
    parseVolume(extensions, material);
    const JsonNode dispersion = extensions.at("KHR_materials_dispersion");
    if (dispersion.exists() && !extensions.at("KHR_materials_volume").exists()) {
        dispersion.diagnostics().warn("{}: needs KHR_materials_volume and is left out without it", dispersion.path());
        return;
    }
    material.values.transmission.dispersion = dispersion["dispersion"].numberInRange(0, 0, kMaxDispersion);
}

/// The diffuse colour and its map become the base colour, so that alpha modes work in the same way.
void parseSpecularGlossiness(Extensions const& extensions, JsonNode const& node, GltfMaterial& material) {
    const auto diffuse = parseFactors<4>(node["diffuseFactor"], 1, 0, 1);
    material.values.baseColorFactor = { diffuse[0], diffuse[1], diffuse[2], diffuse[3] };
    material.values.specularGlossiness =
            SpecularGlossinessData{ .specularFactor = parseColor(node["specularFactor"], 1, 1),
                                    .glossinessFactor = node["glossinessFactor"].numberInRange(1, 0, 1),
                                    .map = {} };
    material.baseColor = extensions.texture(node, "diffuseTexture");
    material.specularGlossiness = extensions.texture(node, "specularGlossinessTexture");
}

constexpr std::array kLayers{ "KHR_materials_clearcoat",     "KHR_materials_sheen",
                              "KHR_materials_specular",      "KHR_materials_anisotropy",
                              "KHR_materials_iridescence",   "KHR_materials_ior",
                              "KHR_materials_transmission",  "KHR_materials_diffuse_transmission",
                              "KHR_materials_volume",        "KHR_materials_dispersion",
                              "KHR_materials_volume_scatter" };

/// The layers' specifications forbid combining them with a model that lacks their properties.
void warnAboutLayers(Extensions const& extensions, const char* model) {
    for (const char* name : kLayers) {
        if (const JsonNode node = extensions.at(name); node.exists())
            node.diagnostics().warn("{}: must not be used with {} and is left out", node.path(), model);
    }
}

void parseBentNormal(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("FILAMENT_bent_normal");
    material.values.hasBentNormals = node.exists() && material.occlusion.texture != kNone;
    if (node.exists() && !material.values.hasBentNormals)
        node.diagnostics().warn("{}: needs an occlusionTexture and is left out without it", node.path());
}

void parseLightmap(Extensions const& extensions, GltfMaterial& material) {
    const JsonNode node = extensions.at("FILAMENT_lightmap");
    material.light = extensions.texture(node, "lightmapTexture");
    material.values.light.intensityLux = node["intensity"].numberInRange(1, 0, kMaxFloat);
    material.values.light.hasDirectLight = node["directLight"].boolean(false);
}

} // namespace

void parseMaterialExtensions(JsonNode const& node, size_t textureCount, GltfMaterial& material) {
    const Extensions extensions{ node, textureCount };
    parseBump(extensions, material);
    parseBentNormal(extensions, material);
    const JsonNode glossiness = extensions.at("KHR_materials_pbrSpecularGlossiness");
    if (extensions.at("KHR_materials_unlit").exists()) {
        material.values.unlit = true;
        if (glossiness.exists())
            node.diagnostics().warn("{}: must not be used with KHR_materials_unlit and is left out", glossiness.path());
        return warnAboutLayers(extensions, "KHR_materials_unlit");
    }
    if (glossiness.exists()) {
        parseSpecularGlossiness(extensions, glossiness, material);
        return warnAboutLayers(extensions, "KHR_materials_pbrSpecularGlossiness");
    }
    parseClearCoat(extensions, material);
    parseSheen(extensions, material);
    parseSpecular(extensions, material);
    parseAnisotropy(extensions, material);
    parseIridescence(extensions, material);
    parseIor(extensions, material.values);
    parseTransmission(extensions, material);
    parseDiffuseTransmission(extensions, material);
    parseVolumeScatter(extensions, material);
    parseLightmap(extensions, material);
}

std::vector<VariantMaterial> parseVariantMaterials(JsonNode const& primitive, size_t materialCount,
                                                   size_t variantCount) {
    std::vector<VariantMaterial> materials;
    for (JsonNode const& mapping : primitive.extension("KHR_materials_variants")["mappings"].elements()) {
        const uint32_t material = mapping["material"].requiredIndex(materialCount, "materials");
        for (JsonNode const& node : mapping["variants"].elements()) {
            const uint32_t variant = node.requiredIndex(variantCount, "variants");
            materials.push_back({ variant, material });
        }
    }
    const auto earlier = [](VariantMaterial const& a, VariantMaterial const& b) { return a.variant < b.variant; };
    const auto same = [](VariantMaterial const& a, VariantMaterial const& b) { return a.variant == b.variant; };
    std::ranges::stable_sort(materials, earlier);
    const auto repeated = std::unique(materials.begin(), materials.end(), same);
    if (repeated != materials.end()) {
        primitive.diagnostics().warn("{}: a variant has two materials, the first is used", primitive.path());
        materials.erase(repeated, materials.end());
    }
    return materials;
}

} // namespace filament_core::assets
