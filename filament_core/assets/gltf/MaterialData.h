// SPDX-License-Identifier: Apache-2.0
/// MaterialData: a glTF material as plain values: the core of glTF 2.0 and the extensions of materials.
///   Every extension is a struct whose defaults have no effect; isUsed() says whether the file uses it. Colours are
///   linear Rec. 709, factors are in the ranges of their specifications (the parser clamps them), and only maps of used
///   extensions are present.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/math/Math.h"
#include "filament_core/assets/files/NoIndex.h"

#include <filament_core/Sampler.h>

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace filament_core::assets {

/// KHR_texture_transform as its file gives it.
struct UvPlacement {
    float2 offset{ 0.0f };
    float rotationRadians = 0;
    float2 scale{ 1.0f };
};

/// uv' = (M * (u, v, 1)).xy with M = T * R * S. The extension's GLSL turns the other way than its text and its test
/// model (TextureTransformTest, the green markers); like every viewer we follow those: a positive angle turns the
/// image counter-clockwise about (0, 0), so a coordinate turns clockwise in the (u, v) plane.
float3x3 matrixFrom(UvPlacement const& placement);

/// A struct whose property a channel of KHR_animation_pointer changes is used, and its maps are, at any value: that is
/// what its `isAnimated` says.
struct TextureRef {
    uint32_t image = kNone; ///< into ModelData::images; kNone: the factor alone
    Sampler sampler{};
    uint32_t uvSet = 0;           ///< 0 to 3
    float3x3 uvTransform{ 1.0f }; ///< KHR_texture_transform as uv' = (M * (u, v, 1)).xy
    bool hasTransform = false;
    bool isAnimated = false;  ///< `placement` changes; hasTransform is true then
    bool hasVariance = false; ///< of normals: alpha is what their levels average away (image/NormalVariance.h)
    UvPlacement placement{};  ///< of uvTransform
};

/// The texture coordinates that the tangents of a primitive follow.
struct TangentBasis {
    uint32_t uvSet = 0;
    std::array<float, 4> turn{ 1, 0, 0, 1 }; ///< columns of the matrix that the coordinates are multiplied by
    auto operator<=>(TangentBasis const&) const = default;
};

/// The linear part of the map's transform as a TangentBasis has it: the identity unless it turns or mirrors. Scales
/// alone change no direction.
std::array<float, 4> turnOf(TextureRef const& map);

/// Where the vectors of a map (normals, directions) point: in which frame their x and y are.
enum class MapFrame : uint8_t {
    Vertex,  ///< that of the vertices: the tangents follow the map's own coordinates
    Turned,  ///< that of the vertices, turned by the map's transform
    Derived, ///< of other texture coordinates: from their gradient over the surface
};
MapFrame frameOf(TextureRef const& map, TangentBasis const& basis);

/// Two maps of an extension with disjoint channels. They are in one texture if that is what the file has, or if they
/// are read alike and of one size: then the loader packs them (TexturePacking.h).
struct TexturePair {
    TextureRef texture;
    bool hasFirst = false, hasSecond = false; ///< otherwise its channels have no meaning
    TextureRef second{};                      ///< has an image: the second map has this texture of its own

    bool isApart() const { return second.image != kNone; }
};

enum class AlphaMode : uint8_t { Opaque, Mask, Blend };

/// KHR_materials_clearcoat.
struct ClearCoatData {
    float factor = 0, roughness = 0;
    float normalScale = 1;
    TexturePair maps; ///< red: factor; green: roughness
    TextureRef normal;
    bool isAnimated = false;
    bool isUsed() const { return factor > 0 || isAnimated; }
};

/// KHR_materials_sheen.
struct SheenData {
    float3 color{ 0.0f };
    float roughness = 0;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: roughness
    bool isAnimated = false;
    bool isUsed() const { return color != float3(0.0f) || isAnimated; }
};

/// KHR_materials_specular.
struct SpecularData {
    float3 color{ 1.0f }; ///< may exceed 1
    float factor = 1;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: factor
    bool hasTexture = false;
    bool isAnimated = false;
    bool isUsed() const { return factor != 1 || color != float3(1.0f) || hasTexture || isAnimated; }
};

/// KHR_materials_anisotropy.
struct AnisotropyData {
    float strength = 0;
    float rotationRadians = 0; ///< counter-clockwise from the tangent
    TextureRef map;            ///< red, green: direction from [-1, 1]; blue: strength
    bool isAnimated = false;
    bool isUsed() const { return strength > 0 || isAnimated; }
};

/// EXT_materials_bump.
struct BumpData {
    float factor = 1; ///< metres of world space for a height of 1; negative: dents
    TextureRef map;   ///< red: height
    bool isAnimated = false;
    bool isUsed() const { return factor != 0 || isAnimated; }
};

/// KHR_materials_iridescence.
struct IridescenceData {
    float factor = 0;
    float ior = 1.3f;
    float thicknessMinNanometers = 100, thicknessMaxNanometers = 400; ///< without a map: the maximum
    TexturePair maps;                                                 ///< red: factor; green: from minimum to maximum
    bool isAnimated = false;
    bool isUsed() const { return factor > 0 || isAnimated; }
};

/// KHR_materials_transmission, with KHR_materials_volume and KHR_materials_dispersion, which refine it.
struct TransmissionData {
    float factor = 0;
    float thicknessMeters = 0; ///< in the space of the mesh; 0: thin walls, which neither absorb nor disperse
    float3 attenuationColor{ 1.0f };
    float attenuationDistanceMeters = std::numeric_limits<float>::infinity(); ///< in the space of the file's scene
    float dispersion = 0;                                                     ///< 20 over the Abbe number
    TexturePair maps;                                                         ///< red: factor; green: thickness
    bool isAnimated = false, isThicknessAnimated = false, isAbsorptionAnimated = false, isDispersionAnimated = false;
    bool isUsed() const { return factor > 0 || isAnimated; }
    bool isSolid() const { return isUsed() && (thicknessMeters > 0 || isThicknessAnimated); }
};

/// KHR_materials_diffuse_transmission.
struct DiffuseTransmissionData {
    float3 color{ 1.0f };
    float factor = 0;
    TexturePair maps; ///< RGB: colour (sRGB); alpha: factor. None if transmission is also used
    bool isAnimated = false;
    bool isUsed() const { return factor > 0 || isAnimated; }
};

/// KHR_materials_volume_scatter: what scatters light inside the volume, whose attenuation it splits into absorption and
/// scattering.
struct VolumeScatterData {
    float3 color{ 0.0f }; ///< multi-scatter albedo: of a body so thick that no light crosses it
    float anisotropy = 0; ///< mean cosine of the angle by which light turns, (-1, 1); > 0: forwards
    TextureRef map;       ///< RGB: colour (sRGB)
    bool isAnimated = false;
    bool isUsed() const { return color != float3(0.0f) || isAnimated; }
};

/// FILAMENT_lightmap: baked light (docs/baking.md).
struct LightMapData {
    TextureRef map;              ///< RGB: irradiance over `intensityLux`; alpha: part of the sky that is seen
    float intensityLux = 1;      ///< >= 0
    bool hasDirectLight = false; ///< of lamps, which must then not light the surface again
    bool isUsed() const { return map.image != kNone; }
};

/// KHR_materials_pbrSpecularGlossiness: replaces metallic and roughness; the base colour is the diffuse colour.
struct SpecularGlossinessData {
    float3 specularFactor{ 1.0f };
    float glossinessFactor = 1;
    TextureRef map; ///< RGB: specular colour (sRGB); alpha: glossiness
};

/// Of scatterAnisotropy, whose range is open.
inline constexpr float kMaxScatterAnisotropy = 0.999f;

/// Stands for the value 0 of KHR_materials_ior: so high that everything is reflected.
inline constexpr float kOpaqueIor = 65504;

struct MaterialData {
    std::string name;
    float4 baseColorFactor{ 1.0f };
    float metallicFactor = 1, roughnessFactor = 1;
    float normalScale = 1, occlusionStrength = 1;
    float3 emissiveFactor{ 0.0f };
    float emissiveStrength = 1; ///< KHR_materials_emissive_strength: multiplies emissiveFactor
    TextureRef baseColor, metallicRoughness, normal, occlusion, emissive;
    bool hasBentNormals = false; ///< FILAMENT_bent_normal: in green and blue of the occlusion map (docs/baking.md)
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    BumpData bump;

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
    VolumeScatterData volumeScatter;
    LightMapData light;

    bool isAnimated = false, isIorAnimated = false; ///< KHR_animation_pointer: any property; the index of refraction

    /// Light scatters inside: it enters a volume that attenuates it, and not all of it is absorbed.
    bool scatters() const;
};

} // namespace filament_core::assets
