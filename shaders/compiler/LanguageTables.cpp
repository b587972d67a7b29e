// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/LanguageTables.h"

#include "base/Assert.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/GlslOutline.h"
#include "shaders/compiler/IgnoredNames.h"
#include "shaders/compiler/MaterialMembers.h"
#include "shaders/compiler/ParameterProperties.h"
#include "shaders/compiler/StateProperties.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

namespace filament_core::shader {
namespace {

std::string nameListOf(std::vector<std::string_view> const& names) {
    std::string list;
    for (const std::string_view name : names) {
        if (!list.empty()) list += ", ";
        list += fmt::format("`{}`", name);
    }
    return list + "\n";
}

/// Heads of material blocks whose defaults may differ.
constexpr std::string_view kHeads[] = { "", "blending : masked", "blending : transparent", "domain : postprocess" };

/// What an author gets who writes nothing but this.
MaterialDefinition definitionWith(std::string_view head) {
    const std::string text = fmt::format("material {{ {} }} fragment {{ void code(); }}", head);
    Result<MaterialText> parsed = parseMaterialText(text, "defaults", {});
    FILAMENT_ASSERT(parsed, "heads of materials can be parsed");
    Result<MaterialDefinition> definition = defineMaterial(std::move(*parsed), "defaults");
    FILAMENT_ASSERT(definition, "heads of materials are valid");
    return std::move(*definition);
}

/// "`true`; `false` with `blending : transparent`"
std::string initialOf(StateProperty const& property, std::span<const MaterialDefinition> definitions) {
    const std::string usual = property.shown(definitions.front());
    std::string text = usual.empty() ? "" : fmt::format("`{}`", usual);
    for (size_t i = 1; i < definitions.size(); ++i) {
        const std::string value = property.shown(definitions[i]);
        if (value == usual || kHeads[i].starts_with(property.name)) continue;
        text += fmt::format("; `{}` with `{}`", value, kHeads[i]);
    }
    return text;
}

std::string propertyTable() {
    std::vector<MaterialDefinition> definitions;
    for (const std::string_view head : kHeads) definitions.push_back(definitionWith(head));
    std::string text = "| property | values | initially | meaning |\n|---|---|---|---|\n";
    for (StateProperty const& property : stateProperties())
        fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} | {} |\n", property.name, property.values(),
                       initialOf(property, definitions), property.meaning);
    return text;
}

std::string listTable() {
    std::string text = "| list | an entry | at most | fields | name in the code |\n|---|---|---|---|---|\n";
    for (ListProperty const& list : listProperties()) {
        std::string fields;
        for (const std::string_view field : list.fields)
            fields += fmt::format("{}`{}`", fields.empty() ? "" : ", ", field);
        fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} | {} | {} |\n", list.name, list.meaning, list.limit,
                       fields, list.inCode);
    }
    return text;
}

std::string ignoredTable() {
    std::string text = "| of a | name | without a warning | why it has no effect |\n|---|---|---|---|\n";
    for (IgnoredName const& each : ignoredNames()) {
        const std::string silent = each.asItIs.empty() ? "" : fmt::format("`{}`", each.asItIs);
        fmt::format_to(std::back_inserter(text), "| {} | `{}` | {} | {} |\n", each.of, each.name, silent, each.reason);
    }
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

/// Both types of refraction have members of their own.
bool has(Model const& model, MaterialMember const& member) {
    MaterialDefinition definition;
    definition.package.shading = model.model;
    definition.package.refractionMode = model.refraction;
    definition.package.refractionType = RefractionType::Thin;
    if (member.isMemberOf(definition)) return true;
    definition.package.refractionType = RefractionType::Solid;
    return member.isMemberOf(definition);
}

std::string memberTable() {
    std::string text = "| member | type | initially |", rule = "\n|---|---|---|";
    for (Model const& model : kModels) {
        text += fmt::format(" {} |", model.title);
        rule += "---|";
    }
    text += " meaning |" + rule + "---|\n";
    for (MaterialMember const& member : materialMembers()) {
        const auto initial = std::span(member.initial).first(member.components);
        const std::string_view type = floatType(member.components);
        const std::string guides = member.components == 1 ? "float" : fmt::format("float{}", type.back());
        std::string value = floatLiteral(initial);
        value = value.substr(value.find('(') + 1);
        value.pop_back();
        fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} |", member.name, guides, value);
        for (Model const& model : kModels) text += has(model, member) ? " x |" : " |";
        text += fmt::format(" {} |\n", member.meaning);
    }
    return text;
}

