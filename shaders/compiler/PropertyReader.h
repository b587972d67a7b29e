// SPDX-License-Identifier: Apache-2.0
/// Typed access to JsonValues: each function returns the value, or an error that tells the author what to write
/// instead.
///   Names of values are compared without regard to case (materials guide, 4.1.1).
#pragma once

#include "base/Suggest.h"
#include "shaders/compiler/Jsonish.h"
#include "shaders/compiler/MaterialDefinition.h"

#include <span>
#include <string>
#include <utility>

namespace filament_core::shader {

bool equalIgnoringCase(std::string_view a, std::string_view b);

Result<void> expectKind(JsonValue const& value, JsonValue::Kind kind, std::string_view what);
Result<void> readBool(JsonValue const& value, std::string_view what, bool& out);
/// An error for numbers outside [low, high].
Result<void> readNumber(JsonValue const& value, std::string_view what, float low, float high, float& out);
/// A GLSL identifier that does not collide with the engine's prefixes.
Result<void> readIdentifier(JsonValue const& value, std::string_view what, std::string& out);
Result<void> readPrecision(JsonValue const& value, Precision& out);
/// The member of an object, or null.
JsonValue const* findMember(JsonValue const& object, std::string_view key);
/// An error for members of `object` that are not listed; a warning for those that the engine does without.
Result<void> expectOnly(JsonValue const& object, std::span<const std::string_view> known, std::string_view what,
                        std::vector<std::string>& warnings);

Error unknownName(JsonValue const& value, std::string_view what, std::span<const std::string_view> known);

template <class E, size_t N>
Result<void> readEnum(JsonValue const& value, std::string_view what, std::pair<std::string_view, E> const (&names)[N],
                      E& out) {
    if (Result<void> isString = expectKind(value, JsonValue::Kind::String, what); !isString) return isString;
    std::vector<std::string_view> known;
    for (auto const& [name, enumerator] : names) {
        known.push_back(name);
        if (!equalIgnoringCase(value.text, name)) continue;
        out = enumerator;
        return {};
    }
    return unknownName(value, what, known);
}

} // namespace filament_core::shader
