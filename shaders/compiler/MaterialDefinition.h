// SPDX-License-Identifier: Apache-2.0
/// MaterialDefinition: the contents of a .mat file, checked and with defaults filled in, before any code is generated.
///   In      MaterialText (Jsonish.h). Out: plain values.
///   Thread  any. Fails: InvalidArgument with "file:line: reason": misspelt names with a suggestion, values out of
///           range, contradictory properties (DefinitionRules.h), more samplers than the feature level allows.
#pragma once

#include "shaders/compiler/Jsonish.h"
#include "shaders/package/Package.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::shader {

struct NamedAt {
    std::string name;
    SourcePosition at;
};

/// Data about a parameter that only the generated code needs; same order as MaterialPackage::parameters.
struct ParameterSource {
    SourcePosition at;
    std::vector<NamedAt> usedIf{}; ///< names of constants: Parameter::usedIf has their ids
    bool isExternal = false;       ///< written as samplerExternal: counts as two samplers
    std::string transformName{};   ///< the code's name of the matrix of its coordinates, here the identity
};

struct Variable {
    std::string name;
    Precision precision = Precision::Default;
    SourcePosition at;
};

/// What an effect writes: a colour attachment, or the depth.
struct EffectOutput {
    std::string name = "color";
    uint32_t components = 4; ///< floats
    bool isDepth = false;
    uint32_t location = 0; ///< of the colour attachment
    Precision precision = Precision::Default;
};

struct SpecularAntiAliasing {
    bool enabled = false;
    float variance = 0.15f;
    float threshold = 0.2f;
};

enum class SpecularAmbientOcclusion : uint8_t { None, Simple, BentNormals };
enum class ClothDistribution : uint8_t { Charlie, Ashikhmin };

/// A property that the author wrote, and its position.
struct GivenProperty {
    std::string name;
    SourcePosition at;
};

struct MaterialDefinition {
    MaterialPackage package; ///< the compiler adds attributes, layout and variants
    std::vector<ParameterSource> parameterSources;
    std::vector<Variable> variables;
    std::vector<EffectOutput> outputs; ///< of effects; none: one colour
    uint32_t requiredAttributes = 0;   ///< bit n: location n, from `requires`
    bool halfPrecision = false;        ///< also variants that are lit in 16 bits: kVariantHalf
    bool flipUv = true;
    bool fullScreenTriangle = false; ///< device domain: positions come from the vertex index, no attribute is read
    bool wideLines =
            false; ///< vertices are corners of segments, as makeLineQuads() (<filament_core/Lines.h>) gives them
    bool sizedPoints = false; ///< vertices are corners of points, as makePointQuads() (<filament_core/Points.h>) says
    bool clearCoatIorChange = true;
    bool multiBounceAmbientOcclusion = true; ///< the guide's default on desktops
    SpecularAmbientOcclusion specularAmbientOcclusion = SpecularAmbientOcclusion::Simple;
    bool customSurfaceShading = false;
    bool useDefaultDepthVariant = false; ///< depth alone is drawn without the vertex block
    ClothDistribution clothDistribution = ClothDistribution::Charlie;
    SpecularAntiAliasing specularAntiAliasing;
    std::vector<std::string> warnings{}; ///< "file:line: what is odd" of the material block
    std::vector<GivenProperty> given;    ///< in the order of the file
    std::optional<GlslBlock> vertex;
    GlslBlock fragment;
    std::string fileName;

    bool needsAttribute(uint32_t location) const { return (requiredAttributes >> location & 1) != 0; }
    /// The position of a property in the file; null: it has its default.
    SourcePosition const* find(std::string_view property) const;
    /// An error about a property, at its line; about the file if it has its default.
    Error errorAbout(std::string_view property, std::string const& message,
                     ErrorCode code = ErrorCode::InvalidArgument) const;
};

inline bool blends(Blending blending) { return blending != Blending::Opaque && blending != Blending::Masked; }
/// Of any shading model; unlit ones are an error.
inline bool refracts(MaterialDefinition const& definition) {
    return definition.package.refractionMode != RefractionMode::None;
}

inline constexpr size_t kMaxVariables = 5;

Result<MaterialDefinition> defineMaterial(MaterialText text, std::string_view fileName);

/// "directionalLighting" and the like -> the VariantBits that they stand for. InvalidArgument: an unknown name.
Result<uint16_t> variantBitsOfFilters(std::span<const std::string> names);
std::vector<std::string_view> variantFilterNames();

} // namespace filament_core::shader
