// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

char lowered(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool containsWord(std::string_view text, std::string_view word) {
    const auto isSame = [](char a, char b) { return lowered(a) == lowered(b); };
    return word.empty() || std::search(text.begin(), text.end(), word.begin(), word.end(), isSame) != text.end();
}

} // namespace

bool matchesFilter(std::string_view text, std::string_view filter) {
    while (!filter.empty()) {
        const size_t end = std::min(filter.find(' '), filter.size());
        if (!containsWord(text, filter.substr(0, end))) return false;
        filter.remove_prefix(std::min(end + 1, filter.size()));
    }
    return true;
}

std::string millisecondsText(double milliseconds) {
    if (!std::isfinite(milliseconds) || milliseconds == 0) return {};
    const double size = std::abs(milliseconds);
    return fmt::format("{:.{}f} ms", milliseconds, size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

std::string differenceText(double milliseconds) {
    if (!std::isfinite(milliseconds)) return {};
    return fmt::format("{:+.2f} ms", milliseconds);
}

std::string bytesText(uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} B", bytes);
    if (bytes < 1'000'000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
    return fmt::format("{:.2f} MB", static_cast<double>(bytes) / 1e6);
}

} // namespace filament_core::view
