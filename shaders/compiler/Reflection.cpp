// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Reflection.h"

#include <algorithm>
#include <array>

namespace filament::shader {
namespace {

const char* typeName(ParameterType type) {
    static constexpr std::array kNames{ "bool",           "bool2",       "bool3",    "bool4",     "float",
                                        "float2",         "float3",      "float4",   "int",       "int2",
                                        "int3",           "int4",        "uint",     "uint2",     "uint3",
                                        "uint4",          "float3x3",    "float4x4", "sampler2d", "sampler2dArray",
                                        "samplerCubemap", "subpassInput" };
    return kNames[static_cast<size_t>(type)];
}

const char* precisionName(Precision precision) {
    static constexpr std::array kNames{ "default", "low", "medium", "high" };
    return kNames[static_cast<size_t>(precision)];
}

/// Names are GLSL identifiers: nothing in them needs escaping.
std::string entry(Parameter const& parameter, Precision precision) {
    std::string text = fmt::format("    {{\n      \"name\": \"{}\",\n      \"type\": \"{}\",\n", parameter.name,
                                   typeName(parameter.type));
    if (isTexture(parameter.type)) {
        text += fmt::format("      \"format\": \"{}\",\n      \"precision\": \"{}\"\n",
                            parameter.format == SamplerFormat::Int ? "int" : "float", precisionName(precision));
    } else {
        text += fmt::format("      \"size\": \"{}\"\n", std::max(parameter.arraySize, 1u));
    }
    return text + "    }";
}

} // namespace

std::string parametersAsJson(MaterialDefinition const& definition) {
    std::string entries;
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter const& parameter = definition.package.parameters[i];
        if (parameter.name == kMaskThresholdParameter) continue; // the compiler's own
        entries += (entries.empty() ? "\n" : ",\n") + entry(parameter, definition.parameterSources[i].precision);
    }
    return fmt::format("{{\n  \"parameters\": [{}{}]\n}}\n", entries, entries.empty() ? "" : "\n  ");
}

} // namespace filament::shader
