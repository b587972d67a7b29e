// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadOptions.h"

#include <nlohmann/json.hpp>

#include <string>

namespace filament_core::scenefile {
namespace {

/// As setOption() takes it.
std::string optionText(Json const& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    if (!value.is_array()) return value.dump();
    std::string text;
    for (Json const& element : value) {
        if (!text.empty()) text += ',';
        text += element.is_number() ? element.dump() : "?";
    }
    return text;
}

Json optionSchema(Option const& option) {
    const std::string words(option.description);
    if (option.kind == OptionKind::Switch)
        return { { "description", words }, { "enum", { true, false, "on", "off" } } };
    if (option.kind == OptionKind::Choice)
        return { { "description", words },
                 { "enum", std::vector<std::string>(option.values.begin(), option.values.end()) } };
    Json number{ { "type", option.kind == OptionKind::Integer ? "integer" : "number" },
                 { "minimum", option.least },
                 { "maximum", option.most } };
    const Json text{ { "type", "string" }, { "pattern", "^[-+0-9.eE, ]+$" } }; // numbers as words
    Json schema{ { "description", words }, { "anyOf", Json::array({ number, text }) } };
    if (option.components > 1)
        schema["anyOf"].push_back({ { "type", "array" },
                                    { "items", number },
                                    { "minItems", option.components },
                                    { "maxItems", option.components } });
    return schema;
}

} // namespace

void readOption(JsonReader& reader, Option const& option, std::span<const Option> options, void* object) {
    const char* const key = option.name.data(); // a literal
    if (reader.isDescribing()) {
        reader.raw(key, optionSchema(option).dump());
        return;
    }
    Json const* value = reader.raw(key);
    if (!value) return;
    const Result<void> done = setOption(options, object, option.name, optionText(*value));
    if (!done) reader.complain(key, done.error().message);
}

Json optionJson(Option const& option, void const* object) {
    const std::string text = optionValue(option, object);
    if (option.kind == OptionKind::Switch) return text == "on";
    if (option.kind == OptionKind::Choice) return text;
    const Json value = Json::parse("[" + text + "]", nullptr, false);
    if (value.is_discarded()) return text; // a number that JSON has no word for
    return value.size() == 1 ? value[0] : value;
}

} // namespace filament_core::scenefile
