// SPDX-License-Identifier: Apache-2.0
/// The properties of a material that are one value: enumerators, switches and numbers (materials guide, 4.2).
///   Out     the table of all properties that are not lists, each with its reading function.
///   Fails   as MaterialDefinition.h says.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <span>
#include <string>
#include <string_view>

namespace filament::shader {

struct StateProperty {
    std::string_view name;
    Result<void> (*read)(JsonValue const& value, std::string_view name, MaterialDefinition& out);
    std::string (*values)() = nullptr; ///< what it may be, for documents: "opaque, masked, add"
};

std::span<const StateProperty> stateProperties();

} // namespace filament::shader
