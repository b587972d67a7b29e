// SPDX-License-Identifier: Apache-2.0
#include "toolkit/json/JsonFile.h"

#include "filament_core/assets/files/FileBytes.h"

#include <nlohmann/json.hpp>

namespace filament_core::tools {

Result<Json> readJson(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return parseJson({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, file.string());
}

Result<void> writeJson(std::filesystem::path const& file, Json const& json, int indent) {
    const std::string text = jsonText(json, indent);
    return assets::replaceFile(file, std::as_bytes(std::span(text)));
}

} // namespace filament_core::tools
