// SPDX-License-Identifier: Apache-2.0
/// CommandLine: converts the words of a command line to values, for the tools that draw. CLI11 sorts the words; these
/// functions report what is wrong with them.
///   Fails   InvalidArgument in one line that names the option, the value and what is valid.
///   Thread  pure functions, except for the help text on standard output.
#pragma once

#include "base/Result.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace filament::tools {

Error invalidOption(const char* option, std::string const& value, const char* cure);

std::optional<double> finiteNumber(std::string const& word);
/// A whole number in [low, high].
std::optional<uint32_t> wholeNumber(std::string const& word, uint32_t low, uint32_t high);
std::string joined(std::vector<std::string> const& words);

/// `N` numbers that pass `accepts`; an absent option does not change `result`.
template <size_t N, class Accept>
Result<void> convertNumbers(const char* option, std::vector<std::string> const& words, const char* cure,
                            std::array<double, N>& result, Accept const& accepts) {
    if (words.empty()) return {};
    for (size_t i = 0; i < N; ++i) {
        const auto value = i < words.size() ? finiteNumber(words[i]) : std::nullopt;
        if (!value) return invalidOption(option, joined(words), cure);
        result[i] = *value;
    }
    return accepts(result) ? Result<void>{} : Result<void>(invalidOption(option, joined(words), cure));
}

/// "on" or "off"; an empty word does not change `result`.
Result<void> convertSwitch(const char* option, std::string const& word, bool& result);

/// False: the help text was requested and has been printed.
Result<bool> parseWords(CLI::App& app, int argc, const char* const* argv);

} // namespace filament::tools
