// SPDX-License-Identifier: Apache-2.0
/// numberOf: a whole text as a number within a range; nothing for any other text, NaN included.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace filament {

inline std::optional<float> numberOf(std::string_view text, float least, float most) {
    float number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isNumber = error == std::errc{} && end == text.data() + text.size();
    if (!isNumber || !(number >= least && number <= most)) return std::nullopt;
    return number;
}

} // namespace filament
