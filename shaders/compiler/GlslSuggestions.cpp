// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslSuggestions.h"

#include "base/Suggest.h"
#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/StageText.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::shader {
namespace {

/// The first 'quoted' word of a message; empty if there is none.
std::string_view quotedWord(std::string_view message) {
    const size_t open = message.find('\'');
    const size_t close = message.find('\'', open + 1);
    return close == std::string_view::npos ? std::string_view{} : message.substr(open + 1, close - open - 1);
}

/// What may follow a dot: members of MaterialInputs, parameters of the block.
std::vector<std::string> fieldsOf(MaterialDefinition const& definition) {
    std::vector<std::string> names;
    for (MaterialMember const& member : materialMembers()) {
        if (member.isMemberOf(definition)) names.emplace_back(member.name);
    }
    for (Parameter const& parameter : definition.package.parameters) {
        if (!isTexture(parameter.type)) names.push_back(parameter.name);
    }
    for (Variable const& variable : definition.variables) names.push_back(variable.name);
    return names;
}

std::vector<std::string> identifiersOf(MaterialDefinition const& definition) {
    std::vector<std::string> names{ "prepareMaterial" };
    if (definition.package.uniformBytes > 0) names.emplace_back("materialParams");
    for (Parameter const& parameter : definition.package.parameters) {
        if (isTexture(parameter.type)) names.push_back("materialParams_" + parameter.name);
    }
    for (Constant const& constant : definition.package.constants) names.push_back("materialConstants_" + constant.name);
    for (Variable const& variable : definition.variables) names.push_back("variable_" + variable.name);
    return names;
}

/// Such a parameter is a subpass input in one variant and a texture in the other; no other function takes a subpass
/// input.
std::string aboutCurrentPixel(MaterialDefinition const& definition) {
    const auto own = std::ranges::find(definition.package.parameters, true, &Parameter::currentPixel);
    if (own == definition.package.parameters.end()) return {};
    return fmt::format("; only getCurrentPixel(materialParams_{}) can read a currentPixel parameter", own->name);
}

/// "uv0" for getUV0 and the like, whose attribute `requires` does not name; empty for others.
std::string missingAttribute(std::string_view getter, MaterialDefinition const& definition) {
    static constexpr std::pair<std::string_view, std::string_view> kGetters[] = { { "getUV0", "uv0" },
                                                                                  { "getUV1", "uv1" },
                                                                                  { "getColor", "color" } };
    for (auto const& [name, attribute] : kGetters) {
        if (name == getter) return std::string(attribute);
    }
    if (getter.starts_with("getCustom") && getter.size() == 10) return "custom" + std::string(getter.substr(9));
    const bool isOfFrame = getter == "getWorldTangentFrame" || getter == "getWorldNormalVector" ||
                           getter == "getWorldGeometricNormalVector" || getter == "getWorldReflectedVector" ||
                           getter == "getNdotV";
    return isOfFrame && definition.package.shading == ShadingModel::Unlit ? "tangents" : "";
}

/// Functions of other versions of GLSL, and what this one calls them.
std::string_view presentName(std::string_view name) {
    static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        { "texture2D", "texture" },
        { "textureCube", "texture" },
        { "texture2DLod", "textureLod" },
        { "texture2DLodEXT", "textureLod" },
        { "textureCubeLod", "textureLod" },
        { "textureCubeLodEXT", "textureLod" },
        { "texture2DProj", "textureProj" },
        { "texture3D", "texture" },
        { "gl_FragColor", "material.baseColor" },
        { "gl_FragData", "material.baseColor" },
        { "lerp", "mix" },
        { "frac", "fract" },
        { "rsqrt", "inversesqrt" },
        { "ddx", "dFdx" },
        { "ddy", "dFdy" },
        { "atan2", "atan" },
        { "fmod", "mod" },
        { "tex2D", "texture" },
    };
    const auto found = std::ranges::find(kNames, name, &std::pair<std::string_view, std::string_view>::first);
    return found == std::end(kNames) ? std::string_view{} : found->second;
}

std::string_view modelName(ShadingModel model) {
    static constexpr std::string_view kNames[] = { "unlit", "lit", "subsurface", "cloth", "specularGlossiness" };
    return kNames[static_cast<size_t>(model)];
}

/// A member of other shading models, or of materials that refract.
std::string aboutMember(std::string_view name, MaterialDefinition const& definition) {
    const auto members = materialMembers();
    const auto member = std::ranges::find(members, name, &MaterialMember::name);
    if (member == members.end() || member->isMemberOf(definition)) return {};
    std::string models;
    for (const ShadingModel model :
         { ShadingModel::Lit, ShadingModel::Subsurface, ShadingModel::Cloth, ShadingModel::SpecularGlossiness }) {
        MaterialDefinition other;
        other.package.shading = model;
        if (member->isMemberOf(other)) models += fmt::format("{}{}", models.empty() ? "" : ", ", modelName(model));
    }
    const bool needsRefraction = models.empty();
    return fmt::format("; shadingModel : {} has no {}, which is for {}", modelName(definition.package.shading), name,
                       needsRefraction ? "materials with a refractionMode" : models);
}

/// A parameter, constant or variable whose prefix is missing.
std::string aboutPrefix(std::string_view name, MaterialDefinition const& definition) {
    if (Parameter const* parameter = definition.package.findParameter(name))
        return fmt::format("; the parameter is materialParams{}{}", isTexture(parameter->type) ? "_" : ".", name);
    if (definition.package.findConstant(name)) return fmt::format("; the constant is materialConstants_{}", name);
    if (std::ranges::count(definition.variables, name, &Variable::name) > 0)
        return fmt::format("; the variable is variable_{} in the fragment block", name);
    return {};
}

