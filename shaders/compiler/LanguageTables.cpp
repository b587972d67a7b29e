// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/LanguageTables.h"

#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/GlslOutline.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/ParameterProperties.h"
#include "shaders/compiler/StateProperties.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

namespace filament::shader {
namespace {

std::string listOf(std::vector<std::string_view> const& names) {
    std::string list;
    for (const std::string_view name : names) {
        if (!list.empty()) list += ", ";
        list += fmt::format("`{}`", name);
    }
    return list + "\n";
}

std::string propertyTable() {
    std::string text = "| property | values |\n|---|---|\n";
    for (StateProperty const& property : stateProperties())
        fmt::format_to(std::back_inserter(text), "| `{}` | {} |\n", property.name, property.values());
    return text;
}

struct Model {
    ShadingModel model;
    RefractionMode refraction;
    const char* title;
};
constexpr Model kModels[] = { { ShadingModel::Lit, RefractionMode::None, "lit" },
                              { ShadingModel::Lit, RefractionMode::Cubemap, "lit, refracting" },
                              { ShadingModel::Subsurface, RefractionMode::None, "subsurface" },
                              { ShadingModel::Cloth, RefractionMode::None, "cloth" },
                              { ShadingModel::SpecularGlossiness, RefractionMode::None, "specular glossiness" },
                              { ShadingModel::Unlit, RefractionMode::None, "unlit" } };

MaterialDefinition definitionOf(Model const& model) {
    MaterialDefinition definition;
    definition.package.shading = model.model;
    definition.package.refractionMode = model.refraction;
    definition.package.refractionType = RefractionType::Thin; // which has members of its own
    return definition;
}

std::string memberTable() {
    std::string text = "| member | type | initially |", rule = "\n|---|---|---|";
    for (Model const& model : kModels) {
        text += fmt::format(" {} |", model.title);
        rule += "---|";
    }
    text += rule + "\n";
    for (MaterialMember const& member : materialMembers()) {
        const auto initial = std::span(member.initial).first(member.components);
        const std::string_view type = floatType(member.components);
        const std::string guides = member.components == 1 ? "float" : fmt::format("float{}", type.back());
        std::string value = floatLiteral(initial);
        value = value.substr(value.find('(') + 1);
        value.pop_back();
        fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} |", member.name, guides, value);
        for (Model const& model : kModels) text += member.isMemberOf(definitionOf(model)) ? " x |" : " |";
        text += "\n";
    }
    return text;
}

constexpr std::string_view kApiFiles[] = { "shaders/material/api.glsl", "shaders/material/surface/vertex_api.glsl",
                                           "shaders/material/surface/fragment_api.glsl" };

std::vector<GlslDeclaration> apiFunctions(std::string_view path) {
    std::vector<GlslDeclaration> found;
    for (GlslDeclaration& each : outlineOf(*embeddedSource(path), path)) {
        const bool isApi =
                each.name.starts_with("get") || each.name == "prepareMaterial" || each.name == "uvToRenderTargetUV";
        const auto isSame = [&](GlslDeclaration const& known) { return known.name == each.name; };
        if (isApi && each.kind == GlslDeclaration::Kind::Function && std::ranges::none_of(found, isSame))
            found.push_back(std::move(each));
    }
    return found;
}

std::string signatureOf(GlslDeclaration const& function) {
    std::string parameters;
    for (std::string const& type : function.parameters) parameters += (parameters.empty() ? "" : ", ") + type;
    return fmt::format("{} {}({})", function.type, function.name, parameters);
}

std::string functionTable() {
    static constexpr const char* kBlocks[] = { "both", "vertex", "fragment" };
    std::string text = "| function | block |\n|---|---|\n";
    for (size_t i = 0; i < std::size(kApiFiles); ++i) {
        for (GlslDeclaration const& each : apiFunctions(kApiFiles[i]))
            fmt::format_to(std::back_inserter(text), "| `{}` | {} |\n", signatureOf(each), kBlocks[i]);
    }
    return text;
}

std::string helperTable() {
    std::string text = "| helper | |\n|---|---|\n";
    for (const std::string_view name : helperNames()) {
        std::string forms;
        for (const std::string_view path : embeddedPaths()) {
            if (!isEngineFile(path)) continue;
            for (GlslDeclaration const& each : outlineOf(*embeddedSource(path), path)) {
                if (each.name != name || each.kind == GlslDeclaration::Kind::Macro) continue;
                const bool isFunction = each.kind == GlslDeclaration::Kind::Function;
                forms += (forms.empty() ? "`" : ", `") + (isFunction ? signatureOf(each) : "float " + each.name) + "`";
            }
        }
        fmt::format_to(std::back_inserter(text), "| `{}` | {} |\n", name, forms);
    }
    return text;
}

void addWords(std::string_view text, std::set<std::string>& out) {
    for (size_t at = 0; at < text.size();) {
        size_t end = at;
        while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])) != 0) ++end;
        if (end > at && std::isalpha(static_cast<unsigned char>(text[at])) != 0) out.emplace(text.substr(at, end - at));
        at = end + 1;
    }
}

} // namespace

std::vector<std::pair<std::string, std::string>> languageTables() {
    return { { "properties", propertyTable() },
             { "types", listOf(parameterTypeNames()) },
             { "attributes", listOf(attributeNames()) },
             { "filters", listOf(variantFilterNames()) },
             { "members", memberTable() },
             { "functions", functionTable() },
             { "helpers", helperTable() } };
}

std::string withCurrentTables(std::string_view document) {
    std::string out(document);
    for (auto const& [name, table] : languageTables()) {
        const std::string begin = "<!-- begin: " + name + " -->\n", end = "<!-- end: " + name + " -->";
        const size_t from = out.find(begin), to = out.find(end);
        if (from == std::string::npos || to == std::string::npos || to < from) continue;
        out.replace(from + begin.size(), to - from - begin.size(), table);
    }
    return out;
}

std::vector<std::string> languageWords() {
    std::set<std::string> words{ "material", "vertex",        "fragment",  "parameters", "constants", "variables",
                                 "requires", "variantFilter", "precision", "format",     "usedIf",    "currentPixel" };
    for (StateProperty const& property : stateProperties()) {
        words.emplace(property.name);
        if (property.name != "name" && !property.values().starts_with("a number")) addWords(property.values(), words);
    }
    for (const auto& names : { parameterTypeNames(), attributeNames(), variantFilterNames() })
        words.insert(names.begin(), names.end());
    for (MaterialMember const& member : materialMembers()) words.emplace(member.name);
    for (const std::string_view path : kApiFiles)
        for (GlslDeclaration const& each : apiFunctions(path)) words.insert(each.name);
    words.insert(helperNames().begin(), helperNames().end());
    words.erase("each");
    return { words.begin(), words.end() };
}

} // namespace filament::shader
