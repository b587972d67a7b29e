// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/GltfJson.h"

#include "filament_core/assets/ModelData.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace filament::assets {

using nlohmann::json;

JsonNode JsonNode::operator[](const char* key) const {
    std::string path = mPath.empty() ? std::string(key) : fmt::format("{}.{}", mPath, key);
    if (!mValue) return { nullptr, std::move(path), *mDiagnostics };
    if (!mValue->is_object()) {
        refuse("an object");
        return { nullptr, std::move(path), *mDiagnostics };
    }
    const auto found = mValue->find(key);
    return { found == mValue->end() ? nullptr : &*found, std::move(path), *mDiagnostics };
}

JsonNode JsonNode::extension(const char* name) const { return (*this)["extensions"][name]; }

std::vector<JsonNode> JsonNode::elements() const {
    std::vector<JsonNode> nodes;
    const size_t count = elementCount();
    nodes.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        nodes.emplace_back(&(*mValue)[i], fmt::format("{}[{}]", mPath, i), *mDiagnostics);
    }
    return nodes;
}

size_t JsonNode::elementCount() const {
    if (!mValue) return 0;
    if (mValue->is_array()) return mValue->size();
    refuse("an array");
    return 0;
}

void JsonNode::forEachMember(std::function<void(std::string const&, JsonNode const&)> const& visit) const {
    if (!mValue) return;
    if (!mValue->is_object()) return refuse("an object");
    for (auto const& [key, value] : mValue->items()) {
        visit(key, JsonNode(&value, fmt::format("{}.{}", mPath, key), *mDiagnostics));
    }
}

double JsonNode::number(double fallback) const {
    if (!mValue) return fallback;
    if (mValue->is_number()) return mValue->get<double>();
    refuse("a number");
    return fallback;
}

float JsonNode::numberInRange(float fallback, float low, float high) const {
    const double value = number(fallback);
    if (value >= low && value <= high) return static_cast<float>(value);
    const float clamped = value < low ? low : high;
    mDiagnostics->warn("{}: {} is outside [{}, {}] and was clamped", mPath, value, low, high);
    return clamped;
}

uint64_t JsonNode::integer(uint64_t fallback) const {
    if (!mValue) return fallback;
    constexpr double kLargest = 9007199254740992.0; // 2^53
    // Some exporters write counts as "24.0": integral doubles are accepted.
    const double value = mValue->is_number() ? mValue->get<double>() : -1.0;
    if (value >= 0 && value <= kLargest && std::floor(value) == value) return static_cast<uint64_t>(value);
    refuse("a non-negative integer");
    return fallback;
}

uint64_t JsonNode::requiredInteger() const {
    if (!mValue) refuse("a non-negative integer");
    return integer(0);
}

bool JsonNode::boolean(bool fallback) const {
    if (!mValue) return fallback;
    if (mValue->is_boolean()) return mValue->get<bool>();
    refuse("true or false");
    return fallback;
}

std::string JsonNode::text() const {
    if (!mValue) return {};
    if (mValue->is_string()) return mValue->get<std::string>();
    refuse("a string");
    return {};
}

uint32_t JsonNode::index(size_t count, std::string_view what) const {
    if (!mValue) return kNone;
    const uint64_t value = integer(count);
    if (value < count) return static_cast<uint32_t>(value);
    mDiagnostics->refuse(ErrorCode::Corrupt, "{}: index {} is out of range, the file has {} {}", mPath, value, count,
                         what);
    return kNone;
}

uint32_t JsonNode::requiredIndex(size_t count, std::string_view what) const {
    if (!mValue) mDiagnostics->refuse(ErrorCode::Corrupt, "{}: missing, must be an index into {}", mPath, what);
    return index(count, what);
}

bool JsonNode::numbers(std::span<double> values) const {
    if (!mValue) return false;
    const bool isList =
            mValue->is_array() && mValue->size() == values.size() &&
            std::all_of(mValue->begin(), mValue->end(), [](json const& element) { return element.is_number(); });
    if (!isList) {
        refuse(fmt::format("an array of {} numbers", values.size()));
        return false;
    }
    for (size_t i = 0; i < values.size(); ++i) values[i] = (*mValue)[i].get<double>();
    return true;
}

std::vector<float> JsonNode::numberList() const {
    std::vector<float> values;
    for (JsonNode const& element : elements()) values.push_back(static_cast<float>(element.number(0)));
    return values;
}

void JsonNode::refuse(std::string_view expected) const {
    const char* found = mValue ? mValue->type_name() : "nothing";
    mDiagnostics->refuse(ErrorCode::Corrupt, "{}: must be {}, found {}", mPath.empty() ? "the file" : mPath, expected,
                         found);
}

JsonTree::JsonTree(std::span<const std::byte> text, GltfDiagnostics& diagnostics) : mValue(std::make_unique<json>()) {
    auto const* first = reinterpret_cast<const char*>(text.data());
    try {
        *mValue = json::parse(first, first + text.size());
    } catch (json::parse_error const& error) {
        diagnostics.refuse(ErrorCode::Corrupt, "the JSON is broken at byte {}", error.byte);
    } catch (json::exception const&) { // a number beyond double
        diagnostics.refuse(ErrorCode::Corrupt, "the JSON holds a number that no double can");
    }
    if (!mValue->is_object()) diagnostics.refuse(ErrorCode::Corrupt, "the JSON is not an object");
}

JsonTree::~JsonTree() = default;

JsonNode JsonTree::root(GltfDiagnostics& diagnostics) const { return { mValue.get(), {}, diagnostics }; }

} // namespace filament::assets