/// Where functions for authors are, and in which blocks they can be called.
struct ApiFile {
    std::string_view path, block;
};
constexpr ApiFile kApiFiles[] = { { "shaders/material/api.glsl", "all" },
                                  { "shaders/material/surface/vertex_api.glsl", "vertex" },
                                  { "shaders/material/surface/fragment_api.glsl", "fragment, of surfaces" },
                                  { "shaders/material/bump.glsl", "fragment, of surfaces" },
                                  { "shaders/post/post_fragment_api.glsl", "fragment, of effects" } };

std::vector<GlslDeclaration> apiFunctions(std::string_view path) {
    std::vector<GlslDeclaration> found;
    for (GlslDeclaration& each : outlineOf(*embeddedSource(path), path)) {
        static constexpr std::string_view kOthers[] = { "applyBump", "prepareMaterial", "uvToRenderTargetUV" };
        const bool isApi = each.name.starts_with("get") || std::ranges::count(kOthers, each.name) > 0;
        const bool isCallable =
                each.kind == GlslDeclaration::Kind::Function || each.kind == GlslDeclaration::Kind::Macro;
        const auto isSame = [&](GlslDeclaration const& known) { return known.name == each.name; };
        if (isApi && isCallable && std::ranges::none_of(found, isSame)) found.push_back(std::move(each));
    }
    return found;
}

std::string signatureOf(GlslDeclaration const& function) {
    if (function.kind == GlslDeclaration::Kind::Macro)
        return fmt::format("vec4 {}(materialParams_NAME)", function.name);
    std::string parameters;
    for (std::string const& type : function.parameters) parameters += (parameters.empty() ? "" : ", ") + type;
    return fmt::format("{} {}({})", function.type, function.name, parameters);
}

/// One line of Markdown each.
constexpr std::pair<std::string_view, std::string_view> kMeanings[] = {
    { "getClipFromWorldMatrix", "from world to clip space" },
    { "getWorldFromClipMatrix", "its inverse" },
    { "getClipFromViewMatrix", "the projection" },
    { "getViewFromWorldMatrix", "from world to view space: the camera looks along -z, y is up" },
    { "getWorldFromViewMatrix", "its inverse" },
    { "getViewFromClipMatrix", "the inverse of the projection" },
    { "getUserWorldFromWorldMatrix", "from world to the user's world: adds the position of the camera" },
    { "getResolution", "width and height of the target in pixels, and 1 divided by them" },
    { "getWorldCameraPosition", "0: the camera is the origin of the world" },
    { "getWorldOffset", "the position of the camera in the user's world, in metres" },
    { "getTime", "the fraction of the second of `View::timeSeconds`, [0, 1)" },
    { "getUserTime", "`View::timeSeconds` as the sum of x and y; z and w are 0" },
    { "getUserTimeMod", "`View::timeSeconds` modulo a number of seconds, exact after hours, too" },
    { "getExposure", "the factor from cd/m² to display light" },
    { "getEV100", "the exposure value at ISO 100" },
    { "getMaterialGlobal0", "the first of `View::materialGlobals`" },
    { "getMaterialGlobal1", "the second" },
    { "getMaterialGlobal2", "the third" },
    { "getMaterialGlobal3", "the fourth" },
    { "getPosition", "the vertex as it is in the mesh, skinned and morphed; w is 1" },
    { "getVertexIndex", "the number of the vertex" },
    { "getEyeIndex", "0: a view has one eye" },
    { "getEyeFromViewMatrix", "the identity: a view has one eye" },
    { "getInstanceIndex", "the number of the instance, with `instanced : true`" },
    { "getPointCorner", "with `sizedPoints : true`: the corner of the point, -1 or 1 each way, with y down" },
    { "getWorldFromModelMatrix", "from the space of the mesh to the world" },
    { "getWorldFromModelNormalMatrix", "the same for normals: not normalised, right for uneven scales and mirrors" },
    { "getUserWorldPosition", "in the user's world, in metres" },
    { "getWorldPosition", "in metres" },
    { "getWorldViewVector", "unit vector from the surface to the camera" },
    { "getWorldTangentFrame", "tangent, bitangent and normal of the geometry as columns, interpolated" },
    { "getWorldNormalVector", "unit normal; after `prepareMaterial()` with the normal map" },
    { "getWorldGeometricNormalVector", "unit normal of the geometry" },
    { "getWorldReflectedVector", "the view vector mirrored at the normal; after `prepareMaterial()`" },
    { "getNdotV", "cosine between normal and view vector, at least 0.0001; after `prepareMaterial()`" },
    { "getColor", "the colour of the vertices" },
    { "getUV0", "the first texture coordinates" },
    { "getUV1", "the second texture coordinates" },
    { "isSectionCap",
      "whether the fragment closes a solid that a section plane cuts, with `sectionPlanes : true`; of such a fragment "
      "the base colour alone counts" },
    { "getMaskThreshold", "the threshold of `blending : masked`" },
    { "getNormalizedPhysicalViewportCoord", "the place in the target, [0, 1], with y down, and the depth" },
    { "getNormalizedViewportCoord",
      "the place in the picture, with y down, and the depth: [0, 1], and beyond in a [guard band](resolution.md)" },
    { "applyBump", "tilts the normal by a map of heights, metres times its red channel, at these coordinates; after "
                   "`prepareMaterial()`" },
    { "uvToRenderTargetUV", "coordinates for a texture that was drawn: the same, row 0 is the top row on both APIs" },
    { "prepareMaterial", "computes what depends on the members that are normals" },
    { "getPixel", "the pixel that is written" },
    { "getNormalizedUV", "its place in the target, [0, 1]" },
    { "getCurrentPixel",
      "the value of a `currentPixel` parameter at this pixel; the pass can be merged with the one before" },
};

