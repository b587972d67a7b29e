// SPDX-License-Identifier: Apache-2.0
/// JsonFile: JSON texts and files as trees.
///   Fails   parseJson(): Corrupt with the name and the byte. Files: Unreadable with the path.
///   Thread  any.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filesystem>

namespace filament_core::tools {

/// `name`: begins the message.
Result<Json> parseJson(std::string_view text, std::string_view name);
Result<Json> readJson(std::filesystem::path const& file);
/// Replaces the file at once, so that no reader sees half of it.
Result<void> writeJson(std::filesystem::path const& file, Json const& json);

} // namespace filament_core::tools
