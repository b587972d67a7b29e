// SPDX-License-Identifier: Apache-2.0
#include "tools/common/CommandLine.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace filament::tools {
namespace {

/// Rewrites "-.5" as "-0.5": CLI11 would take it for a short option.
std::vector<std::string> wordsBackwards(int argc, const char* const* argv) {
    std::vector<std::string> words;
    for (int i = argc - 1; i > 0; --i) {
        std::string word = argv[i];
        if (word.starts_with("-.")) word.insert(1, "0");
        words.push_back(std::move(word));
    }
    return words;
}

} // namespace

Error invalidOption(const char* option, std::string const& value, const char* cure) {
    return fail(ErrorCode::InvalidArgument, "{}: '{}' is not valid; give {}", option, value, cure);
}

std::optional<double> finiteNumber(std::string const& word) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return {};
    return value;
}

std::optional<uint32_t> wholeNumber(std::string const& word, uint32_t low, uint32_t high) {
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < low || value > high) return {};
    return value;
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (std::string const& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

Result<void> convertSwitch(const char* option, std::string const& word, bool& result) {
    if (word.empty()) return {};
    if (word != "on" && word != "off") return invalidOption(option, word, "on or off");
    result = word == "on";
    return {};
}

Result<bool> parseWords(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(wordsBackwards(argc, argv));
    } catch (CLI::CallForHelp const&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (CLI::Error const& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        return fail(ErrorCode::InvalidArgument, "command line: {}; '{} --help' lists the options", what,
                    app.get_name());
    }
    return true;
}

} // namespace filament::tools
