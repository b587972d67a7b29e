// SPDX-License-Identifier: Apache-2.0
/// MaterialPackage: a compiled material as plain values, and its file form.
///   Format  own, little-endian: magic, version, 64-bit checksum, sections with lengths (unknown sections are skipped).
///           Byte-identical for equal content; documented in docs/package-format.md.
///   Fails   readPackage(): Corrupt or Unsupported with the reason, for any bytes; never crashes, and never allocates
///           more than a small multiple of the input.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"

#include <filament_core/Material.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

using filament_core::Blending;
using filament_core::Culling;
using filament_core::MaterialDomain;
using filament_core::ParameterType;
using filament_core::Precision;
using filament_core::SamplerFormat;
using filament_core::ShadingModel;
using filament_core::TransparencyMode;

enum class PostLightingBlending : uint8_t { Opaque, Transparent, Add, Multiply, Screen };
enum class VertexDomain : uint8_t { Object, World, View, Device };
enum class Interpolation : uint8_t { Smooth, Flat };
enum class RefractionMode : uint8_t { None, Cubemap, ScreenSpace };
enum class RefractionType : uint8_t { Solid, Thin };
enum class Reflections : uint8_t { Default, ScreenSpace };
enum class MaterialQuality : uint8_t { Default, Low, Normal, High };

bool isTexture(ParameterType type); ///< samplers and subpass inputs

struct Parameter {
    std::string name;
    ParameterType type = ParameterType::Float;
    uint32_t arraySize = 0;                      ///< 0: not an array
    uint32_t offset = 0;                         ///< bytes in the MaterialParams block; textures: 0
    uint8_t binding = 0;                         ///< textures: binding in kGroupMaterial
    SamplerFormat format = SamplerFormat::Float; ///< textures: the type that a fetch returns
    /// Textures: ids of bool constants; the texture is read only where one of them is true. Empty: always.
    std::vector<uint32_t> usedIf{};
    bool isBound = true;       ///< not in the file: false after removeUnusedTextures() (RemoveUnusedTextures.h)
    bool currentPixel = false; ///< a Sampler2D that is read only at the pixel being written; see kVariantMerged
    Precision precision = Precision::Default; ///< as the author specified
    friend bool operator==(Parameter const&, Parameter const&) = default;
};

struct Constant {
    std::string name;
    uint32_t id = 0; ///< specialisation id, the same on both APIs
    backend::ConstantValue::Type type = backend::ConstantValue::Type::Bool;
    uint32_t defaultBits = 0;
    friend bool operator==(Constant const&, Constant const&) = default;
};

/// Features that scene and view may request of a material; a set of bits is a variant key. The first eight are the
/// names of variantFilter (materials guide, 4.2.6). Bits marked * are reserved: nothing requests them yet.
enum VariantBit : uint16_t {
    kVariantSun = 1,            ///< directionalLighting
    kVariantPunctual = 2,       ///< dynamicLighting
    kVariantShadowReceiver = 4, ///< shadowReceiver: lights are shadowed
    kVariantSkinning = 8,       ///< skinning: the vertex stage applies skins and morph targets
    kVariantFog = 16,           ///< *
    kVariantVsm = 32,     ///< vsm: in no key; filtered, nothing falls on the material with the filters vsm and evsm
    kVariantSsr = 64,     ///< *
    kVariantStereo = 128, ///< *
    kVariantHalf = 256,   ///< lit in 16 bits, for materials with halfPrecision; selected by Quality
    kVariantMerged = 512, ///< for materials with currentPixel parameters: they are subpass inputs, not textures
    kVariantDepth = 1024, ///< depth alone, for shadow maps: no light, no colour; combined with kVariantSkinning only
    /// Motion vectors; combined with kVariantSkinning only. In materials that place their
    /// vertices themselves; all others are drawn with that of the engine's material `motion`.
    kVariantMotion = 2048,
    kVariantDebug =
            4096, ///< debugViews: one of the material's own values, not lit; combined with kVariantSkinning only
};
inline constexpr uint16_t kAllVariantBits = 8191;

/// Bits that choose what one fragment stage computes, instead of a stage of their own: the specialisation constant
/// `variant_<name>` of surfaces is 1 if the key has the bit, and 0 otherwise.
struct VariantConstant {
    const char* name;
    uint16_t bit;
    uint32_t id; ///< behind those of QualityConstantId
};
inline constexpr std::array kVariantConstants{ VariantConstant{ "sun", kVariantSun, 1100 },
                                               VariantConstant{ "lightList", kVariantPunctual, 1101 },
                                               VariantConstant{ "shadows", kVariantShadowReceiver, 1102 } };
inline constexpr uint16_t kVariantConstantBits = kVariantSun | kVariantPunctual | kVariantShadowReceiver;
/// The values for a variant, in the order of kVariantConstants.
std::array<backend::ConstantValue, kVariantConstants.size()> variantConstants(uint16_t key);

