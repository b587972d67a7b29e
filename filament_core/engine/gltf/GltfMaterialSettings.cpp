// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/gltf/GltfMaterialSettings.h"

#include "base/math/Elementary.h"
#include "shaders/lib/LibCpp.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using assets::AlphaMode;
using assets::kNone;
using assets::MaterialData;
using assets::TexturePair;
using assets::TextureRef;

constexpr float kMaxHalf = 65504; // shaders may compute in 16 bits

std::string withSuffix(std::string const& family, AlphaMode mode) {
    switch (mode) {
    case AlphaMode::Opaque:
        return family + "_opaque";
    case AlphaMode::Mask:
        return family + "_masked";
    case AlphaMode::Blend:
        return family + "_blended";
    }
    return family + "_opaque";
}

bool hasLayers(MaterialData const& m) {
    return m.ior != 1.5f || m.isIorAnimated || m.clearCoat.isUsed() || m.sheen.isUsed() || m.specular.isUsed() ||
           m.anisotropy.isUsed() || m.iridescence.isUsed() || m.diffuseTransmission.isUsed() || m.transmission.isUsed();
}

const char* familyOf(MaterialData const& material, GltfVertices const& vertices) {
    if (material.unlit || !vertices.hasNormals) return "gltf_unlit";
    if (material.specularGlossiness) return "gltf_specular_glossiness";
    if (material.scatters()) return "gltf_scattering";
    if (material.transmission.isSolid()) return "gltf_transmissive_solid";
    if (material.transmission.isUsed()) return "gltf_transmissive_thin";
    return hasLayers(material) ? "gltf_layered" : "gltf_lit";
}

// Occlusion in red, roughness and metallic in the same texture: the usual packing. One fetch serves both.
bool sharesTexel(TextureRef const& a, TextureRef const& b) {
    return a.image != kNone && a.image == b.image && a.sampler == b.sampler && a.uvSet == b.uvSet &&
           a.uvTransform == b.uvTransform && !a.isAnimated && !b.isAnimated;
}

/// Collects the settings of one material; missing properties leave no trace.
class Settings {
public:
    Settings(GltfMaterialSettings& settings, size_t maxMaps)
            : mMaxMaps(maxMaps), mSettings(&settings), mParameters(settings.parameters) {}
    /// Of parameters alone.
    explicit Settings(GltfParameters& parameters) : mParameters(parameters) {}

    void constant(const char* name, std::variant<bool, int32_t, float> value) {
        if (mSettings) mSettings->constants.push_back({ name, value });
    }
    void feature(const char* has) { constant(has, true); }
    void parameter(const char* name, ParameterValue const& value) { mParameters.push_back({ name, value }); }

    /// False: there is none, or no room for it.
    bool map(const char* stem, const char* has, TextureRef const& texture) {
        if (texture.image == kNone || !hasRoomFor(stem)) return false;
        feature(has);
        addMap(stem, texture);
        return true;
    }

    /// Of vectors: the shader turns them into the frame of the vertices.
    void vectorMap(const char* stem, const char* has, TextureRef const& texture, GltfVertices const& vertices) {
        if (texture.image == kNone || !vertices.hasTangents || !hasRoomFor(stem)) return;
        feature(has);
        addMap(stem, texture);
        if (texture.hasVariance) mSettings->constants.push_back({ stem + std::string("Width"), true });
        const assets::MapFrame frame = assets::frameOf(texture, vertices.basis);
        if (frame != assets::MapFrame::Vertex)
            mSettings->constants.push_back({ stem + std::string("Frame"), static_cast<int32_t>(frame) });
    }

    /// `second`: stem of the second map where it has a texture of its own, of which `isApart` tells the shader.
    void maps(const char* stem, const char* hasFirst, const char* hasSecond, TexturePair const& pair,
              const char* second, const char* isApart) {
        if (pair.texture.image == kNone || !hasRoomFor(stem)) return;
        if (pair.hasFirst) feature(hasFirst);
        addMap(stem, pair.texture);
        if (!pair.hasSecond || (pair.isApart() && !hasRoomFor(second))) return;
        feature(hasSecond);
        if (!pair.isApart()) return;
        feature(isApart);
        addMap(second, pair.second);
    }

private:
    bool hasRoomFor(const char* stem) {
        if (!mSettings) return false;
        if (mSettings->maps.size() < mMaxMaps) return true;
        mSettings->leftOut.emplace_back(stem);
        return false;
    }
    void addMap(std::string const& stem, TextureRef const& texture) {
        if (texture.uvSet != 0) mSettings->constants.push_back({ stem + "Uv", static_cast<int32_t>(texture.uvSet) });
        if (texture.hasTransform) mSettings->constants.push_back({ stem + "Transform", true });
        mSettings->maps.push_back({ stem, texture });
    }

    size_t mMaxMaps = 0;
    GltfMaterialSettings* mSettings = nullptr;
    GltfParameters& mParameters;
};

