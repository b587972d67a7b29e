// SPDX-License-Identifier: Apache-2.0
/// What readers of text formats do with words, whatever the locale of the program.
#pragma once

#include <string>
#include <string_view>

namespace filament_core {

/// Without the case of the letters A to Z.
inline std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

/// Without the characters of `blanks` at both ends.
inline std::string_view withoutBlanks(std::string_view text, std::string_view blanks) {
    const size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What is shown of a word of unknown origin: its first characters, without line breaks and control sequences of
/// terminals.
inline std::string printable(std::string_view text, size_t most = 32) {
    std::string shown(text.substr(0, most));
    for (char& c : shown) c = static_cast<unsigned char>(c) >= ' ' && c != 0x7F ? c : '?';
    return shown;
}

} // namespace filament_core