std::string meaningOf(std::string_view function) {
    const auto known = std::ranges::find(kMeanings, function, [](auto const& each) { return each.first; });
    FILAMENT_ASSERT(known != std::end(kMeanings), "every function for authors has its line in kMeanings");
    return std::string(known->second);
}

std::string functionTable() {
    std::string text = "| function | block | returns |\n|---|---|---|\n";
    for (ApiFile const& file : kApiFiles) {
        for (GlslDeclaration const& each : apiFunctions(file.path))
            fmt::format_to(std::back_inserter(text), "| `{}` | {} | {} |\n", signatureOf(each), file.block,
                           meaningOf(each.name));
    }
    return text;
}

std::string_view trimmed(std::string_view text) {
    const size_t from = text.find_first_not_of(" \t"), to = text.find_last_not_of(" \t");
    return from == std::string_view::npos ? std::string_view{} : text.substr(from, to - from + 1);
}

/// The members of a structure of authors, with what the comment behind each says. Lines of directives and macros are
/// none.
std::string structTable(std::string_view path, std::span<const std::string_view> structs) {
    std::string text = structs.size() > 1 ? "| structure | member | meaning |\n|---|---|---|\n"
                                          : "| member | meaning |\n|---|---|\n";
    for (const std::string_view name : structs) {
        std::string_view rest = *embeddedSource(path);
        rest.remove_prefix(rest.find(fmt::format("struct {} {{\n", name)));
        rest = rest.substr(rest.find('\n') + 1, rest.find("};") - rest.find('\n') - 1);
        while (!rest.empty()) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(line.size() + 1, rest.size()));
            const size_t end = line.find(';'), comment = line.find("// ");
            if (end == std::string_view::npos) continue;
            const std::string_view meaning = comment < line.size() ? trimmed(line.substr(comment + 3)) : "";
            fmt::format_to(std::back_inserter(text), "|{} `{}` | {} |\n",
                           structs.size() > 1 ? fmt::format(" `{}` |", name) : "", trimmed(line.substr(0, end)),
                           meaning);
        }
    }
    return text;
}

std::string vertexMemberTable() {
    static constexpr std::string_view kNames[] = { "MaterialVertexInputs" };
    return structTable("shaders/material/surface/vertex_api.glsl", kNames);
}

std::string shadingMemberTable() {
    static constexpr std::string_view kNames[] = { "ShadingData", "LightData" };
    return structTable("shaders/material/surface/custom_api.glsl", kNames);
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
             { "ignored", ignoredTable() },
             { "lists", listTable() },
             { "types", nameListOf(parameterTypeNames()) },
             { "attributes", nameListOf(attributeNames()) },
             { "filters", nameListOf(variantFilterNames()) },
             { "members", memberTable() },
             { "members-of-vertices", vertexMemberTable() },
             { "members-of-shading", shadingMemberTable() },
             { "functions", functionTable() },
             { "helpers", helperTable() } };
}

std::vector<std::string> languageWords() {
    std::set<std::string> words{ "material", "vertex", "fragment" };
    for (ListProperty const& list : listProperties()) {
        words.emplace(list.name);
        words.insert(list.fields.begin(), list.fields.end());
    }
    for (StateProperty const& property : stateProperties()) {
        words.emplace(property.name);
        if (property.name != "name" && !property.values().starts_with("a number")) addWords(property.values(), words);
    }
    for (const auto& names : { parameterTypeNames(), attributeNames(), variantFilterNames() })
        words.insert(names.begin(), names.end());
    for (MaterialMember const& member : materialMembers()) words.emplace(member.name);
    for (ApiFile const& file : kApiFiles)
        for (GlslDeclaration const& each : apiFunctions(file.path)) words.insert(each.name);
    words.insert(helperNames().begin(), helperNames().end());
    words.erase("each");
    return { words.begin(), words.end() };
}

} // namespace filament_core::shader
