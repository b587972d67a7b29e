// SPDX-License-Identifier: Apache-2.0
#include "tools/common/CommandLine.h"

#include "base/NumberText.h"

#include <CLI/CLI.hpp>

#include <algorithm>
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
    const std::optional<double> value = numberOf<double>(word);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<uint32_t> wholeNumber(std::string const& word, uint32_t low, uint32_t high) {
    const std::optional<uint32_t> value = numberOf<uint32_t>(word);
    return value && *value >= low && *value <= high ? value : std::nullopt;
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
