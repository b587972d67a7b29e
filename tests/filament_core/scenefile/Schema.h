// SPDX-License-Identifier: Apache-2.0
/// What a JSON schema says of a value, for the keywords that SceneFile::schema() has; an unknown one is an error.
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace filament_core::test {

using Tree = nlohmann::ordered_json;

inline bool hasType(Tree const& value, std::string const& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer")
        return value.is_number_integer() || (value.is_number() && value == std::floor(value.get<double>()));
    throw std::runtime_error("unknown type " + type);
}

inline bool accepts(Tree const& schema, Tree const& value);

inline bool acceptsMembers(Tree const& schema, Tree const& value) {
    if (!value.is_object()) return true;
    return std::ranges::all_of(value.items(), [&](auto const& member) {
        if (schema.contains("properties") && schema["properties"].contains(member.key()))
            return accepts(schema["properties"][member.key()], member.value());
        if (!schema.contains("additionalProperties")) return true;
        Tree const& other = schema["additionalProperties"];
        return other.is_boolean() ? other.get<bool>() : accepts(other, member.value());
    });
}

inline bool acceptsElements(Tree const& schema, Tree const& value) {
    if (!value.is_array()) return true;
    if (schema.contains("minItems") && value.size() < schema["minItems"]) return false;
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return false;
    return !schema.contains("items") ||
           std::ranges::all_of(value, [&](Tree const& one) { return accepts(schema["items"], one); });
}

inline bool accepts(Tree const& schema, Tree const& value) {
    static const std::set<std::string> known{
        "$schema", "title",   "description", "type",  "enum",     "anyOf",   "properties",
        "minimum", "maximum", "minItems",    "items", "maxItems", "pattern", "additionalProperties"
    };
    for (auto const& word : schema.items())
        if (!known.contains(word.key())) throw std::runtime_error("unknown keyword " + word.key());
    if (schema.contains("type")) {
        Tree const& type = schema["type"];
        const bool fits = type.is_string()
                                  ? hasType(value, type)
                                  : std::ranges::any_of(type, [&](Tree const& t) { return hasType(value, t); });
        if (!fits) return false;
    }
    if (schema.contains("enum") && std::ranges::find(schema["enum"], value) == schema["enum"].end()) return false;
    if (schema.contains("anyOf") &&
        std::ranges::none_of(schema["anyOf"], [&](Tree const& one) { return accepts(one, value); }))
        return false;
    if (value.is_number() && schema.contains("minimum") && value < schema["minimum"]) return false;
    if (value.is_number() && schema.contains("maximum") && value > schema["maximum"]) return false;
    if (value.is_string() && schema.contains("pattern") &&
        !std::regex_search(value.get<std::string>(), std::regex(schema["pattern"].get<std::string>())))
        return false;
    return acceptsMembers(schema, value) && acceptsElements(schema, value);
}

} // namespace filament_core::test
