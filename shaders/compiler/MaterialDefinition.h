// SPDX-License-Identifier: Apache-2.0
/// MaterialDefinition: what a .mat file says, checked and with defaults filled in, before any code is generated.
///   In      MaterialText (Jsonish.h). Out: plain values.
///   Thread  any. Fails: InvalidArgument with "file:line: reason" and a suggestion for misspelt names; Unsupported for
///           properties of the guide that this version does not have yet.
#pragma once

#include "shaders/compiler/Jsonish.h"
#include "shaders/package/Package.h"

#include <optional>
#include <string>
#include <vector>

namespace filament::shader {

enum class Precision : uint8_t { Default, Low, Medium, High };

/// What only the generated code needs to know of a parameter; same order as MaterialPackage::parameters.
struct ParameterSource {
    Precision precision = Precision::Default;
    SourcePosition at;
};

struct Variable {
    std::string name;
    Precision precision = Precision::Default;
    SourcePosition at;
};

struct SpecularAntiAliasing {
    bool enabled = false;
    float variance = 0.15f;
    float threshold = 0.2f;
};

struct MaterialDefinition {
    MaterialPackage package; ///< everything but attributes, layout and variants
    std::vector<ParameterSource> parameterSources;
    std::vector<Variable> variables;
    uint32_t requiredAttributes = 0; ///< bit n: location n, from `requires`
    uint8_t filteredVariants = 0;    ///< VariantBits that are never asked for
    bool halfPrecision = false;      ///< also variants that are lit in 16 bits: kVariantHalf
    bool flipUv = true;
    bool fullScreenTriangle = false; ///< device domain: positions come from the vertex index, no attribute is read
    SpecularAntiAliasing specularAntiAliasing;
    std::optional<GlslBlock> vertex;
    GlslBlock fragment;
    std::string fileName;
};

inline constexpr size_t kMaxVariables = 4;
/// Name of the parameter that holds the mask threshold of masked materials; its default is package.maskThreshold.
inline constexpr std::string_view kMaskThresholdParameter = "_maskThreshold";

Result<MaterialDefinition> defineMaterial(MaterialText text, std::string_view fileName);

/// "directionalLighting" and the like -> the variant bits that they stand for; 0 for filters of features that this
/// version does not have; nothing for an unknown name.
std::optional<uint8_t> variantBitsOfFilter(std::string_view name);
std::vector<std::string_view> variantFilterNames();

} // namespace filament::shader
