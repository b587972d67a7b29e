// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Reflection.h"

#include <algorithm>
#include <array>

namespace filament_core::shader {
namespace {

const char* precisionName(Precision precision) {
    static constexpr std::array kNames{ "default", "low", "medium", "high" };
    return kNames[static_cast<size_t>(precision)];
}

const char* formatName(SamplerFormat format) {
    static constexpr std::array kNames{ "float", "int", "uint" };
    return kNames[static_cast<size_t>(format)];
}

/// Names are GLSL identifiers, so nothing needs escaping.
std::string entry(Parameter const& parameter) {
    std::string text = fmt::format("    {{\n      \"name\": \"{}\",\n      \"type\": \"{}\",\n", parameter.name,
                                   toString(parameter.type));
    if (isTexture(parameter.type)) {
        text += fmt::format("      \"format\": \"{}\",\n      \"precision\": \"{}\"\n", formatName(parameter.format),
                            precisionName(parameter.precision));
    } else {
        text += fmt::format("      \"size\": \"{}\"\n", std::max(parameter.arraySize, 1u));
    }
    return text + "    }";
}

} // namespace

std::string parametersAsJson(MaterialDefinition const& definition) {
    std::string entries;
    for (Parameter const& parameter : definition.package.parameters) {
        if (parameter.name == kMaskThresholdParameter || parameter.name == kDoubleSidedParameter) continue; // its own
        entries += (entries.empty() ? "\n" : ",\n") + entry(parameter);
    }
    return fmt::format("{{\n  \"parameters\": [{}{}]\n}}\n", entries, entries.empty() ? "" : "\n  ");
}

} // namespace filament_core::shader
