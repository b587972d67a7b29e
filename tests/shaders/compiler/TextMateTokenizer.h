// SPDX-License-Identifier: Apache-2.0
/// TextMateTokenizer: colours text by a TextMate grammar as editors do: line by line, with a stack of open begin/end
/// rules. For the grammar in tools/editor; the part of the format that it uses (match, begin, end, captures, include).
///   https://macromates.com/manual/en/language_grammars
#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader::test {

/// The scopes of one character, the outermost first, separated by blanks.
using Scopes = std::string;

class TextMateTokenizer {
public:
    explicit TextMateTokenizer(std::string const& grammar);

    struct Result {
        std::vector<Scopes> scopes; ///< one a character of the text
        size_t open = 0;            ///< begin rules that did not end
    };
    Result run(std::string_view text) const;

private:
    struct Rule {
        std::string name;
        std::regex pattern, end; ///< match or begin
        bool isBlock = false;
        std::map<size_t, std::string> captures;
        std::vector<std::string> includes; ///< keys of mLists
        std::string inside;                ///< of a block: the list of its patterns
    };
    struct Found {
        Rule const* rule = nullptr; ///< none: the end of the open block
        std::smatch match;
    };
    struct State;

    std::string addList(nlohmann::json const& patterns);
    Rule makeRule(nlohmann::json const& json);
    void collect(std::string const& list, std::vector<Rule const*>& out, int depth = 0) const;
    void runLine(std::string const& line, State& state) const;

    nlohmann::json mGrammar;
    std::map<std::string, std::vector<Rule>> mLists;
};

} // namespace filament_core::shader::test
