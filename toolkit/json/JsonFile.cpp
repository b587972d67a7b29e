// SPDX-License-Identifier: Apache-2.0
#include "toolkit/json/JsonFile.h"

#include "filament_core/assets/files/FileBytes.h"

#include <nlohmann/json.hpp>

namespace filament_core::tools {

Result<Json> parseJson(std::string_view text, std::string_view name) {
    try {
        return Json::parse(text);
    } catch (Json::parse_error const& error) {
        return fail(ErrorCode::Corrupt, "{}: this is no JSON text: byte {} of {} is wrong", name, error.byte,
                    text.size());
    } catch (Json::exception const&) {
        return fail(ErrorCode::Corrupt, "{}: this is no JSON text: it has a number that is out of range", name);
    }
}

Result<Json> readJson(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    return parseJson({ reinterpret_cast<const char*>(bytes->data()), bytes->size() }, file.string());
}

Result<void> writeJson(std::filesystem::path const& file, Json const& json) {
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
    return assets::replaceFile(file, std::as_bytes(std::span(text)));
}

} // namespace filament_core::tools
