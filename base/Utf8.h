// SPDX-License-Identifier: Apache-2.0
/// Utf8: where characters end.
///   Thread  any; pure.
#pragma once

#include <cstddef>
#include <string_view>

namespace filament_core {

/// Bytes of the UTF-8 sequence at the start of `text`; 0 if it is invalid. Unicode Standard, table 3-7.
inline size_t utf8Length(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto within = [&](size_t i, unsigned least, unsigned most) { return byte(i) >= least && byte(i) <= most; };
    const auto tail = [&](size_t i) { return within(i, 0x80, 0xBF); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return 1;
    if (within(0, 0xC2, 0xDF)) return tail(1) ? 2 : 0;
    if (within(0, 0xE0, 0xEF)) {
        const bool second = within(1, lead == 0xE0 ? 0xA0 : 0x80, lead == 0xED ? 0x9F : 0xBF);
        return second && tail(2) ? 3 : 0;
    }
    if (within(0, 0xF0, 0xF4)) {
        const bool second = within(1, lead == 0xF0 ? 0x90 : 0x80, lead == 0xF4 ? 0x8F : 0xBF);
        return second && tail(2) && tail(3) ? 4 : 0;
    }
    return 0;
}

} // namespace filament_core
