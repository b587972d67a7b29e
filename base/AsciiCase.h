// SPDX-License-Identifier: Apache-2.0
/// lowerCase: texts without their case, of the letters A to Z only, whatever the locale of the program.
#pragma once

#include <string>
#include <string_view>

namespace filament_core {

inline std::string lowerCase(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

} // namespace filament_core
