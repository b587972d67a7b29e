// SPDX-License-Identifier: Apache-2.0
/// MeshWords: the lines and words of a text, and numbers of the C locale.
///   Thread  any; views into the text.   Fails: never.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace filament_core::assets {

/// Takes the first word, up to blanks; empty: there is none.
inline std::string_view takeWord(std::string_view& text) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    const size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) {
        text = {};
        return {};
    }
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    return word;
}

/// Without blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\v\f\n";
    const size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Takes the first line, without its end.
inline std::string_view takeLine(std::string_view& text) {
    const size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

/// A finite number within the range of a float.
inline std::optional<double> doubleOf(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool isSmall = error == std::errc::result_out_of_range && std::abs(value) < 1; // 1e-400 counts as 0
    if (word.empty() || end != word.data() + word.size() || (error != std::errc{} && !isSmall)) return std::nullopt;
    if (isSmall) value = 0;
    return std::isfinite(static_cast<float>(value)) ? std::optional(value) : std::nullopt;
}

/// A finite number that a float holds.
inline std::optional<float> floatOf(std::string_view word) {
    const std::optional<double> value = doubleOf(word);
    return value ? std::optional(static_cast<float>(*value)) : std::nullopt;
}

inline std::optional<int64_t> integerOf(std::string_view word) {
    int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size() || error != std::errc{}) return std::nullopt;
    return value;
}

} // namespace filament_core::assets
