// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ParameterProperties.h"

#include "base/Suggest.h"
#include "shaders/compiler/GlslKeywords.h"
#include "shaders/compiler/GlslSuggestions.h"
#include "shaders/compiler/PropertyReader.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/ParameterLayout.h"

#include <algorithm>
#include <bit>
#include <charconv>

namespace filament_core::shader {
namespace {

constexpr uint32_t kMaxBlockBytes = 16384;  // every device offers this much
constexpr size_t kMaxParameterCount = 1024; // of a package (docs/package-format.md)
constexpr size_t kMaxConstantCount = 256;
constexpr size_t kMaxOutputs = 8;

using TypeName = std::pair<std::string_view, ParameterType>;
// clang-format off
constexpr TypeName kTypes[] = { { "bool", ParameterType::Bool }, { "bool2", ParameterType::Bool2 },
    { "bool3", ParameterType::Bool3 }, { "bool4", ParameterType::Bool4 }, { "float", ParameterType::Float },
    { "float2", ParameterType::Float2 }, { "float3", ParameterType::Float3 }, { "float4", ParameterType::Float4 },
    { "int", ParameterType::Int }, { "int2", ParameterType::Int2 }, { "int3", ParameterType::Int3 },
    { "int4", ParameterType::Int4 }, { "uint", ParameterType::Uint }, { "uint2", ParameterType::Uint2 },
    { "uint3", ParameterType::Uint3 }, { "uint4", ParameterType::Uint4 }, { "float3x3", ParameterType::Float3x3 },
    { "mat3", ParameterType::Float3x3 }, { "float4x4", ParameterType::Float4x4 }, { "mat4", ParameterType::Float4x4 },
    { "sampler2d", ParameterType::Sampler2D }, { "sampler2dArray", ParameterType::Sampler2DArray },
    { "samplerCubemap", ParameterType::SamplerCube }, { "samplerExternal", ParameterType::Sampler2D },
    { "samplerCubemapArray", ParameterType::SamplerCubeArray }, { "subpassInput", ParameterType::SubpassInput },
    { "sampler2dMS", ParameterType::Sampler2DMS }, { "sampler3d", ParameterType::Sampler3D } };
// clang-format on

/// The guide's name for a vector type of GLSL: float3 for vec3. Empty for other names.
std::string guideType(std::string_view glsl) {
    static constexpr std::pair<std::string_view, std::string_view> kPrefixes[] = {
        { "vec", "float" }, { "ivec", "int" }, { "uvec", "uint" }, { "bvec", "bool" }
    };
    for (auto const& [prefix, guides] : kPrefixes) {
        const bool isVector = glsl.size() == prefix.size() + 1 && glsl.starts_with(prefix);
        if (isVector) return std::string(guides) + glsl.back();
    }
    return {};
}

/// "float[9]" -> float, 9. The size stays 0 if it is no array.
Result<void> readType(JsonValue const& value, Parameter& out) {
    if (Result<void> isString = expectKind(value, JsonValue::Kind::String, "type"); !isString) return isString;
    JsonValue base = value;
    constexpr std::string_view kTimes = "\xC3\x97"; // the multiplication sign, which the guide prints in float3x3
    if (const size_t times = base.text.find(kTimes); times != std::string::npos)
        base.text.replace(times, kTimes.size(), 1, 'x');
    if (const size_t bracket = base.text.find('['); bracket != std::string::npos) {
        const char* const last = base.text.data() + base.text.size();
        const auto size = std::from_chars(base.text.data() + bracket + 1, last, out.arraySize);
        const bool isSize = size.ec == std::errc{} && std::string_view(size.ptr, last) == "]";
        if (!isSize || out.arraySize == 0 || out.arraySize > kMaxBlockBytes / 16) {
            return errorAt(value.at, fmt::format("\"{}\": an array size is a number from 1 to {}", value.text,
                                                 kMaxBlockBytes / 16));
        }
        base.text.resize(base.text.find_last_not_of(' ', bracket - 1) + 1); // "float [2]" is "float[2]"
    }
    if (const std::string guides = guideType(base.text); !guides.empty())
        return errorAt(value.at, fmt::format("'type' cannot be '{}'; did you mean '{}'?", base.text, guides));
    if (Result<void> known = readEnum(base, "type", kTypes, out.type); !known) return known;
    if (out.arraySize > 0 && isTexture(out.type))
        return errorAt(value.at, "samplers cannot be arrays; use sampler2dArray");
    return {};
}

Result<void> readFormat(JsonValue const& value, Parameter& out) {
    static constexpr std::pair<std::string_view, SamplerFormat> kFormats[] = {
        { "float", SamplerFormat::Float },
        { "int", SamplerFormat::Int },
        { "uint", SamplerFormat::Uint },
    };
    if (!isTexture(out.type) || out.type == ParameterType::SubpassInput)
        return errorAt(value.at, fmt::format("only samplers have a format, and '{}' is not a sampler", out.name));
    return readEnum(value, "format", kFormats, out.format);
}

/// Subpass inputs return vec4, so a parameter that may become one must do so, too.
Result<void> readCurrentPixel(JsonValue const& value, Parameter& out) {
    if (Result<void> done = readBool(value, "currentPixel", out.currentPixel); !done) return done;
    const bool isImage = out.type == ParameterType::Sampler2D && out.format == SamplerFormat::Float;
    if (isImage || !out.currentPixel) return {};
    return errorAt(value.at, fmt::format("only a sampler2d of format float can have currentPixel, and '{}' is not one",
                                         out.name));
}

/// Names of constants, which may be declared later: resolveUsedIf() looks them up.
Result<void> readUsedIf(JsonValue const& value, Parameter const& parameter, ParameterSource& out) {
    if (!isTexture(parameter.type) || parameter.type == ParameterType::SubpassInput || parameter.currentPixel)
        return errorAt(value.at,
                       fmt::format("usedIf is only for samplers that can be read anywhere, and '{}' is not one",
                                   parameter.name));
    const std::span<JsonValue const> items =
            value.kind == JsonValue::Kind::Array ? std::span<JsonValue const>(value.items) : std::span(&value, 1);
    for (JsonValue const& item : items) {
        if (Result<void> isName = expectKind(item, JsonValue::Kind::String, "usedIf"); !isName) return isName;
        out.usedIf.push_back({ item.text, item.at });
    }
    if (out.usedIf.empty()) return errorAt(value.at, "usedIf names at least one constant");
    return {};
}

Result<void> requireMember(JsonValue const& object, std::string_view key, std::string_view what,
                           JsonValue const*& out) {
    out = findMember(object, key);
    if (out) return {};
    return errorAt(object.at, fmt::format("a {} needs the field '{}'", what, key));
}

/// `name` and `type`, common to parameters and constants.
struct NamedEntry {
    std::string name;
    JsonValue const* type = nullptr;
};

Result<NamedEntry> readEntry(JsonValue const& item, std::span<const std::string_view> fields, std::string_view what,
                             std::vector<std::string>& warnings) {
    NamedEntry entry;
    JsonValue const* name = nullptr;
    Result<void> done = expectKind(item, JsonValue::Kind::Object, what);
    if (done) done = expectOnly(item, fields, what, warnings);
    if (done) done = requireMember(item, "name", what, name);
    if (done) done = requireMember(item, "type", what, entry.type);
    if (done) done = readIdentifier(*name, what, entry.name);
    if (!done) return done.error();
    return entry;
}

/// Members of blocks and structures have this name without a prefix.
Result<void> checkKeyword(JsonValue const& item, std::string_view what, std::string const& name) {
    const bool isType = std::ranges::count(parameterTypeNames(), name) > 0; // float3 is a macro
    if (!isGlslKeyword(name) && !isType) return {};
    return errorAt(item.at, fmt::format("{} \"{}\" is a word that GLSL reserves; choose another name", what, name));
}

/// Frames of a camera or a video: a 2D texture that the application fills. Drivers may keep one in two planes, and the
/// guide's budget counts it as two.
bool isExternal(JsonValue const& type) { return equalIgnoringCase(type.text, "samplerExternal"); }

constexpr std::string_view kParameterFields[] = { "type",         "name",        "precision",  "format",       "usedIf",
                                                  "currentPixel", "multisample", "filterable", "transformName" };
constexpr std::string_view kConstantFields[] = { "type", "name", "default" };
constexpr std::string_view kVariableFields[] = { "name", "precision" };
constexpr std::string_view kOutputFields[] = { "name", "target", "type", "precision", "location", "qualifier" };

/// What programs that sample textures say of them.
Result<void> readSampling(JsonValue const& item, Parameter& out) {
    bool isMultisampled = false, isFilterable = false;
    JsonValue const *const samples = findMember(item, "multisample"), *const filter = findMember(item, "filterable");
    for (JsonValue const* value : { samples, filter }) {
        if (value && !isTexture(out.type))
            return errorAt(value->at,
                           fmt::format("only samplers are multisampled or filterable, and '{}' is not one", out.name));
    }
    Result<void> done = samples ? readBool(*samples, "multisample", isMultisampled) : Result<void>{};
    if (done && filter) done = readBool(*filter, "filterable", isFilterable);
    if (!done) return done;
    if (isFilterable && out.format != SamplerFormat::Float)
        return errorAt(filter->at,
                       fmt::format("'{}' has whole numbers, which no device filters; leave out filterable", out.name));
    if (!isMultisampled) return {};
    const bool isImage = out.type == ParameterType::Sampler2D || out.type == ParameterType::Sampler2DMS;
    if (!isImage || out.currentPixel)
        return errorAt(samples->at,
                       fmt::format("only a sampler2d without currentPixel can be multisampled, and '{}' is not one",
                                   out.name));
    out.type = ParameterType::Sampler2DMS;
    return {};
}

/// `materialParams.NAME` in the code. The images of this engine are not turned: the matrix is a constant.
Result<void> readTransformName(JsonValue const& item, MaterialDefinition const& definition, ParameterSource& out) {
    JsonValue const* name = findMember(item, "transformName");
    if (!name) return {};
    if (!out.isExternal) return errorAt(name->at, "transformName is for parameters of the type samplerExternal");
    Result<void> done = readIdentifier(*name, "transformName", out.transformName);
    if (done && definition.package.findParameter(out.transformName))
        return errorAt(name->at, fmt::format("there are two parameters '{}'", out.transformName));
    return done;
}

Result<void> readParameter(JsonValue const& item, MaterialDefinition& out) {
    Result<NamedEntry> entry = readEntry(item, kParameterFields, "parameter", out.warnings);
    if (!entry) return entry.error();
    if (out.package.findParameter(entry->name) ||
        std::ranges::count(out.parameterSources, entry->name, &ParameterSource::transformName) > 0)
        return errorAt(item.at, fmt::format("there are two parameters '{}'", entry->name));
    Parameter parameter{ .name = entry->name };
    Result<void> done = readType(*entry->type, parameter);
    if (JsonValue const* precision = findMember(item, "precision"); done && precision)
        done = readPrecision(*precision, parameter.precision);
    if (JsonValue const* format = findMember(item, "format"); done && format) done = readFormat(*format, parameter);
    if (JsonValue const* own = findMember(item, "currentPixel"); done && own) done = readCurrentPixel(*own, parameter);
    if (done) done = readSampling(item, parameter);
    ParameterSource source{ .at = item.at, .isExternal = isExternal(*entry->type) };
    if (done) done = readTransformName(item, out, source);
    if (JsonValue const* conditions = findMember(item, "usedIf"); done && conditions)
        done = readUsedIf(*conditions, parameter, source);
    if (done && !isTexture(parameter.type)) done = checkKeyword(item, "parameter", parameter.name);
    if (!done) return done;
    out.package.parameters.push_back(std::move(parameter));
    out.parameterSources.push_back(std::move(source));
    return {};
}

using ConstantType = backend::ConstantValue::Type;

Result<void> readDefault(JsonValue const& value, Constant& out) {
    if (out.type == ConstantType::Bool) {
        bool boolean = false;
        Result<void> done = readBool(value, "default", boolean);
        out.defaultBits = boolean;
        return done;
    }
    float number = 0;
    if (Result<void> done = readNumber(value, "default", -3e38f, 3e38f, number); !done) return done;
    if (out.type == ConstantType::Float) {
        out.defaultBits = std::bit_cast<uint32_t>(number);
        return {};
    }
    const auto integer = static_cast<int64_t>(std::clamp(value.number, -2147483648.0, 2147483647.0));
    if (static_cast<double>(integer) != value.number)
        return errorAt(value.at, "the default of an int is a 32-bit integer");
    out.defaultBits = static_cast<uint32_t>(static_cast<int32_t>(integer));
    return {};
}

Result<void> readConstant(JsonValue const& item, MaterialDefinition& out) {
    static constexpr std::pair<std::string_view, ConstantType> kConstantTypes[] = {
        { "bool", ConstantType::Bool },
        { "int", ConstantType::Int },
        { "float", ConstantType::Float },
    };
    Result<NamedEntry> entry = readEntry(item, kConstantFields, "constant", out.warnings);
    if (!entry) return entry.error();
    if (out.package.findConstant(entry->name)) {
        return errorAt(item.at, fmt::format("there are two constants '{}'", entry->name));
    }
    Constant constant{ .name = entry->name, .id = static_cast<uint32_t>(out.package.constants.size()) };
    Result<void> done = readEnum(*entry->type, "type", kConstantTypes, constant.type);
    if (JsonValue const* value = findMember(item, "default"); done && value) done = readDefault(*value, constant);
    if (!done) return done;
    out.package.constants.push_back(std::move(constant));
    return {};
}

/// A name, or { name, precision }.
Result<void> readVariable(JsonValue const& item, MaterialDefinition& out) {
    Variable variable{ .at = item.at };
    Result<void> done;
    if (item.kind == JsonValue::Kind::Object) {
        JsonValue const* name = nullptr;
        done = expectOnly(item, kVariableFields, "variable", out.warnings);
        if (done) done = requireMember(item, "name", "variable", name);
        if (done) done = readIdentifier(*name, "variable", variable.name);
        if (JsonValue const* precision = findMember(item, "precision"); done && precision)
            done = readPrecision(*precision, variable.precision);
    } else {
        done = readIdentifier(item, "variable", variable.name);
    }
    if (done) done = checkKeyword(item, "variable", variable.name);
    if (!done) return done;
    if (out.variables.size() == kMaxVariables)
        return errorAt(item.at, fmt::format("a material has at most {} variables", kMaxVariables));
    if (std::ranges::count(out.variables, variable.name, &Variable::name) > 0) {
        return errorAt(item.at, fmt::format("there are two variables '{}'", variable.name));
    }
    out.variables.push_back(std::move(variable));
    return {};
}

/// { name, target, type, precision, location }
Result<void> readOutput(JsonValue const& item, MaterialDefinition& out) {
    static constexpr std::pair<std::string_view, bool> kTargets[] = { { "color", false }, { "depth", true } };
    static constexpr std::pair<std::string_view, uint32_t> kOutputTypes[] = {
        { "float", 1 }, { "float2", 2 }, { "float3", 3 }, { "float4", 4 }
    };
    EffectOutput output;
    JsonValue const* name = nullptr;
    Result<void> done = expectKind(item, JsonValue::Kind::Object, "output");
    if (done) done = expectOnly(item, kOutputFields, "output", out.warnings);
    if (done) done = requireMember(item, "name", "output", name);
    if (done) done = readIdentifier(*name, "output", output.name);
    if (done) done = checkKeyword(item, "output", output.name);
    if (JsonValue const* target = findMember(item, "target"); done && target)
        done = readEnum(*target, "target", kTargets, output.isDepth);
    if (output.isDepth) output.components = 1;
    if (JsonValue const* type = findMember(item, "type"); done && type)
        done = readEnum(*type, "type", kOutputTypes, output.components);
    if (JsonValue const* precision = findMember(item, "precision"); done && precision)
        done = readPrecision(*precision, output.precision);
    if (JsonValue const* qualifier = findMember(item, "qualifier"); done && qualifier) {
        if (!equalIgnoringCase(qualifier->text, "out"))
            return errorAt(qualifier->at, "an output is only written; to read the pixel, declare a parameter with "
                                          "currentPixel : true");
    }
    if (!done) return done;
    if (output.isDepth && output.components != 1) return errorAt(item.at, "the output of depth is a float");
    output.location = static_cast<uint32_t>(std::ranges::count(out.outputs, false, &EffectOutput::isDepth));
    if (JsonValue const* location = findMember(item, "location")) {
        float number = 0;
        if (Result<void> isNumber = readNumber(*location, "location", 0, kMaxOutputs - 1, number); !isNumber)
            return isNumber;
        output.location = static_cast<uint32_t>(number);
    }
    for (EffectOutput const& other : out.outputs) {
        const bool isSame = other.isDepth == output.isDepth && (output.isDepth || other.location == output.location);
        if (other.name == output.name || isSame)
            return errorAt(item.at, fmt::format("the outputs '{}' and '{}' have the same name or place", other.name,
                                                output.name));
    }
    out.outputs.push_back(std::move(output));
    return {};
}

constexpr std::pair<std::string_view, uint32_t> kAttributes[] = {
    { "position", kAttributePosition },
    { "tangents", kAttributeTangents },
    { "color", kAttributeColor },
    { "uv0", kAttributeUv0 },
    { "uv1", kAttributeUv1 },
    { "custom0", 7 },
    { "custom1", 8 },
    { "custom2", 9 },
    { "custom3", 10 },
    { "custom4", 11 },
    { "custom5", 12 },
    { "custom6", 13 },
    { "custom7", 14 },
};

Result<void> readRequirement(JsonValue const& item, MaterialDefinition& out) {
    uint32_t location = 0;
    if (Result<void> done = readEnum(item, "requires", kAttributes, location); !done) return done;
    if ((out.requiredAttributes >> location & 1) != 0)
        out.warnings.push_back(errorAt(item.at, fmt::format("'{}' is required twice", item.text)).message);
    out.requiredAttributes |= 1u << location;
    return {};
}

using VariantFilter = std::pair<std::string_view, uint16_t>;

constexpr VariantFilter kVariantFilters[] = {
    { "directionalLighting", kVariantSun },
    { "dynamicLighting", kVariantPunctual },
    { "shadowReceiver", kVariantShadowReceiver },
    { "skinning", kVariantSkinning },
    { "fog", kVariantFog },
    { "vsm", kVariantVsm },
    { "ssr", kVariantSsr },
    { "stereo", kVariantStereo },
    { "halfPrecision", kVariantHalf },
    { "debugViews", kVariantDebug },
};

Result<void> readFilter(JsonValue const& item, MaterialDefinition& out) {
    uint16_t bits = 0;
    if (Result<void> done = readEnum(item, "variantFilter", kVariantFilters, bits); !done) return done;
    out.package.filteredVariants |= bits;
    return {};
}

Result<void> checkCurrentPixel(MaterialPackage const& package, Parameter const& parameter, SourcePosition const& at) {
    if (!parameter.currentPixel) return {};
    if (package.domain != MaterialDomain::PostProcess)
        return errorAt(at, "currentPixel exists only in the domain postprocess");
    const auto input = std::ranges::find(package.parameters, ParameterType::SubpassInput, &Parameter::type);
    if (input == package.parameters.end()) return {};
    return errorAt(at,
                   fmt::format("'{}' is a subpassInput, so every pass of this material is merged and '{}' cannot be "
                               "a texture; make both sampler2d with currentPixel : true",
                               input->name, parameter.name));
}

/// ParameterSource::usedIf -> Parameter::usedIf.
Result<void> resolveUsedIf(MaterialDefinition& definition, size_t index) {
    Parameter& parameter = definition.package.parameters[index];
    for (NamedAt const& name : definition.parameterSources[index].usedIf) {
        Constant const* constant = definition.package.findConstant(name.name);
        if (!constant)
            return errorAt(name.at, fmt::format("there is no constant '{}'{}", name.name,
                                                suggestion(name.name, namesOf(definition.package.constants))));
        if (constant->type != ConstantType::Bool)
            return errorAt(name.at, fmt::format("usedIf names constants of type bool, and '{}' is not one", name.name));
        parameter.usedIf.push_back(constant->id);
    }
    return {};
}

constexpr ListProperty kLists[] = {
    { "parameters", kParameterFields,
      "a number, vector, matrix or texture, which instances set; `float[9]` is an array",
      "`materialParams.NAME`; of samplers `materialParams_NAME`", kMaxParameterCount, readParameter },
    { "constants", kConstantFields, "a `bool`, `int` or `float` that is set before a pipeline is made",
      "`materialConstants_NAME`", kMaxConstantCount, readConstant },
    { "requires",
      {},
      "an [attribute](#attributes) of the mesh",
      "`getUV0()` and the like",
      kMaxParameterCount,
      readRequirement },
    { "variables", kVariableFields, "a value that the vertex block gives to the fragment block; or its name alone",
      "`material.NAME` in the vertex block, `variable_NAME` in the fragment block", kMaxVariables, readVariable },
    { "outputs", kOutputFields,
      "of effects: a colour attachment, or with `target : depth` the depth; `color` alone if there are none. Of unlit "
      "surfaces: a colour attachment of a mesh pass",
      "`inputs.NAME`, of surfaces `material.NAME`", kMaxOutputs, readOutput },
    { "variantFilter",
      {},
      "a [variant](#variants) that is left out, which makes the package smaller",
      "",
      kMaxParameterCount,
      readFilter },
};

} // namespace

std::span<const ListProperty> listProperties() { return kLists; }

Result<void> readList(JsonValue const& value, ListProperty const& property, MaterialDefinition& out) {
    if (Result<void> isArray = expectKind(value, JsonValue::Kind::Array, property.name); !isArray) return isArray;
    if (value.items.size() > property.limit)
        return errorAt(value.at, fmt::format("'{}' has more than {} entries", property.name, property.limit));
    std::vector<Error> errors;
    for (JsonValue const& item : value.items) {
        if (Result<void> done = property.readEntry(item, out); !done) errors.push_back(done.error());
    }
    if (!errors.empty()) return joined(errors);
    return {};
}

std::vector<std::string_view> parameterTypeNames() {
    std::vector<std::string_view> names;
    for (auto const& [name, type] : kTypes) names.push_back(name);
    return names;
}

std::vector<std::string_view> attributeNames() {
    std::vector<std::string_view> names;
    for (auto const& [name, location] : kAttributes) names.push_back(name);
    return names;
}

Result<uint16_t> variantBitsOfFilters(std::span<const std::string> names) {
    uint16_t bits = 0;
    for (std::string const& name : names) {
        const auto known = std::ranges::find_if(
                kVariantFilters, [&](VariantFilter const& each) { return equalIgnoringCase(name, each.first); });
        if (known == std::end(kVariantFilters)) {
            return fail(ErrorCode::InvalidArgument, "there is no variant '{}'{}", name,
                        suggestion(name, variantFilterNames()));
        }
        bits |= known->second;
    }
    return bits;
}

std::vector<std::string_view> variantFilterNames() {
    std::vector<std::string_view> names;
    for (auto const& [name, bits] : kVariantFilters) names.push_back(name);
    return names;
}

Result<void> layOutParameters(MaterialDefinition& definition) {
    uint32_t binding = 1; // 0 is the block
    for (size_t i = 0; i < definition.package.parameters.size(); ++i) {
        Parameter& parameter = definition.package.parameters[i];
        if (!isTexture(parameter.type)) continue;
        SourcePosition const& at = definition.parameterSources[i].at;
        if (parameter.type == ParameterType::SubpassInput && definition.package.domain != MaterialDomain::PostProcess) {
            return errorAt(at, "subpass inputs exist only in the domain postprocess");
        }
        if (parameter.type == ParameterType::Sampler2DMS && definition.package.domain != MaterialDomain::PostProcess) {
            return errorAt(at, "a sampler2dMS exists only in the domain postprocess");
        }
        if (Result<void> read = checkCurrentPixel(definition.package, parameter, at); !read) return read;
        if (Result<void> known = resolveUsedIf(definition, i); !known) return known;
        parameter.binding = static_cast<uint8_t>(binding++);
    }
    uint64_t bytes = 0;
    for (Parameter const& parameter : definition.package.parameters) bytes += parameterBytes(parameter);
    definition.package.uniformBytes = assignOffsets(definition.package.parameters);
    if (bytes > kMaxBlockBytes || definition.package.uniformBytes > kMaxBlockBytes) {
        return fail(ErrorCode::InvalidArgument, "{}: the parameters take more than {} bytes", definition.fileName,
                    kMaxBlockBytes);
    }
    return {};
}

} // namespace filament_core::shader
