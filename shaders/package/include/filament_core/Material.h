// SPDX-License-Identifier: Apache-2.0
/// Describes a compiled material: its properties, parameters, constants and variants, as declared in its .mat file.
/// Plain values.
///   Names   those of the materials guide, chapter 4; table numbers refer to the guide.
///   Thread  any.   Memory: what is listed.   Fails: never.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace filament_core {

enum class MaterialDomain : uint8_t { Surface, PostProcess };
enum class ShadingModel : uint8_t { Unlit, Lit, Subsurface, Cloth, SpecularGlossiness };
enum class Blending : uint8_t { Opaque, Masked, Transparent, Fade, Add, Multiply, Screen, Custom };
enum class TransparencyMode : uint8_t { Default, TwoPassesOneSide, TwoPassesTwoSides };
enum class Culling : uint8_t { None, Front, Back, FrontAndBack };

// clang-format off
/// Type of a parameter (table 14).
enum class ParameterType : uint8_t {
    Bool, Bool2, Bool3, Bool4, Float, Float2, Float3, Float4, Int, Int2, Int3, Int4, Uint, Uint2, Uint3, Uint4,
    Float3x3, Float4x4,                          ///< std140 columns of 16 bytes
    Sampler2D, Sampler2DArray, SamplerCube, SubpassInput, SamplerCubeArray, Sampler2DMS, Sampler3D,
};
// clang-format on
/// The guide's spelling: "float3", "samplerCubemap".
const char* toString(ParameterType type);

enum class SamplerFormat : uint8_t { Float, Int, Uint };
enum class Precision : uint8_t { Default, Low, Medium, High };

/// A set of features that scene and view may request of a material, with the names of variantFilter (4.2.6).
enum class VariantSet : uint16_t {
    None = 0,
    DirectionalLighting = 1,
    DynamicLighting = 2,
    ShadowReceiver = 4,
    Skinning = 8,
    Fog = 16,
    Vsm = 32,
    Ssr = 64,
    Stereo = 128,
    All = 255,
};
constexpr VariantSet operator|(VariantSet a, VariantSet b) {
    return static_cast<VariantSet>(static_cast<uint16_t>(a) | static_cast<uint16_t>(b));
}
constexpr VariantSet operator&(VariantSet a, VariantSet b) {
    return static_cast<VariantSet>(static_cast<uint16_t>(a) & static_cast<uint16_t>(b));
}
constexpr bool isSubset(VariantSet part, VariantSet of) { return (part & of) == part; }
/// "directionalLighting, fog"; "none" for the empty set.
std::string toString(VariantSet variants);

struct ParameterDescription {
    std::string name;
    ParameterType type = ParameterType::Float;
    uint32_t arraySize = 0; ///< 0: not an array
    Precision precision = Precision::Default;
    SamplerFormat format = SamplerFormat::Float; ///< samplers: the type that a fetch returns
    friend bool operator==(ParameterDescription const&, ParameterDescription const&) = default;
};

struct ConstantDescription {
    std::string name;
    std::variant<bool, int32_t, float> defaultValue{};
    std::variant<bool, int32_t, float> value{}; ///< the value that the material was loaded with
    friend bool operator==(ConstantDescription const&, ConstantDescription const&) = default;
};

/// `parameters` and `constants` in the order of the file.
struct MaterialDescription {
    std::string name;
    MaterialDomain domain = MaterialDomain::Surface;
    ShadingModel shading = ShadingModel::Lit;
    Blending blending = Blending::Opaque;
    TransparencyMode transparency = TransparencyMode::Default;
    Culling culling = Culling::Back;
    uint32_t featureLevel = 1; ///< 1 to 3
    float maskThreshold = 0;   ///< of blending masked, in [0, 1]
    bool doubleSided = false, colorWrite = true, depthWrite = true, depthCulling = true, alphaToCoverage = false;
    uint32_t requiredAttributes = 0; ///< bit n: the material reads Attribute n of the geometry
    std::vector<ParameterDescription> parameters;
    std::vector<ConstantDescription> constants;
    std::vector<VariantSet> variants;       ///< the variants in the package
    VariantSet filtered = VariantSet::None; ///< variants that the material was compiled without
    std::vector<std::string> terms;         ///< members of MaterialInputs that its code sets; each of them has a cost

    ParameterDescription const* findParameter(std::string_view parameter) const;
};

} // namespace filament_core
