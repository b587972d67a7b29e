// SPDX-License-Identifier: Apache-2.0
/// The properties of a material that are one value: enumerators, switches and numbers (materials guide, 4.2).
///   Out     the table of all properties that are not lists: each is read, and described for documents, by its row.
///   Fails   as MaterialDefinition.h says.
#pragma once

#include "shaders/compiler/MaterialDefinition.h"

#include <span>
#include <string>
#include <string_view>

namespace filament_core::shader {

struct StateProperty {
    std::string_view name;
    std::string_view meaning; ///< one line of Markdown
    Result<void> (*read)(JsonValue const& value, std::string_view name, MaterialDefinition& out);
    std::string (*values)();                                    ///< what it may be: "opaque, masked, add"
    std::string (*shown)(MaterialDefinition const& definition); ///< what it is, as authors write it
};

std::span<const StateProperty> stateProperties();

} // namespace filament_core::shader
