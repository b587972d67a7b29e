// SPDX-License-Identifier: Apache-2.0
/// EnumNames: the words of enumerations, as options, files and command lines have them: the enumerators in lower camel
/// case. Each enumeration that has words lists them beside its definition, in the order of its enumerators.
///   toString(SplitSum::Table)          "table"
///   enumFromName<SplitSum>("table")    SplitSum::Table; nothing for a word that is not one of its names
///   enumNames<SplitSum>()              all of them
///   Thread   any.   Memory: none.   Fails: never.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace filament_core {

/// Specialised for each enumeration with names: `static constexpr std::array values`, literals.
template <class E>
struct EnumNames;

template <class E>
concept NamedEnum = std::is_enum_v<E> && requires {
    EnumNames<E>::values.size();
};

template <NamedEnum E>
constexpr std::span<const std::string_view> enumNames() {
    return EnumNames<E>::values;
}

template <NamedEnum E>
constexpr const char* toString(E value) {
    return EnumNames<E>::values[static_cast<size_t>(value)].data();
}

template <NamedEnum E>
constexpr std::optional<E> enumFromName(std::string_view name) {
    const auto found = std::ranges::find(EnumNames<E>::values, name);
    if (found == EnumNames<E>::values.end()) return std::nullopt;
    return static_cast<E>(found - EnumNames<E>::values.begin());
}

/// "a, b or c", for help texts and errors.
std::string listed(std::span<const std::string_view> names);

} // namespace filament_core
