// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/files/JsonTree.h"

#include "filament_core/assets/files/NoIndex.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::assets {

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
    // Some exporters write counts as "24.0", so integral doubles are accepted.
    const double value = mValue->is_number() ? mValue->get<double>() : -1.0;
    if (value >= 0 && value <= kLargest && std::floor(value) == value) return static_cast<uint64_t>(value);
    if (value > kLargest)
        mDiagnostics->refuse(ErrorCode::Corrupt, "{}: {:.17g} is beyond 2^53, the largest integer of JSON", mPath,
                             value);
    else
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

std::string JsonNode::label() const {
    if (!mValue || mValue->is_string()) return text();
    mDiagnostics->warn("{}: must be a string, found {}; it is ignored", mPath, mValue->type_name());
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
    constexpr float kMost = std::numeric_limits<float>::max();
    for (JsonNode const& element : elements()) values.push_back(element.numberInRange(0, -kMost, kMost));
    return values;
}

namespace {

/// Of an object: the elements of the array `key`, all of which `isWanted` accepts; else nothing.
template <class T>
std::vector<T> listOf(json const* object, const char* key, bool (json::*isWanted)() const noexcept) {
    if (!object || !object->is_object()) return {};
    const auto member = object->find(key);
    if (member == object->end() || !member->is_array()) return {};
    std::vector<T> list;
    for (json const& element : *member) {
        if (!(element.*isWanted)()) return {};
        list.push_back(element.get<T>());
    }
    return list;
}

} // namespace

std::vector<std::string> JsonNode::textsOf(const char* key) const {
    return listOf<std::string>(mValue, key, &json::is_string);
}

std::vector<double> JsonNode::numbersOf(const char* key) const { return listOf<double>(mValue, key, &json::is_number); }

void JsonNode::refuse(std::string_view expected) const {
    const char* found = mValue ? mValue->type_name() : "nothing";
    mDiagnostics->refuse(ErrorCode::Corrupt, "{}: must be {}, found {}", mPath.empty() ? "the file" : mPath, expected,
                         found);
}

namespace {

/// Builds a tree from the parser's events, down to kMaxDepth.
class ShallowBuilder {
public:
    static constexpr size_t kMaxDepth = 64; // glTF's own fields reach a depth of 10

    explicit ShallowBuilder(json& root) : mTree(root) {}

    bool null() { return isTooDeep() || mTree.null(); }
    bool boolean(bool value) { return isTooDeep() || mTree.boolean(value); }
    bool number_integer(json::number_integer_t value) { return isTooDeep() || mTree.number_integer(value); }
    bool number_unsigned(json::number_unsigned_t value) { return isTooDeep() || mTree.number_unsigned(value); }
    bool number_float(json::number_float_t value, json::string_t const& text) {
        return isTooDeep() || mTree.number_float(value, text);
    }
    bool string(json::string_t& value) { return isTooDeep() || mTree.string(value); }
    bool binary(json::binary_t& value) { return isTooDeep() || mTree.binary(value); }
    bool key(json::string_t& value) { return isTooDeep() || mTree.key(value); }
    bool start_object(size_t count) { return ++mDepth <= kMaxDepth ? mTree.start_object(count) : nullOnce(); }
    bool start_array(size_t count) { return ++mDepth <= kMaxDepth ? mTree.start_array(count) : nullOnce(); }
    bool end_object() { return mDepth-- > kMaxDepth || mTree.end_object(); }
    bool end_array() { return mDepth-- > kMaxDepth || mTree.end_array(); }
    template <class Exception>
    bool parse_error(size_t byte, std::string const& token, Exception const& exception) {
        return mTree.parse_error(byte, token, exception);
    }

private:
    bool isTooDeep() const { return mDepth > kMaxDepth; }
    bool nullOnce() { return mDepth > kMaxDepth + 1 || mTree.null(); }

    nlohmann::detail::json_sax_dom_parser<json> mTree;
    size_t mDepth = 0;
};

// The library's destructor allocates if there are elements left, and terminates the process if that fails.
void takeApart(json& value) {
    if (value.is_structured()) {
        for (json& child : value) takeApart(child);
        value.clear();
    }
}

} // namespace

void JsonTree::TakeApart::operator()(json* value) const {
    takeApart(*value);
    delete value;
}

JsonTree::JsonTree(std::span<const std::byte> text, Diagnostics& diagnostics) : mValue(new json) {
    auto const* first = reinterpret_cast<const char*>(text.data());
    try {
        ShallowBuilder builder(*mValue);
        json::sax_parse(first, first + text.size(), &builder);
    } catch (json::parse_error const& error) {
        diagnostics.refuse(ErrorCode::Corrupt, "the JSON is broken at byte {}", error.byte);
    } catch (json::exception const&) { // a number beyond the range of double
        diagnostics.refuse(ErrorCode::Corrupt, "the JSON has a number beyond the range of double");
    }
    if (!mValue->is_object()) diagnostics.refuse(ErrorCode::Corrupt, "the JSON is not an object");
}

JsonNode JsonTree::root(Diagnostics& diagnostics) const { return { mValue.get(), {}, diagnostics }; }

} // namespace filament_core::assets
