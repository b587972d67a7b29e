// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslSuggestions.h"

#include "base/Suggest.h"
#include "shaders/compiler/MaterialMembers.h"

#include <algorithm>

namespace filament::shader {
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

} // namespace

Error withSuggestion(Error error, MaterialDefinition const& definition) {
    const bool isOverload = error.message.find("no matching overloaded function") != std::string::npos;
    if (isOverload) error.message += aboutCurrentPixel(definition);
    const bool isField = error.message.find("no such field in structure") != std::string::npos;
    const bool isIdentifier = error.message.find("undeclared identifier") != std::string::npos;
    if (!isField && !isIdentifier) return error;
    const std::vector<std::string> names = isField ? fieldsOf(definition) : identifiersOf(definition);
    const std::vector<std::string_view> known(names.begin(), names.end());
    error.message += suggestion(quotedWord(error.message), known);
    return error;
}

} // namespace filament::shader
