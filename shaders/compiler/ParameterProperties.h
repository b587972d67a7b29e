// SPDX-License-Identifier: Apache-2.0
/// The list properties of a material: parameters, constants, variables, requires, variantFilter (materials guide, 4.2).
///   Fails   as MaterialDefinition.h says.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <span>
#include <string_view>
#include <vector>

namespace filament_core::shader {

struct ListProperty {
    std::string_view name;
    std::span<const std::string_view> fields; ///< of an entry; none: an entry is a word
    std::string_view meaning;                 ///< of an entry, one line of Markdown
    std::string_view inCode;                  ///< what the blocks call an entry, Markdown; empty: nothing
    size_t limit;                             ///< the largest number of entries
    Result<void> (*readEntry)(JsonValue const& entry, MaterialDefinition& out);
};

std::span<const ListProperty> listProperties();
Result<void> readList(JsonValue const& value, ListProperty const& property, MaterialDefinition& out);

/// What the lists may hold, for documents and editors.
std::vector<std::string_view> parameterTypeNames();
std::vector<std::string_view> attributeNames();

/// Assigns bindings and std140 offsets once all parameters are known and there are not too many (DefinitionRules.h).
/// Fails: too many bytes.
Result<void> layOutParameters(MaterialDefinition& definition);

} // namespace filament_core::shader
