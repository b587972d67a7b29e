// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/CommandLine.h"

#include "base/NumberText.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace filament_core::tools {
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

void appendWords(CLI::Option const& option, std::vector<std::string>& out) {
    const std::string name = option.get_name();
    if (option.get_items_expected_max() == 0) { // a flag; false: its negation was given
        out.push_back(option.results().back() == "true" ? name : name + "=" + option.results().back());
        return;
    }
    const bool hasOneWord = option.get_expected_max() == 1; // several: the option was repeated
    if (!hasOneWord) out.push_back(name);
    for (std::string const& word : option.results()) {
        if (hasOneWord) out.push_back(name);
        out.push_back(word);
    }
}

} // namespace

Error invalidOption(const char* option, std::string const& value, std::string_view cure) {
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

CommandLine::Option CommandLine::Option::typeName(std::string const& shown) const {
    mOption->type_name(shown);
    return *this;
}

CommandLine::Option CommandLine::Option::shownDefault(std::string const& shown) const {
    mOption->default_str(shown);
    return *this;
}

CommandLine::Option CommandLine::Option::showsDefault() const {
    mOption->capture_default_str();
    return *this;
}

CommandLine::Option CommandLine::Option::required() const {
    mOption->required();
    return *this;
}

CommandLine::Option CommandLine::Option::words(int count) const {
    mOption->expected(count)->allow_extra_args(false);
    return *this;
}

CommandLine::Option CommandLine::Option::anyWords() const {
    mOption->expected(0, -1);
    return *this;
}

CommandLine::Option CommandLine::Option::oneWord() const {
    mOption->allow_extra_args(false);
    return *this;
}

CommandLine::Option CommandLine::Option::repeatable() const {
    mOption->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return *this;
}

CommandLine::Option CommandLine::Option::separatedBy(char mark) const {
    mOption->delimiter(mark);
    return *this;
}

CommandLine::Option CommandLine::Option::oneOf(std::initializer_list<const char*> values) const {
    mOption->check(CLI::IsMember(std::vector<std::string>(values.begin(), values.end())));
    return *this;
}

CommandLine::Option CommandLine::Option::inRange(int low, int high) const {
    mOption->check(CLI::Range(low, high));
    return *this;
}

CommandLine::Option CommandLine::Option::inRange(double low, double high) const {
    mOption->check(CLI::Range(low, high));
    return *this;
}

CommandLine::Option CommandLine::Option::excludes(Option other) const {
    mOption->excludes(other.mOption);
    return *this;
}

CommandLine::CommandLine(std::string const& description, std::string const& name)
        : mApp(std::make_unique<CLI::App>(description, name)) {}

CommandLine::~CommandLine() = default;

CommandLine::Option CommandLine::option(std::string const& names, std::string& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, std::filesystem::path& value,
                                        std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, std::vector<std::string>& value,
                                        std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, std::vector<int>& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, int& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, uint32_t& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, float& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::option(std::string const& names, double& value, std::string const& help) {
    return Option(*mApp->add_option(names, value, help));
}

CommandLine::Option CommandLine::choiceOfNumbers(std::string const& names, std::function<void(int)> const& set,
                                                 std::string const& help,
                                                 std::vector<std::pair<std::string, int>> const& values) {
    const std::map<std::string, int> numbers(values.begin(), values.end());
    return Option(*mApp->add_option_function<int>(names, set, help)
                           ->type_name("ENUM")
                           ->transform(CLI::CheckedTransformer(numbers, CLI::ignore_case)));
}

void CommandLine::flag(std::string const& names, bool& value, std::string const& help) {
    mApp->add_flag(names, value, help);
}

void CommandLine::footer(std::string const& text) { mApp->footer(text); }

void CommandLine::helpFlag(std::string const& names, std::string const& help) { mApp->set_help_flag(names, help); }

void CommandLine::versionFlag(std::string const& names, std::string const& version) {
    mApp->set_version_flag(names, version);
}

Result<bool> CommandLine::parse(int argc, const char* const* argv) {
    try {
        mApp->parse(wordsBackwards(argc, argv));
    } catch (CLI::CallForHelp const&) {
        std::fputs(mApp->help().c_str(), stdout);
        return false;
    } catch (CLI::Error const& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        return fail(ErrorCode::InvalidArgument, "command line: {}; '{} --help' lists the options", what,
                    mApp->get_name());
    }
    return true;
}

std::optional<int> CommandLine::exitStatus(int argc, const char* const* argv) {
    try {
        mApp->parse(argc, argv);
    } catch (CLI::ParseError const& problem) {
        return mApp->exit(problem);
    }
    return std::nullopt;
}

std::optional<int> CommandLine::exitStatus(std::vector<std::string> words) {
    std::ranges::reverse(words);
    try {
        mApp->parse(std::move(words));
    } catch (CLI::ParseError const& problem) {
        return mApp->exit(problem);
    }
    return std::nullopt;
}

int CommandLine::reject(std::string const& message) const { return mApp->exit(CLI::ValidationError(message)); }

bool CommandLine::wasGiven(std::string const& name) const { return mApp->count(name) > 0; }

std::vector<std::string> CommandLine::givenBesides(std::initializer_list<const char*> names) const {
    std::vector<std::string> positional, named;
    for (CLI::Option const* option : std::as_const(*mApp).get_options()) {
        const auto isOption = [&](const char* name) { return option->check_name(name); };
        if (option->count() == 0 || std::ranges::any_of(names, isOption)) continue;
        if (option->get_positional())
            positional.insert(positional.end(), option->results().begin(), option->results().end());
        else
            appendWords(*option, named);
    }
    positional.insert(positional.end(), named.begin(), named.end());
    return positional;
}

} // namespace filament_core::tools
