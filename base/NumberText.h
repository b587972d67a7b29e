// SPDX-License-Identifier: Apache-2.0
/// numberOf: a whole text as a number; nothing for any other text. The locale of the program does not matter, as it
/// does for strtod() and streams.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace filament_core {

template <class T>
std::optional<T> numberOf(std::string_view text) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Within a range, which NaN is not.
inline std::optional<float> numberOf(std::string_view text, float least, float most) {
    const std::optional<float> number = numberOf<float>(text);
    return number && *number >= least && *number <= most ? number : std::nullopt;
}

} // namespace filament_core
