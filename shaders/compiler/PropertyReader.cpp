// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/PropertyReader.h"

#include "shaders/compiler/IgnoredNames.h"

#include <algorithm>
#include <cctype>

namespace filament_core::shader {
namespace {

bool isIdentifierCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

} // namespace

bool equalIgnoringCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b,
                              [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

Result<void> expectKind(JsonValue const& value, JsonValue::Kind kind, std::string_view what) {
    if (value.kind == kind) return {};
    return errorAt(value.at, fmt::format("'{}' must be {}, not {}", what, toString(kind), toString(value.kind)));
}

Result<void> readBool(JsonValue const& value, std::string_view what, bool& out) {
    if (Result<void> isBool = expectKind(value, JsonValue::Kind::Bool, what); !isBool) return isBool;
    out = value.boolean;
    return {};
}

Result<void> readNumber(JsonValue const& value, std::string_view what, float low, float high, float& out) {
    if (Result<void> isNumber = expectKind(value, JsonValue::Kind::Number, what); !isNumber) return isNumber;
    if (!(value.number >= static_cast<double>(low) && value.number <= static_cast<double>(high))) {
        return errorAt(value.at, fmt::format("'{}' must lie in [{}, {}], it is {}", what, low, high, value.text));
    }
    out = static_cast<float>(value.number);
    return {};
}

Result<void> readIdentifier(JsonValue const& value, std::string_view what, std::string& out) {
    // A parameter called "true" would have another kind than string; it is refused here as it would be by GLSL.
    if (Result<void> isString = expectKind(value, JsonValue::Kind::String, what); !isString) return isString;
    std::string const& name = value.text;
    const bool isIdentifier = !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                              std::ranges::all_of(name, isIdentifierCharacter);
    const bool isReserved = name.starts_with("gl_") || name.find("__") != std::string::npos ||
                            name == kMaskThresholdParameter || name == kDoubleSidedParameter;
    if (!isIdentifier || isReserved || name.size() > 128) {
        return errorAt(value.at, fmt::format("{} \"{}\" is not a usable GLSL identifier", what, name.substr(0, 128)));
    }
    out = name;
    return {};
}

Result<void> readPrecision(JsonValue const& value, Precision& out) {
    static constexpr std::pair<std::string_view, Precision> kNames[] = { { "default", Precision::Default },
                                                                         { "low", Precision::Low },
                                                                         { "medium", Precision::Medium },
                                                                         { "high", Precision::High } };
    return readEnum(value, "precision", kNames, out);
}

JsonValue const* findMember(JsonValue const& object, std::string_view key) {
    for (auto const& [name, value] : object.members) {
        if (name == key) return &value;
    }
    return nullptr;
}

Result<void> expectOnly(JsonValue const& object, std::span<const std::string_view> known, std::string_view what,
                        std::vector<std::string>& warnings) {
    for (auto const& [name, value] : object.members) {
        if (std::ranges::count(known, name) > 0) continue;
        const Result<bool> isIgnored = ignores(what, name, value, warnings);
        if (!isIgnored) return isIgnored.error();
        if (!*isIgnored)
            return errorAt(value.at, fmt::format("{} has no field '{}'{}", what, name, suggestion(name, known)));
    }
    return {};
}

Error unknownName(JsonValue const& value, std::string_view what, std::span<const std::string_view> known) {
    return errorAt(value.at, fmt::format("'{}' cannot be '{}'{}", what, value.text, suggestion(value.text, known)));
}

} // namespace filament_core::shader
