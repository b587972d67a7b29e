// SPDX-License-Identifier: Apache-2.0
/// JsonText: JSON texts as trees.
///   Limits  arrays and objects nested in each other up to 256 deep: trees are written and destroyed by as many calls.
///   Fails   parseJson(): Corrupt with the name and the byte.
///   Thread  any.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

namespace filament_core::scenefile {

/// `name`: begins the message.
Result<Json> parseJson(std::string_view text, std::string_view name);
/// With a line break at its end; what is no UTF-8 is replaced. `indent`: spaces a level.
std::string jsonText(Json const& json, int indent = 1);

} // namespace filament_core::scenefile
