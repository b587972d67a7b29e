// SPDX-License-Identifier: Apache-2.0
/// misuseLine(): what a process prints that a mistake of the program ends.
#pragma once

#include <string>
#include <string_view>

namespace filament_core::test {

/// A regular expression of EXPECT_DEATH for this line, and nothing besides.
inline std::string misuseLine(std::string_view text) {
    std::string regex = "^";
    for (const char c : text) {
        if (std::string_view("().[]{}*+?^$|\\").find(c) != std::string_view::npos) regex += '\\';
        regex += c;
    }
    return regex + "\n$";
}

} // namespace filament_core::test