/// What glslang says of names that it does not know.
struct Complaint {
    bool isOverload = false, isField = false, isIdentifier = false;
    std::string_view name;
};

Complaint complaintOf(std::string_view line) {
    const auto says = [&](std::string_view text) { return line.find(text) != std::string_view::npos; };
    return { says("no matching overloaded function"), says("no such field in structure"), says("undeclared identifier"),
             quotedWord(line) };
}

std::string hintFor(std::string_view line, MaterialDefinition const& definition) {
    if (line.find("requires layout(binding=X)") != std::string_view::npos)
        return "; declare it in the list of parameters, and read materialParams_ and its name";
    const Complaint complaint = complaintOf(line);
    if (!complaint.isOverload && !complaint.isField && !complaint.isIdentifier) return {};
    const std::string_view name = complaint.name;
    if (complaint.isField) {
        if (line.find("in structure 'objectUniforms'") != std::string_view::npos)
            return "; what is in there is the engine's: use functions, such as getWorldFromModelNormalMatrix()";
        const bool isAttribute = name == "uv0" || name == "uv1" || name == "color"; // of MaterialVertexInputs
        if (isAttribute) return fmt::format("; add requires : [ {} ]", name);
        if (std::string hint = aboutMember(name, definition); !hint.empty()) return hint;
        if (std::string hint = aboutPrefix(name, definition); !hint.empty()) return hint; // the member has its name
    } else {
        if (const std::string attribute = missingAttribute(name, definition); !attribute.empty())
            return fmt::format("; add requires : [ {} ]", attribute);
        if (const std::string_view now = presentName(name); !now.empty()) return fmt::format("; use {}", now);
        if (std::string hint = aboutPrefix(name, definition); !hint.empty()) return hint;
    }
    if (complaint.isOverload) return aboutCurrentPixel(definition);
    const std::vector<std::string> names = complaint.isField ? fieldsOf(definition) : identifiersOf(definition);
    const std::vector<std::string_view> known(names.begin(), names.end());
    return suggestion(name, known);
}

/// "file:line: reason" in its parts; no file for text of another form.
struct Place {
    std::string_view file, reason;
    uint32_t line = 0;
};

Place placeOf(std::string_view text) {
    const size_t end = text.find(": ");
    const size_t colon = end == std::string_view::npos ? end : text.rfind(':', end - 1);
    if (colon == std::string_view::npos || colon == 0) return { {}, text, 0 };
    Place place{ text.substr(0, colon), text.substr(end + 2), 0 };
    const char* const last = text.data() + end;
    const auto number = std::from_chars(text.data() + colon + 1, last, place.line);
    return number.ec == std::errc{} && number.ptr == last ? place : Place{ {}, text, 0 };
}

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        if (end > 0) lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

/// The names that StageText wrote in place of the author's.
std::string inAuthorsWords(std::string line) {
    static const std::pair<std::string, std::string> kWords[] = {
        { "'#error' : " + std::string(kMissingInclude),
          "cannot find the file of this #include, or it includes itself" },
        { "'sampler/image' : cannot construct this type",
          "'texture2D' : this and textureCube are older GLSL; use texture" },
        { "filament_instanceId", "gl_InstanceID" },
        { "gl_VertexIndex", "gl_VertexID" },
        { "author_max3", "max3" },
        { "author_min3", "min3" },
        { "author_mid3", "mid3" },
    };
    for (auto const& [ours, theirs] : kWords) {
        for (size_t at = line.find(ours); at != std::string::npos; at = line.find(ours, at + theirs.size()))
            line.replace(at, ours.size(), theirs);
    }
    return line;
}

constexpr size_t kMaxLines = 50;

Error ofLines(ErrorCode code, std::vector<std::string> const& lines) {
    Error error{ code, {} };
    for (size_t i = 0; i < std::min(lines.size(), kMaxLines); ++i) error.message += (i > 0 ? "\n" : "") + lines[i];
    if (lines.size() > kMaxLines) error.message += fmt::format("\n(and {} more)", lines.size() - kMaxLines);
    return error;
}

} // namespace

Error withSuggestion(Error const& error, MaterialDefinition const& definition) {
    std::vector<std::string> lines, ofEngine;
    const bool lacksInclude = error.message.find(kMissingInclude) != std::string::npos; // the text ends there
    for (const std::string_view text : linesOf(error.message)) {
        const Place place = placeOf(text);
        if (lacksInclude && place.reason.find("missing #endif") != std::string_view::npos) continue;
        if (!place.file.empty() && isEngineFile(place.file)) {
            ofEngine.push_back(fmt::format("{}:{}: the engine's code behind this block does not compile with it: {}",
                                           definition.fileName, definition.fragment.at.line, place.reason));
            continue;
        }
        lines.push_back(inAuthorsWords(std::string(text)) + hintFor(text, definition));
    }
    return ofLines(error.code, lines.empty() ? ofEngine : lines);
}

Error joined(std::span<const Error> errors) {
    std::vector<std::string> lines;
    for (Error const& error : errors) {
        for (const std::string_view line : linesOf(error.message)) {
            if (std::ranges::count(lines, line) == 0) lines.emplace_back(line);
        }
    }
    return ofLines(errors[0].code, lines);
}

} // namespace filament_core::shader
