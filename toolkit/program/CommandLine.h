// SPDX-License-Identifier: Apache-2.0
/// CommandLine: the options of a program, and conversions of their words. CLI11 sorts the words; it is compiled here
/// alone.
///   In      variables that hold the defaults and outlive the parsing.
///   Out     the variables of the options that were given.
///   Fails   InvalidArgument in one line that names the option, the value and what is valid.
///   Thread  one at a time; conversions are pure functions. Help goes to standard output.
#pragma once

#include "base/Result.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace filament_core::tools {

class CommandLine {
public:
    /// What is said about an option besides its names, variable and help.
    class Option {
    public:
        explicit Option(CLI::Option& option) : mOption(&option) {}

        Option typeName(std::string const& shown) const;
        Option shownDefault(std::string const& shown) const;
        Option showsDefault() const; ///< the value of its variable
        Option required() const;
        Option words(int count) const; ///< so many, no more
        Option anyWords() const;       ///< also none
        Option oneWord() const;        ///< each time; it may be repeated
        Option repeatable() const;     ///< one word each time; all are kept
        Option separatedBy(char mark) const;
        Option oneOf(std::initializer_list<const char*> values) const;
        Option inRange(int low, int high) const;
        Option inRange(double low, double high) const;
        Option excludes(Option other) const;

    private:
        CLI::Option* mOption;
    };

    /// Without a name, help shows the one that the program was started with.
    explicit CommandLine(std::string const& description, std::string const& name = {});
    ~CommandLine();
    CommandLine(CommandLine const&) = delete;
    CommandLine& operator=(CommandLine const&) = delete;

    /// `names`: "-o,--out", or "FILE" for what stands by itself.
    Option option(std::string const& names, std::string& value, std::string const& help);
    Option option(std::string const& names, std::filesystem::path& value, std::string const& help);
    Option option(std::string const& names, std::vector<std::string>& value, std::string const& help);
    Option option(std::string const& names, std::vector<int>& value, std::string const& help);
    Option option(std::string const& names, int& value, std::string const& help);
    Option option(std::string const& names, uint32_t& value, std::string const& help);
    Option option(std::string const& names, float& value, std::string const& help);
    Option option(std::string const& names, double& value, std::string const& help);
    /// One of these names, in any case: an enumerator.
    template <class Enum>
    Option choice(std::string const& names, Enum& value, std::string const& help,
                  std::initializer_list<std::pair<const char*, Enum>> values) {
        std::vector<std::pair<std::string, int>> numbers;
        for (auto const& [name, each] : values) numbers.emplace_back(name, static_cast<int>(each));
        return choiceOfNumbers(
                names, [&value](int number) { value = static_cast<Enum>(number); }, help, numbers);
    }
    /// "--on,!--off" clears it, too.
    void flag(std::string const& names, bool& value, std::string const& help);

    void footer(std::string const& text);
    void helpFlag(std::string const& names, std::string const& help);
    void versionFlag(std::string const& names, std::string const& version);

    /// False: the help text was requested and has been printed.
    Result<bool> parse(int argc, const char* const* argv);
    /// Prints help, version or what is wrong, and returns the exit status then; nothing: go on.
    std::optional<int> exitStatus(int argc, const char* const* argv);
    std::optional<int> exitStatus(std::vector<std::string> words);
    /// Prints that a word is wrong, and returns the exit status.
    int reject(std::string const& message) const;

    bool wasGiven(std::string const& name) const;
    /// The given options as words again, except for some names.
    std::vector<std::string> givenBesides(std::initializer_list<const char*> names) const;

private:
    Option choiceOfNumbers(std::string const& names, std::function<void(int)> const& set, std::string const& help,
                           std::vector<std::pair<std::string, int>> const& values);

    std::unique_ptr<CLI::App> mApp;
};

Error invalidOption(const char* option, std::string const& value, std::string_view cure);

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

} // namespace filament_core::tools