/// For custom blending: the weights of the material's result and of the existing colour.
struct BlendFunction {
    backend::BlendFactor sourceColor = backend::BlendFactor::One, sourceAlpha = backend::BlendFactor::One;
    backend::BlendFactor targetColor = backend::BlendFactor::Zero, targetAlpha = backend::BlendFactor::Zero;
    friend bool operator==(BlendFunction const&, BlendFunction const&) = default;
};

/// The code of a stage in both languages; a language that was not compiled is empty.
struct StageCode {
    std::vector<uint32_t> spirv;
    std::string essl;
    friend bool operator==(StageCode const&, StageCode const&) = default;
};

/// Variants, and copies of packages, share code, which is immutable: a lit material has one fragment stage for all
/// sets of lights. Never null.
using SharedStage = std::shared_ptr<const StageCode>;
SharedStage sharedStage(StageCode code);

struct Variant {
    uint16_t key = 0;
    SharedStage vertex = sharedStage({}), fragment = sharedStage({});
    /// Compares the code, not where it is.
    friend bool operator==(Variant const& a, Variant const& b) {
        return a.key == b.key && *a.vertex == *b.vertex && *a.fragment == *b.fragment;
    }
};

struct MaterialPackage {
    std::string name;
    MaterialDomain domain = MaterialDomain::Surface;
    ShadingModel shading = ShadingModel::Lit;
    Blending blending = Blending::Opaque;
    BlendFunction blendFunction; ///< of Blending::Custom
    PostLightingBlending postLightingBlending = PostLightingBlending::Transparent;
    TransparencyMode transparency = TransparencyMode::Default;
    Culling culling = Culling::Back;
    VertexDomain vertexDomain = VertexDomain::Object;
    Interpolation interpolation = Interpolation::Smooth;
    RefractionMode refractionMode = RefractionMode::None;
    RefractionType refractionType = RefractionType::Solid;
    Reflections reflections = Reflections::Default;
    MaterialQuality quality = MaterialQuality::Default;
    uint8_t featureLevel = 1; ///< 1 to 3
    bool doubleSided = false;
    bool colorWrite = true, depthWrite = true, depthCulling = true;
    bool alphaToCoverage = false; ///< if there is more than one sample
    bool instanced = false;
    bool vertexDomainDeviceJittered = false;
    bool shadowMultiplier = false, transparentShadow = false;
    bool depthReadsParameters = false; ///< depth is not that of the mesh alone: vertex block, mask, discard, offset
    bool readsFrame = false;           ///< its code reads the time or globals of the view
    bool sectionPlanes = false;        ///< View::section cuts it
    float maskThreshold = 0.4f;
    uint16_t filteredVariants = 0;   ///< VariantBits that the material was compiled without
    uint32_t requiredAttributes = 0; ///< bit n: the material reads AttributeLocation n; skins are not included
    uint32_t uniformBytes = 0;       ///< size of the MaterialParams block, a multiple of 16; 0: none
    std::vector<Parameter> parameters;
    std::vector<Constant> constants;
    std::vector<std::string> terms;  ///< members of MaterialInputs that the code sets; the others cost nothing
    backend::ProgramLayout layout{}; ///< of variant 0; programLayout() knows the others
    std::vector<Variant> variants;   ///< ascending by key
    friend bool operator==(MaterialPackage const&, MaterialPackage const&) = default;

    Variant const* findVariant(uint32_t key) const;
    Parameter const* findParameter(std::string_view name) const;
    Constant const* findConstant(std::string_view name) const;
    bool hasTextures() const; ///< among its parameters
};

/// Whether light passes through its surfaces: with Quality::coloredShadows its shadows have colours.
inline bool transmitsLight(MaterialPackage const& package) {
    const bool isModelled = package.shading == ShadingModel::Lit || package.shading == ShadingModel::SpecularGlossiness;
    return isModelled && package.refractionMode != RefractionMode::None;
}

/// Whether Quality::transparency may compose its surfaces without sorting them, if they test depth and leave none: they
/// are placed in the scene, cover their background, have no depth pass of their own, and do not refract.
inline bool blendsInAnyOrder(MaterialPackage const& package) {
    const bool covers = package.blending == Blending::Transparent || package.blending == Blending::Fade;
    const bool stands = package.vertexDomain == VertexDomain::Object || package.vertexDomain == VertexDomain::World;
    return covers && stands && package.transparency != TransparencyMode::TwoPassesOneSide &&
           package.refractionMode != RefractionMode::ScreenSpace;
}

/// Name of the parameter that holds the mask threshold of masked materials; its default is package.maskThreshold.
inline constexpr std::string_view kMaskThresholdParameter = "_maskThreshold";
/// Name of the bool that says whether back faces are lit as front faces; its default is MaterialPackage::doubleSided.
inline constexpr std::string_view kDoubleSidedParameter = "_doubleSided";

Result<MaterialPackage> readPackage(std::span<const std::byte> bytes);
std::vector<std::byte> writePackage(MaterialPackage const& package);

} // namespace filament_core::shader