void setCore(Settings& settings, MaterialData const& material, GltfVertices const& vertices) {
    settings.constant("hasVertexColor", vertices.hasColor);
    settings.parameter("baseColorFactor", material.baseColorFactor);
    if (material.alphaMode == AlphaMode::Mask) settings.parameter("_maskThreshold", material.alphaCutoff);
    settings.map("baseColor", "hasBaseColorMap", material.baseColor);
}

void setMetallicRoughness(Settings& settings, MaterialData const& material) {
    settings.parameter("metallicFactor", material.metallicFactor);
    settings.parameter("roughnessFactor", material.roughnessFactor);
    settings.map("metallicRoughness", "hasMetallicRoughnessMap", material.metallicRoughness);
}

void setSpecularGlossiness(Settings& settings, assets::SpecularGlossinessData const& data) {
    settings.parameter("specularFactor", data.specularFactor);
    settings.parameter("glossinessFactor", data.glossinessFactor);
    settings.map("specularGlossiness", "hasSpecularGlossinessMap", data.map);
}

void setEmission(Settings& settings, MaterialData const& material) {
    settings.parameter("emissiveFactor", material.emissiveFactor * material.emissiveStrength);
    settings.map("emissive", "hasEmissiveMap", material.emissive);
}

void setCommonMaps(Settings& settings, MaterialData const& material, GltfVertices const& vertices) {
    settings.parameter("normalScale", material.normalScale);
    settings.parameter("occlusionStrength", material.occlusionStrength);
    settings.vectorMap("normal", "hasNormalMap", material.normal, vertices);
    if (material.bump.isUsed() && material.bump.map.image != kNone) {
        settings.parameter("bumpFactor", material.bump.factor);
        settings.map("bump", "hasBumpMap", material.bump.map);
    }
    if (!material.specularGlossiness && !material.hasBentNormals &&
        sharesTexel(material.occlusion, material.metallicRoughness))
        settings.feature("occlusionInMetallicRoughness");
    else if (settings.map("occlusion", "hasOcclusionMap", material.occlusion) && material.hasBentNormals)
        settings.feature("hasBentNormals");
    setEmission(settings, material);
}

void setClearCoat(Settings& settings, assets::ClearCoatData const& coat, GltfVertices const& vertices) {
    if (!coat.isUsed()) return;
    settings.feature("hasClearCoat");
    settings.parameter("clearCoat", coat.factor);
    settings.parameter("clearCoatRoughness", coat.roughness);
    settings.maps("clearCoat", "hasClearCoatMap", "hasClearCoatRoughnessMap", coat.maps, "clearCoatRoughness",
                  "clearCoatRoughnessApart");
    settings.parameter("clearCoatNormalScale", coat.normalScale);
    settings.vectorMap("clearCoatNormal", "hasClearCoatNormalMap", coat.normal, vertices);
}

void setSheen(Settings& settings, assets::SheenData const& sheen) {
    if (!sheen.isUsed()) return;
    settings.feature("hasSheen");
    settings.parameter("sheenColor", sheen.color);
    settings.parameter("sheenRoughness", sheen.roughness);
    settings.maps("sheen", "hasSheenColorMap", "hasSheenRoughnessMap", sheen.maps, "sheenRoughness",
                  "sheenRoughnessApart");
}

void setSpecular(Settings& settings, MaterialData const& material) {
    if (material.ior != 1.5f || material.isIorAnimated) {
        settings.feature("hasIor");
        settings.parameter("ior", material.ior);
    }
    if (!material.specular.isUsed()) return;
    settings.feature("hasSpecular");
    settings.parameter("specularFactor", material.specular.factor);
    settings.parameter("specularColorFactor", material.specular.color);
    settings.maps("specular", "hasSpecularColorMap", "hasSpecularFactorMap", material.specular.maps, "specularFactor",
                  "specularFactorApart");
}

void setAnisotropy(Settings& settings, assets::AnisotropyData const& anisotropy, GltfVertices const& vertices) {
    if (!anisotropy.isUsed()) return;
    settings.feature("hasAnisotropy");
    settings.parameter("anisotropyStrength", anisotropy.strength);
    const float angle = anisotropy.rotationRadians;
    settings.parameter("anisotropyRotation", float2(elementary::cos(angle), elementary::sin(angle)));
    settings.vectorMap("anisotropy", "hasAnisotropyMap", anisotropy.map, vertices);
}

void setIridescence(Settings& settings, assets::IridescenceData const& film) {
    if (!film.isUsed()) return;
    settings.feature("hasIridescence");
    settings.parameter("iridescence", film.factor);
    settings.parameter("iridescenceIor", film.ior);
    settings.parameter("iridescenceThickness", float2(film.thicknessMinNanometers, film.thicknessMaxNanometers));
    settings.maps("iridescence", "hasIridescenceMap", "hasIridescenceThicknessMap", film.maps, "iridescenceThickness",
                  "iridescenceThicknessApart");
}

