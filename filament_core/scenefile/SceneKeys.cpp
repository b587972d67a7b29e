// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/SceneKeys.h"

#include "base/AsciiText.h"
#include "filament_core/scenefile/JsonText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>

namespace filament_core::scenefile {
namespace {

constexpr size_t kMostPlace = 1'000'000;

Json const* member(Json const* object, std::string_view name) {
    if (!object || !object->is_object()) return nullptr;
    const auto found = object->find(std::string(name));
    return found == object->end() ? nullptr : &*found;
}

Json const* element(Json const* list, size_t place) {
    return list && list->is_array() && place < list->size() ? &(*list)[place] : nullptr;
}

bool isOfType(Json const* schema, std::string_view type) {
    Json const* said = member(schema, "type");
    return said && ((said->is_string() && *said == type) ||
                    (said->is_array() && std::ranges::any_of(*said, [&](Json const& one) { return one == type; })));
}

bool hasParts(Json const* value, Json const* schema) {
    return (value && value->is_structured()) || isOfType(schema, "object") || isOfType(schema, "array");
}

/// "3]" and what follows.
Result<size_t> readPlace(std::string_view& rest, std::string_view key) {
    size_t place = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), place);
    const auto digits = static_cast<size_t>(end - rest.data());
    if (error != std::errc{} || digits == rest.size() || *end != ']' || place > kMostPlace)
        return fail(ErrorCode::InvalidArgument, "{}: expected a place in a list, such as [0]", printable(key));
    rest.remove_prefix(digits + 1);
    return place;
}

/// Points at `tree`, `schema` and what is below them.
struct Place {
    Json const* tree;
    Json const* schema;

    void enter(std::string_view name) {
        tree = member(tree, name);
        schema = member(member(schema, "properties"), name);
    }
    void enter(size_t place) {
        tree = element(tree, place);
        schema = member(schema, "items");
    }
};

/// The member that `rest` begins with.
std::string_view memberOf(std::string_view rest, Place const& at) {
    const std::string_view name = rest.substr(0, rest.find_first_of(".["));
    Place inside = at;
    inside.enter(name);
    return name.size() < rest.size() && hasParts(inside.tree, inside.schema) ? name : rest;
}

Error noList(std::string_view what) {
    return fail(ErrorCode::InvalidArgument, "{}: expected a key whose parts are objects and lists of the scene file",
                what);
}

} // namespace

Result<Key> parseKey(std::string_view key, Json const& tree, Json const& schema) {
    Key parsed;
    Place at{ &tree, &schema };
    std::string_view rest = key;
    while (!rest.empty()) {
        KeyStep& step = parsed.steps.emplace_back();
        if (rest.front() == '[') {
            rest.remove_prefix(1);
            const Result<size_t> place = readPlace(rest, key);
            if (!place) return place.error();
            step = { .place = *place, .isPlace = true };
            at.enter(*place);
        } else {
            const std::string_view name = memberOf(rest, at);
            step.member = name;
            at.enter(name);
            rest.remove_prefix(name.size());
        }
        if (rest.size() > 1 && rest.front() == '.') rest.remove_prefix(1);
    }
    if (parsed.steps.empty()) return fail(ErrorCode::InvalidArgument, "expected a key, such as camera.eye");
    parsed.schema = at.schema;
    return parsed;
}

Json const* find(Json const& tree, Key const& key) {
    Json const* at = &tree;
    for (KeyStep const& step : key.steps) at = step.isPlace ? element(at, step.place) : member(at, step.member);
    return at;
}

Json valueOf(std::string_view words, Json const* schema) {
    const std::string text(words);
    Result<Json> json = parseJson(words, "value");
    if (json && !(isOfType(schema, "string") && !json->is_string() && !json->is_object())) return std::move(*json);
    if (isOfType(schema, "boolean") && (text == "on" || text == "off")) return text == "on";
    if (isOfType(schema, "array")) {
        Result<Json> list = parseJson("[" + text + "]", "value");
        if (list) return std::move(*list);
    }
    return text;
}

Result<void> put(Json& tree, Key const& key, Json value) {
    Json* at = &tree;
    for (KeyStep const& step : key.steps) {
        if (at->is_null()) *at = step.isPlace ? Json::array() : Json::object();
        if (!step.isPlace) {
            if (!at->is_object()) return noList(printable(step.member));
            at = &(*at)[step.member];
            continue;
        }
        if (!at->is_array()) return noList(fmt::format("[{}]", step.place));
        if (step.place > at->size())
            return fail(ErrorCode::InvalidArgument, "[{}]: the list has {} elements", step.place, at->size());
        if (step.place == at->size()) at->push_back(nullptr);
        at = &(*at)[step.place];
    }
    *at = std::move(value);
    return {};
}

bool take(Json& tree, Key const& key) {
    if (!find(tree, key)) return false;
    Json* at = &tree;
    for (size_t i = 0; i + 1 < key.steps.size(); ++i)
        at = key.steps[i].isPlace ? &(*at)[key.steps[i].place] : &(*at)[key.steps[i].member];
    KeyStep const& last = key.steps.back();
    if (last.isPlace)
        at->erase(last.place);
    else
        at->erase(last.member);
    return true;
}

} // namespace filament_core::scenefile
