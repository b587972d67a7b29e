// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/JsonReader.h"

#include "base/AsciiText.h"
#include "base/Suggest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::scenefile {

JsonReader::JsonReader(Json const& object, std::string where) : mObject(object), mWhere(std::move(where)) {
    if (!object.is_object()) mError = fail(ErrorCode::InvalidArgument, "{}: expected an object", mWhere);
}

Json JsonReader::describe(std::function<void(JsonReader&)> const& fill) {
    const Json nothing = Json::object();
    Json properties = Json::object();
    JsonReader reader(nothing, "");
    reader.mSchema = &properties;
    fill(reader);
    return { { "type", "object" }, { "additionalProperties", false }, { "properties", std::move(properties) } };
}

void JsonReader::add(const char* key, Json schema) { (*mSchema)[key] = std::move(schema); }

void JsonReader::addList(const char* key, Json elements) {
    add(key, { { "type", "array" }, { "items", std::move(elements) } });
}

void JsonReader::addObject(const char* key, std::function<void(JsonReader&)> const& fill) { add(key, describe(fill)); }

void JsonReader::addObjects(const char* key, std::function<void(JsonReader&)> const& fill, bool orTexts) {
    Json element = describe(fill);
    if (orTexts) element["type"] = { "object", "string" };
    addList(key, std::move(element));
}

std::optional<std::string> JsonReader::textOf(Json const& value) {
    return value.is_string() ? std::optional(value.get<std::string>()) : std::nullopt;
}

bool JsonReader::has(const char* key) { return mSchema || find(key) != nullptr; }

Json const* JsonReader::raw(const char* key, std::string_view schema) {
    if (mSchema) return add(key, Json::parse(schema)), nullptr;
    return find(key);
}

Json const* JsonReader::find(const char* key) {
    mKnown.push_back(key);
    if (!mObject.is_object()) return nullptr;
    const auto found = mObject.find(key);
    return found == mObject.end() ? nullptr : &*found;
}

void JsonReader::complain(const char* key, std::string const& what) {
    if (!mSchema && !mError) mError = fail(ErrorCode::InvalidArgument, "{}: {}: {}", mWhere, key, what);
}

void JsonReader::read(const char* key, bool& value) {
    if (mSchema) return add(key, { { "type", "boolean" } });
    Json const* found = find(key);
    if (!found) return;
    if (!found->is_boolean()) return complain(key, "expected true or false");
    value = found->get<bool>();
}

void JsonReader::read(const char* key, std::string& value) {
    if (mSchema) return add(key, { { "type", "string" } });
    Json const* found = find(key);
    if (!found) return;
    if (!found->is_string()) return complain(key, "expected a text");
    value = found->get<std::string>();
}

void JsonReader::read(const char* key, double& value, double low, double high) {
    if (mSchema) return add(key, { { "type", "number" }, { "minimum", low }, { "maximum", high } });
    Json const* found = find(key);
    if (!found) return;
    const double number = found->is_number() ? found->get<double>() : std::nan("");
    if (!(number >= low && number <= high))
        return complain(key, fmt::format("expected a number from {} to {}", low, high));
    value = number;
}

void JsonReader::read(const char* key, float& value, double low, double high) {
    double number = static_cast<double>(value);
    read(key, number, low, high);
    value = static_cast<float>(number);
}

void JsonReader::read(const char* key, uint32_t& value, uint32_t low, uint32_t high) {
    if (mSchema) return add(key, { { "type", "integer" }, { "minimum", low }, { "maximum", high } });
    double number = value;
    read(key, number, low, high);
    if (number != std::floor(number)) return complain(key, "expected a whole number");
    value = static_cast<uint32_t>(number);
}

void JsonReader::read(const char* key, std::vector<std::string>& values) {
    if (mSchema) return addList(key, { { "type", "string" } });
    Json const* found = find(key);
    if (!found) return;
    const bool texts =
            found->is_array() && std::all_of(found->begin(), found->end(), [](Json const& j) { return j.is_string(); });
    if (!texts) return complain(key, "expected a list of texts");
    values = found->get<std::vector<std::string>>();
}

void JsonReader::read(const char* key, std::vector<std::pair<std::string, std::string>>& values) {
    if (mSchema) return add(key, { { "type", "object" }, { "additionalProperties", { { "type", "string" } } } });
    Json const* found = find(key);
    if (!found) return;
    if (!found->is_object()) return complain(key, "expected an object of texts");
    for (auto const& [name, value] : found->items()) {
        if (!value.is_string()) return complain(key, fmt::format("'{}': expected a text", printable(name)));
        values.emplace_back(name, value.get<std::string>());
    }
}

std::optional<size_t> JsonReader::choice(const char* key, std::span<const std::string_view> words) {
    if (mSchema) return add(key, { { "enum", std::vector<std::string>(words.begin(), words.end()) } }), std::nullopt;
    std::string word;
    read(key, word);
    if (word.empty()) return std::nullopt;
    const auto found = std::ranges::find(words, word);
    if (found != words.end()) return found - words.begin();
    complain(key, fmt::format("'{}' is not known; {}", printable(word), listed(words)));
    return std::nullopt;
}

std::vector<Json const*> JsonReader::list(const char* key) {
    std::vector<Json const*> elements;
    Json const* found = find(key);
    if (!found) return elements;
    if (!found->is_array()) {
        complain(key, "expected a list");
        return elements;
    }
    for (Json const& element : *found) elements.push_back(&element);
    return elements;
}

void JsonReader::numbers(const char* key, double* values, size_t count, double low, double high) {
    if (mSchema) {
        const Json number{ { "type", "number" }, { "minimum", low }, { "maximum", high } };
        return add(key, { { "type", "array" }, { "items", number }, { "minItems", count }, { "maxItems", count } });
    }
    Json const* found = find(key);
    if (!found) return;
    const bool fits = found->is_array() && found->size() == count &&
                      std::all_of(found->begin(), found->end(), [](Json const& j) { return j.is_number(); });
    if (!fits) return complain(key, fmt::format("expected a list of {} numbers", count));
    const bool isInRange = std::all_of(found->begin(), found->end(), [&](Json const& j) {
        return j.get<double>() >= low && j.get<double>() <= high;
    });
    if (!isInRange) return complain(key, fmt::format("expected {} numbers from {} to {}", count, low, high));
    for (size_t i = 0; i < count; ++i) values[i] = (*found)[i].get<double>();
}

Result<void> JsonReader::finish() {
    if (mError) return *mError;
    for (auto const& [key, value] : mObject.items()) {
        if (std::find(mKnown.begin(), mKnown.end(), key) != mKnown.end()) continue;
        return fail(ErrorCode::InvalidArgument, "{}: '{}' is not a field here{}", mWhere, printable(key),
                    suggestion(key, mKnown));
    }
    return {};
}

} // namespace filament_core::scenefile
