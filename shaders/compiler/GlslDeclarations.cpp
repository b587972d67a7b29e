// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslDeclarations.h"

#include "shaders/compiler/MaterialMembers.h"
#include "shaders/interface/ShaderInterface.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

namespace filament_core::shader {
namespace {

constexpr uint32_t kFirstVariableLocation = 5; // after those of shaders/material/varyings.glsl
constexpr uint32_t kInstanceIndexLocation = 9, kEndOfLocations = 15;

const char* glslType(ParameterType type) {
    // clang-format off
    static constexpr const char* kNames[] = {
        "bool", "bvec2", "bvec3", "bvec4", "float", "vec2", "vec3", "vec4", "int", "ivec2", "ivec3", "ivec4", "uint",
        "uvec2", "uvec3", "uvec4", "mat3", "mat4", "sampler2D", "sampler2DArray", "samplerCube", "subpassInput",
        "samplerCubeArray", "sampler2DMS", "sampler3D"
    };
    // clang-format on
    return kNames[static_cast<size_t>(type)];
}

/// Everything is highp unless the author requests less: on some devices mediump really is fp16.
const char* glslPrecision(Precision precision) {
    switch (precision) {
    case Precision::Low:
        return "lowp ";
    case Precision::Medium:
        return "mediump ";
    case Precision::High:
    case Precision::Default:
        return "";
    }
    return "";
}

std::string samplerType(Parameter const& parameter) {
    static constexpr const char* kPrefixes[] = { "", "i", "u" };
    return kPrefixes[static_cast<size_t>(parameter.format)] + std::string(glslType(parameter.type));
}

bool takesPrecision(ParameterType type) { return type > ParameterType::Bool4; }

void declareBlock(StageText& out, MaterialDefinition const& definition) {
    if (definition.package.uniformBytes == 0) return;
    out.line(fmt::format("layout(set = {}, binding = 0, std140) uniform MaterialParams {{", kGroupMaterial));
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter const& parameter = definition.package.parameters[i];
        if (isTexture(parameter.type)) continue;
        out.originate(definition.parameterSources[i].at);
        const std::string array = parameter.arraySize > 0 ? fmt::format("[{}]", parameter.arraySize) : "";
        const char* const precision = takesPrecision(parameter.type) ? glslPrecision(parameter.precision) : "";
        out.line(fmt::format("{}{} {}{};", precision, glslType(parameter.type), parameter.name, array));
    }
    out.line("} materialParams;");
}

void declareTextures(StageText& out, MaterialDefinition const& definition, uint16_t variantKey) {
    uint32_t attachment = 0;
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter parameter = definition.package.parameters[i];
        if (!isTexture(parameter.type)) continue;
        std::string index;
        if (isSubpassInput(parameter, variantKey)) {
            parameter.type = ParameterType::SubpassInput;
            index = fmt::format("input_attachment_index = {}, ", attachment++);
        }
        out.originate(definition.parameterSources[i].at);
        out.line(fmt::format("layout({}set = {}, binding = {}) uniform {}{} materialParams_{};", index, kGroupMaterial,
                             parameter.binding, glslPrecision(parameter.precision), samplerType(parameter),
                             parameter.name));
    }
}

std::string literal(Constant const& constant) {
    switch (constant.type) {
    case backend::ConstantValue::Type::Bool:
        return constant.defaultBits != 0 ? "true" : "false";
    case backend::ConstantValue::Type::Int:
        return fmt::format("{}", static_cast<int32_t>(constant.defaultBits));
    case backend::ConstantValue::Type::Float: {
        std::string text = fmt::format("{:.9g}", std::bit_cast<float>(constant.defaultBits));
        if (text.find_first_of(".e") == std::string::npos) text += ".0";
        return text;
    }
    }
    return "0";
}

void declareConstants(StageText& out, MaterialDefinition const& definition) {
    static constexpr const char* kTypes[] = { "bool", "int", "float" };
    for (Constant const& constant : definition.package.constants) {
        out.line(fmt::format("layout(constant_id = {}) const {} materialConstants_{} = {};", constant.id,
                             kTypes[static_cast<size_t>(constant.type)], constant.name, literal(constant)));
        out.define("materialConstant_" + constant.name, "materialConstants_" + constant.name);
    }
}

void declareConstant(StageText& out, QualityConstant const& constant) {
    out.line(fmt::format("layout(constant_id = {}) const int quality_{} = 0;", constant.id, constant.name));
}

} // namespace

void declareVariants(StageText& out) {
    for (VariantConstant const& constant : kVariantConstants)
        out.line(fmt::format("layout(constant_id = {}) const int variant_{} = 0;", constant.id, constant.name));
}

void declareQuality(StageText& out) {
    for (QualityConstant const& constant : kQualityConstants) {
        if (constant.id != kQualityMipBias) declareConstant(out, constant); // which texture_bias.glsl declares
    }
}

void declareUnlitQuality(StageText& out) {
    for (const uint32_t id : { uint32_t{ kQualityFog }, uint32_t{ kQualityTransparency } })
        declareConstant(out, *std::ranges::find(kQualityConstants, id, &QualityConstant::id));
}

