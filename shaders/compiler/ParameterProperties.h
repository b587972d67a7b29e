// SPDX-License-Identifier: Apache-2.0
/// The list properties of a material: parameters, constants, variables, requires, variantFilter (materials guide, 4.2).
///   Fails   as MaterialDefinition.h says.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <string_view>
#include <vector>

namespace filament::shader {

Result<void> readParameters(JsonValue const& value, MaterialDefinition& out);
Result<void> readConstants(JsonValue const& value, MaterialDefinition& out);
Result<void> readVariables(JsonValue const& value, MaterialDefinition& out);
Result<void> readRequires(JsonValue const& value, MaterialDefinition& out);
Result<void> readVariantFilter(JsonValue const& value, MaterialDefinition& out);

/// Assigns bindings and std140 offsets once all parameters are known and there are not too many (DefinitionRules.h).
/// Fails: too many bytes.
/// What the lists may hold, for documents and editors.
std::vector<std::string_view> parameterTypeNames();
std::vector<std::string_view> attributeNames();

Result<void> layOutParameters(MaterialDefinition& definition);

} // namespace filament::shader
