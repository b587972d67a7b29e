// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/JsonText.h"

#include <nlohmann/json.hpp>

namespace filament_core::scenefile {
namespace {

constexpr size_t kMaxNesting = 256;

/// Brackets that are not in texts.
bool isTooDeep(std::string_view json) {
    size_t depth = 0;
    bool isInText = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (isInText && c == '\\') ++i;
        if (c == '"') isInText = !isInText;
        if (isInText) continue;
        if ((c == '[' || c == '{') && ++depth > kMaxNesting) return true;
        if ((c == ']' || c == '}') && depth > 0) --depth;
    }
    return false;
}

} // namespace

Result<Json> parseJson(std::string_view text, std::string_view name) {
    if (isTooDeep(text)) return fail(ErrorCode::Corrupt, "{}: nested deeper than {}", name, kMaxNesting);
    try {
        return Json::parse(text);
    } catch (Json::parse_error const& error) {
        return fail(ErrorCode::Corrupt, "{}: this is no JSON text: byte {} of {} is wrong", name, error.byte,
                    text.size());
    } catch (Json::exception const&) {
        return fail(ErrorCode::Corrupt, "{}: this is no JSON text: it has a number that is out of range", name);
    }
}

std::string jsonText(Json const& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace filament_core::scenefile
