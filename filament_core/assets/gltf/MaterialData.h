// SPDX-License-Identifier: Apache-2.0
/// MaterialData: a glTF material as plain values: the core of glTF 2.0 and the KHR_materials extensions.
///   Every extension is a struct whose defaults change nothing; isUsed() says whether the file asks for more than that.
///   Colours are linear Rec. 709, factors lie in the ranges of their specifications (the parser clamps them), and only
///   maps of what is used are there.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/math/Math.h"
#include "filament_core/assets/files/NoIndex.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace filament::assets {

struct TextureRef {
    uint32_t image = kNone; ///< into ModelData::images; kNone: the factor alone
    backend::SamplerDesc sampler{};
    uint32_t uvSet = 0;           ///< 0 or 1
    float3x3 uvTransform{ 1.0f }; ///< KHR_texture_transform as uv' = (M * (u, v, 1)).xy
    bool hasTransform = false;
};

/// Two maps of an extension whose channels do not overlap, in one texture: where the file keeps them apart the loader
/// puts them together (TexturePacking.h).
struct TexturePair {
    TextureRef texture;
    bool hasFirst = false, hasSecond = false; ///< without it its channels mean nothing
};

enum class AlphaMode : uint8_t { Opaque, Mask, Blend };

/// KHR_materials_clearcoat.
struct ClearCoatData {
    float factor = 0, roughness = 0;
    float normalScale = 1;
    TexturePair maps; ///< red: factor; green: roughness
    TextureRef normal;
    bool isUsed() const { return factor > 0; }
};

/// KHR_materials_sheen.
struct SheenData {
    float3 color{ 0.0f };
    float roughness = 0;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: roughness
    bool isUsed() const { return color != float3(0.0f); }
};

/// KHR_materials_specular.
struct SpecularData {
    float3 color{ 1.0f }; ///< may exceed 1
    float factor = 1;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: factor
    bool hasTexture = false;
    bool isUsed() const { return factor != 1 || color != float3(1.0f) || hasTexture; }
};

/// KHR_materials_anisotropy.
struct AnisotropyData {
    float strength = 0;
    float rotationRadians = 0; ///< counter-clockwise from the tangent
    TextureRef map;            ///< red, green: direction from [-1, 1]; blue: strength
    bool isUsed() const { return strength > 0; }
};

/// KHR_materials_iridescence.
struct IridescenceData {
    float factor = 0;
    float ior = 1.3f;
    float thicknessMinNanometers = 100, thicknessMaxNanometers = 400; ///< without a map: the maximum
    TexturePair maps;                                                 ///< red: factor; green: minimum to maximum
    bool isUsed() const { return factor > 0; }
};

/// KHR_materials_transmission, and KHR_materials_volume and KHR_materials_dispersion, which refine it.
struct TransmissionData {
    float factor = 0;
    float thicknessMeters =
            0; ///< in the space of the mesh; 0: thin walls, and nothing below but dispersion's 0 matters
    float3 attenuationColor{ 1.0f };
    float attenuationDistanceMeters = std::numeric_limits<float>::infinity(); ///< in the space of the file's scene
    float dispersion = 0;                                                     ///< 20 over the Abbe number
    TexturePair maps;                                                         ///< red: factor; green: thickness
    bool isUsed() const { return factor > 0; }
    bool isSolid() const { return isUsed() && thicknessMeters > 0; }
};

/// KHR_materials_diffuse_transmission.
struct DiffuseTransmissionData {
    float3 color{ 1.0f };
    float factor = 0;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: factor. None where transmission is used, too
    bool isUsed() const { return factor > 0; }
};

/// KHR_materials_pbrSpecularGlossiness: takes the place of metallic and roughness; the base colour is its diffuse one.
struct SpecularGlossinessData {
    float3 specularFactor{ 1.0f };
    float glossinessFactor = 1;
    TextureRef map; ///< RGB: specular colour (sRGB); alpha: glossiness
};

/// What KHR_materials_ior allows as 0: so dense that everything is reflected.
inline constexpr float kOpaqueIor = 65504;

struct MaterialData {
    std::string name;
    float4 baseColorFactor{ 1.0f };
    float metallicFactor = 1, roughnessFactor = 1;
    float normalScale = 1, occlusionStrength = 1;
    float3 emissiveFactor{ 0.0f };
    float emissiveStrength = 1; ///< KHR_materials_emissive_strength: multiplies emissiveFactor
    TextureRef baseColor, metallicRoughness, normal, occlusion, emissive;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;

    // ---- at most one of the two; then none of those below is used
    bool unlit = false; ///< KHR_materials_unlit
    std::optional<SpecularGlossinessData> specularGlossiness;

    float ior = 1.5f; ///< KHR_materials_ior; [1, kOpaqueIor]
    ClearCoatData clearCoat;
    SheenData sheen;
    SpecularData specular;
    AnisotropyData anisotropy;
    IridescenceData iridescence;
    TransmissionData transmission;
    DiffuseTransmissionData diffuseTransmission;
};

} // namespace filament::assets
