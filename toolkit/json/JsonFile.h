// SPDX-License-Identifier: Apache-2.0
/// JsonFile: JSON texts and files as trees.
///   Limits  arrays and objects nested in each other up to 256 deep: trees are written and destroyed by as many calls.
///   Fails   parseJson(): Corrupt with the name and the byte. Files: Unreadable with the path.
///   Thread  any.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filesystem>

namespace filament_core::tools {

/// `name`: begins the message.
Result<Json> parseJson(std::string_view text, std::string_view name);
Result<Json> readJson(std::filesystem::path const& file);
/// With a line break at its end; what is no UTF-8 is replaced. `indent`: spaces a level.
std::string jsonText(Json const& json, int indent = 1);
/// Replaces the file at once, so that no reader sees half of it.
Result<void> writeJson(std::filesystem::path const& file, Json const& json, int indent = 2);

} // namespace filament_core::tools
