// SPDX-License-Identifier: Apache-2.0
/// JsonFile: JSON texts (JsonText.h) and files as trees.
///   Fails   Unreadable with the path, and as parseJson().
///   Thread  any.
#pragma once

#include "filament_core/scenefile/JsonText.h"
#include "toolkit/json/JsonReader.h"

#include <filesystem>

namespace filament_core::tools {

using scenefile::jsonText;
using scenefile::parseJson;

Result<Json> readJson(std::filesystem::path const& file);
/// Replaces the file at once, so that no reader sees half of it.
Result<void> writeJson(std::filesystem::path const& file, Json const& json, int indent = 2);

} // namespace filament_core::tools