void declareInterface(StageText& out, MaterialDefinition const& definition, uint16_t variantKey) {
    declareBlock(out, definition);
    declareTextures(out, definition, variantKey);
    declareConstants(out, definition);
}

bool isSubpassInput(Parameter const& parameter, uint16_t variantKey) {
    const bool isMerged = parameter.currentPixel && (variantKey & kVariantMerged) != 0;
    return isMerged || parameter.type == ParameterType::SubpassInput;
}

// 15 vectors are what OpenGL ES 3.1 has everywhere (MAX_VARYING_VECTORS).
std::vector<uint32_t> freeLocations(MaterialNeeds const& needs) {
    std::vector<uint32_t> locations;
    for (uint32_t i = kFirstVariableLocation; i < kEndOfLocations; ++i) {
        if (i != kInstanceIndexLocation || !needs.instanceIndex) locations.push_back(i);
    }
    return locations;
}

void declareVariables(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs) {
    const std::vector<uint32_t> locations = freeLocations(needs);
    for (uint32_t i = 0; i < definition.variables.size(); ++i) {
        Variable const& variable = definition.variables[i];
        out.originate(variable.at);
        out.line(fmt::format("layout(location = {}) INTERPOLATION VARYING {}vec4 variable_{};", locations[i],
                             glslPrecision(variable.precision), variable.name));
    }
}

std::vector<uint32_t> customLocations(MaterialDefinition const& definition, MaterialNeeds const& needs) {
    std::vector<uint32_t> locations = freeLocations(needs);
    locations.erase(locations.begin(), locations.begin() + static_cast<std::ptrdiff_t>(definition.variables.size()));
    return locations;
}

void declareCustomVaryings(StageText& out, MaterialDefinition const& definition, MaterialNeeds const& needs) {
    const std::vector<uint32_t> locations = customLocations(definition, needs);
    std::string write;
    size_t next = 0;
    for (uint32_t i = 0; i < 8; ++i) {
        if ((needs.fragmentCustoms >> i & 1) == 0) continue;
        out.line(
                fmt::format("layout(location = {}) INTERPOLATION VARYING vec4 vertex_custom{};", locations[next++], i));
        write += fmt::format("vertex_custom{0} = mesh_custom{0}; ", i);
    }
    out.define("MATERIAL_WRITE_CUSTOMS", write);
}

void declareOutputs(StageText& out, MaterialDefinition const& definition, uint32_t firstLocation) {
    const std::vector<EffectOutput> usual(1);
    std::string members, clear, write;
    for (EffectOutput const& output : definition.outputs.empty() ? usual : definition.outputs) {
        const std::string_view type = floatType(output.components);
        const std::string target = output.isDepth ? "gl_FragDepth" : "fragment_" + output.name;
        members += fmt::format("{} {}; ", type, output.name);
        clear += fmt::format("inputs.{} = {}; ", output.name, initialOutput(output.components));
        write += fmt::format("{} = inputs.{}; ", target, output.name);
        if (!output.isDepth)
            out.line(fmt::format("layout(location = {}) out {}{} {};", firstLocation + output.location,
                                 glslPrecision(output.precision), type, target));
    }
    out.define("POST_OUTPUT_MEMBERS", members);
    out.define("POST_CLEAR_OUTPUTS(inputs)", clear);
    out.define("POST_WRITE_OUTPUTS(inputs)", write);
}

void declareSurfaceOutputs(StageText& out, MaterialDefinition const& definition) {
    static constexpr const char* kPadding[] = { ", 0.0, 0.0, 1.0", ", 0.0, 1.0", ", 1.0", "" };
    std::string write;
    for (EffectOutput const& output : definition.outputs) {
        const std::string_view type = floatType(output.components);
        if (output.location == 0) { // declared by fragment_api.glsl, for every variant
            write += fmt::format("fragment_color = vec4(inputs.{}{}); ", output.name, kPadding[output.components - 1]);
            continue;
        }
        out.line(fmt::format("layout(location = {}) out {}{} fragment_output_{};", output.location,
                             glslPrecision(output.precision), type, output.name));
        write += fmt::format("fragment_output_{0} = inputs.{0}; ", output.name);
    }
    out.define("SURFACE_WRITE_OUTPUTS(inputs)", write);
}

void declareTransforms(StageText& out, MaterialDefinition const& definition) {
    for (ParameterSource const& source : definition.parameterSources) {
        if (!source.transformName.empty())
            out.line(fmt::format("const mat3 materialParams_{} = mat3(1.0);", source.transformName));
    }
}

void defineVariableMacros(StageText& out, MaterialDefinition const& definition) {
    std::string members, clear, write;
    for (Variable const& variable : definition.variables) {
        members += fmt::format("vec4 {}; ", variable.name);
        clear += fmt::format("inputs.{} = vec4(0.0); ", variable.name);
        write += fmt::format("variable_{0} = inputs.{0}; ", variable.name);
    }
    out.define("MATERIAL_VARIABLES_AS_MEMBERS", members);
    out.define("MATERIAL_CLEAR_VARIABLES(inputs)", clear);
    out.define("MATERIAL_WRITE_VARIABLES(inputs)", write);
}

} // namespace filament_core::shader