void setDiffuseTransmission(Settings& settings, assets::DiffuseTransmissionData const& data) {
    if (!data.isUsed()) return;
    settings.feature("hasDiffuseTransmission");
    settings.parameter("diffuseTransmission", data.factor);
    settings.parameter("diffuseTransmissionColor", data.color);
    settings.maps("diffuseTransmission", "hasDiffuseTransmissionColorMap", "hasDiffuseTransmissionMap", data.maps,
                  "diffuseTransmissionFactor", "diffuseTransmissionFactorApart");
}

/// `scatters`: a solid, though light may enter it by diffuse transmission alone.
void setTransmission(Settings& settings, assets::TransmissionData const& data, bool scatters, float scale) {
    if (!data.isUsed() && !scatters) return;
    settings.parameter("transmission", data.factor);
    settings.maps("transmission", "hasTransmissionMap", "hasThicknessMap", data.maps, "thickness", "thicknessApart");
    if (!data.isSolid() && !scatters) return;
    settings.parameter("thickness", std::min(data.thicknessMeters * scale, kMaxHalf));
    if (data.dispersion > 0 || data.isDispersionAnimated) {
        settings.feature("hasDispersion");
        settings.parameter("dispersion", data.dispersion);
    }
    const bool isClear = std::isinf(data.attenuationDistanceMeters) || data.attenuationColor == float3(1.0f);
    if (isClear && !data.isAbsorptionAnimated) return;
    const float3 absorption =
            isClear ? float3(0.0f)
                    : shader::lib::absorptionAtDistance(data.attenuationColor, data.attenuationDistanceMeters);
    settings.feature("hasAbsorption");
    settings.parameter("absorption", glm::min(absorption, float3(kMaxHalf)));
}

void setLight(Settings& settings, assets::LightMapData const& light) {
    if (!light.isUsed()) return;
    settings.parameter("lightIntensity", light.intensityLux);
    settings.map("light", "hasLightMap", light.map);
}

void setAll(Settings& settings, MaterialData const& material, GltfVertices const& vertices, float scale) {
    setCore(settings, material, vertices);
    if (material.unlit) return;
    if (!vertices.hasNormals) {
        settings.feature("hasEmission");
        return setEmission(settings, material);
    }
    material.specularGlossiness ? setSpecularGlossiness(settings, *material.specularGlossiness)
                                : setMetallicRoughness(settings, material);
    setCommonMaps(settings, material, vertices);
    if (material.specularGlossiness) return;
    setLight(settings, material.light); // before layers, whose maps are left out first
    setClearCoat(settings, material.clearCoat, vertices);
    setSheen(settings, material.sheen);
    setSpecular(settings, material);
    setAnisotropy(settings, material.anisotropy, vertices);
    setIridescence(settings, material.iridescence);
    setDiffuseTransmission(settings, material.diffuseTransmission);
    setTransmission(settings, material.transmission, material.scatters(), scale);
    if (!material.scatters()) return;
    settings.parameter("multiscatterColor", material.volumeScatter.color);
    settings.parameter("scatterAnisotropy", material.volumeScatter.anisotropy);
    settings.map("multiscatter", "hasMultiscatterMap", material.volumeScatter.map);
}

} // namespace

GltfVertices verticesOf(assets::PrimitiveData const& primitive) {
    return { primitive.hasColor, primitive.hasNormals, primitive.hasTangents, primitive.tangentBasis };
}

GltfMaterialSettings settingsOf(MaterialData const& material, GltfVertices const& vertices, float scale,
                                size_t maxMaps) {
    GltfMaterialSettings all{ .package = withSuffix(familyOf(material, vertices), material.alphaMode) };
    Settings settings(all, maxMaps);
    setAll(settings, material, vertices, scale);
    return all;
}

void useSections(GltfMaterialSettings& settings) {
    constexpr std::string_view kGltf = "gltf_", kLit = "lit_", kOpaque = "_opaque";
    std::string_view rest = std::string_view(settings.package).substr(kGltf.size());
    std::string package = "gltf_section_";
    if (rest.starts_with(kLit)) {
        package += "layered_";
        rest.remove_prefix(kLit.size());
    }
    const bool isOpaque = rest.ends_with(kOpaque) || rest == kOpaque.substr(1);
    package += rest.substr(0, isOpaque ? rest.size() - kOpaque.size() + 1 : rest.size());
    if (isOpaque) {
        package += "masked";
        settings.parameters.push_back({ "_maskThreshold", -1.0f });
    }
    settings.package = std::move(package);
}

void readParameters(MaterialData const& material, GltfVertices const& vertices, float scale,
                    GltfParameters& parameters) {
    parameters.clear();
    Settings settings(parameters);
    setAll(settings, material, vertices, scale);
}

} // namespace filament_core
