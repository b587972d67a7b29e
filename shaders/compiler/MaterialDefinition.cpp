// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialDefinition.h"

#include "shaders/compiler/CodeScan.h"
#include "shaders/compiler/DefinitionRules.h"
#include "shaders/compiler/GlslSuggestions.h"
#include "shaders/compiler/IgnoredNames.h"
#include "shaders/compiler/ParameterProperties.h"
#include "shaders/compiler/PropertyReader.h"
#include "shaders/compiler/StateProperties.h"

#include <algorithm>

namespace filament_core::shader {
namespace {

Error unknownProperty(std::string const& name, JsonValue const& value) {
    if (const std::string_view reason = reasonAgainst(name); !reason.empty())
        return errorAt(value.at, fmt::format("there is no property '{}': {}", name, reason), ErrorCode::Unsupported);
    std::vector<std::string_view> known;
    for (StateProperty const& property : stateProperties()) known.push_back(property.name);
    for (ListProperty const& property : listProperties()) known.push_back(property.name);
    return errorAt(value.at, fmt::format("there is no property '{}'{}", name, suggestion(name, known)));
}

Result<void> readProperty(std::string const& name, JsonValue const& value, MaterialDefinition& out) {
    const auto states = stateProperties();
    const auto state = std::ranges::find(states, name, &StateProperty::name);
    if (state != states.end()) return state->read(value, name, out);
    const auto lists = listProperties();
    const auto list = std::ranges::find(lists, name, &ListProperty::name);
    if (list != lists.end()) return readList(value, *list, out);
    const Result<bool> isIgnored = ignores("property", name, value, out.warnings);
    if (!isIgnored) return isIgnored.error();
    return *isIgnored ? Result<void>{} : unknownProperty(name, value);
}

Result<void> readProperties(JsonValue const& material, MaterialDefinition& out) {
    std::vector<Error> errors;
    for (auto const& [name, value] : material.members) {
        Result<void> done;
        if (out.find(name)) done = errorAt(value.at, fmt::format("the property '{}' is given twice", name));
        if (done) done = readProperty(name, value, out);
        if (!done) errors.push_back(done.error());
        out.given.push_back({ name, value.at });
    }
    if (!errors.empty()) return joined(errors);
    return {};
}

void addHiddenParameter(MaterialDefinition& out, std::string_view name, ParameterType type) {
    out.package.parameters.push_back({ .name = std::string(name), .type = type });
    out.parameterSources.push_back({});
}

/// A material that sets `doubleSided` can be switched at run time. If it culls back faces while it is single-sided,
/// flipping their normals has no visible effect, so it needs no parameter.
bool needsDoubleSidedParameter(MaterialDefinition const& definition) {
    const bool isSurface = definition.package.domain == MaterialDomain::Surface;
    const bool cullsBack = definition.find("culling") == nullptr || definition.package.culling == Culling::Back;
    return isSurface && definition.find("doubleSided") && !(definition.package.doubleSided && cullsBack);
}

/// Defaults that follow from other properties.
void completeDefaults(MaterialDefinition& out) {
    MaterialPackage& package = out.package;
    if (!out.find("depthWrite")) package.depthWrite = !blends(package.blending);
    if (!out.find("alphaToCoverage")) package.alphaToCoverage = package.blending == Blending::Masked;
    if (package.domain == MaterialDomain::PostProcess) {
        if (!out.find("culling")) package.culling = Culling::None;
        if (!out.find("shadingModel")) package.shading = ShadingModel::Unlit;
        package.vertexDomain = VertexDomain::Device;
    }
    if (package.blending == Blending::Masked) addHiddenParameter(out, kMaskThresholdParameter, ParameterType::Float);
    if (needsDoubleSidedParameter(out)) addHiddenParameter(out, kDoubleSidedParameter, ParameterType::Bool);
}

/// What a surface does that has no fragment block, or an empty one: its members keep their initial values.
constexpr std::string_view kDefaultFragment =
        "void material(inout MaterialInputs material) { prepareMaterial(material); }";

bool hasCode(std::optional<GlslBlock> const& block) { return block && !CodeScan(block->text).words().empty(); }

} // namespace

SourcePosition const* MaterialDefinition::find(std::string_view property) const {
    const auto found = std::ranges::find(given, property, &GivenProperty::name);
    return found == given.end() ? nullptr : &found->at;
}

Error MaterialDefinition::errorAbout(std::string_view property, std::string const& message, ErrorCode code) const {
    if (SourcePosition const* at = find(property)) return errorAt(*at, message, code);
    return fail(code, "{}: {}", fileName, message);
}

Result<MaterialDefinition> defineMaterial(MaterialText text, std::string_view fileName) {
    MaterialDefinition definition;
    definition.fileName = fileName;
    if (Result<void> read = readProperties(text.material, definition); !read) return read.error();
    if (hasCode(text.vertex)) definition.vertex = std::move(text.vertex);
    if (hasCode(text.fragment))
        definition.fragment = std::move(*text.fragment);
    else if (definition.package.domain == MaterialDomain::Surface)
        definition.fragment = { std::string(kDefaultFragment), text.material.at };
    else
        return errorAt(text.material.at, "there is no fragment block, and without one an effect has no colour");
    completeDefaults(definition);
    leaveOutReflections(definition);
    if (Result<void> checked = checkRules(definition); !checked) return checked.error();
    if (Result<void> laidOut = layOutParameters(definition); !laidOut) return laidOut.error();
    return definition;
}

} // namespace filament_core::shader
