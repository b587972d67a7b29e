// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace filament_core::tools {

std::string escapedHtml(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? std::to_integer<uint32_t>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string figureOfPng(std::span<const std::byte> png, std::string_view title, std::string_view name) {
    const std::string text = escapedHtml(title);
    return fmt::format("<figure><img class=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}"
                       "</figcaption></figure>",
                       name, text, base64(png), text);
}

} // namespace filament_core::tools
