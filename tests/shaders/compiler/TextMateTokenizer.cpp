// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/compiler/TextMateTokenizer.h"

#include <gtest/gtest.h>

namespace filament_core::shader::test {
namespace {

constexpr int kMaxIncludes = 8;

std::string joined(std::vector<std::string> const& names) {
    std::string all;
    for (std::string const& name : names) {
        if (!name.empty()) all += (all.empty() ? "" : " ") + name;
    }
    return all;
}

} // namespace

struct TextMateTokenizer::State {
    std::vector<Rule const*> open;
    std::vector<std::string> names; // of the grammar and of the open rules
    std::vector<Scopes> scopes;

    Scopes current(std::string const& inner = {}) const {
        std::vector<std::string> all = names;
        all.push_back(inner);
        return joined(all);
    }
};

TextMateTokenizer::TextMateTokenizer(std::string const& grammar) : mGrammar(nlohmann::json::parse(grammar)) {
    for (auto const& [name, value] : mGrammar["repository"].items()) {
        const bool isList = !value.contains("match") && !value.contains("begin");
        const nlohmann::json patterns = isList ? value["patterns"] : nlohmann::json::array({ value });
        std::vector<Rule> rules;
        for (nlohmann::json const& pattern : patterns) rules.push_back(makeRule(pattern));
        mLists["#" + name] = std::move(rules);
    }
    mLists[""] = {};
    for (nlohmann::json const& pattern : mGrammar["patterns"]) mLists[""].push_back(makeRule(pattern));
}

std::string TextMateTokenizer::addList(nlohmann::json const& patterns) {
    std::vector<Rule> rules;
    for (nlohmann::json const& pattern : patterns) rules.push_back(makeRule(pattern));
    const std::string name = "inside " + std::to_string(mLists.size());
    mLists[name] = std::move(rules);
    return name;
}

TextMateTokenizer::Rule TextMateTokenizer::makeRule(nlohmann::json const& json) {
    Rule rule;
    rule.name = json.value("name", "");
    if (json.contains("include")) {
        rule.includes.push_back(json["include"]);
        return rule;
    }
    rule.isBlock = json.contains("begin");
    rule.pattern.assign(json[rule.isBlock ? "begin" : "match"].get<std::string>());
    if (rule.isBlock) {
        rule.end.assign(json["end"].get<std::string>());
        rule.inside = addList(json.value("patterns", nlohmann::json::array()));
    }
    const nlohmann::json captures = json.value(rule.isBlock ? "beginCaptures" : "captures", nlohmann::json::object());
    for (auto const& [number, capture] : captures.items()) rule.captures[std::stoul(number)] = capture["name"];
    return rule;
}

void TextMateTokenizer::collect(std::string const& list, std::vector<Rule const*>& out, int depth) const {
    ASSERT_TRUE(mLists.contains(list)) << "the grammar has no " << list;
    ASSERT_LT(depth, kMaxIncludes) << "the grammar includes itself: " << list;
    for (Rule const& rule : mLists.at(list)) {
        if (rule.includes.empty()) out.push_back(&rule);
        for (std::string const& included : rule.includes) collect(included, out, depth + 1);
    }
}

// The earliest match wins; of those that begin at the same place the end of the block, then the first in the list.
void TextMateTokenizer::runLine(std::string const& line, State& state) const {
    for (size_t at = 0; at <= line.size();) {
        const auto begin = line.begin() + static_cast<std::ptrdiff_t>(at);
        const auto flags = at == 0 ? std::regex_constants::match_default : std::regex_constants::match_prev_avail;
        Found best;
        const auto consider = [&](std::regex const& pattern, Rule const* rule) {
            std::smatch match;
            if (!std::regex_search(begin, line.end(), match, pattern, flags)) return;
            if (best.match.empty() || match.position() < best.match.position()) best = { rule, match };
        };
        if (!state.open.empty()) consider(state.open.back()->end, nullptr);
        std::vector<Rule const*> rules;
        collect(state.open.empty() ? "" : state.open.back()->inside, rules);
        for (Rule const* rule : rules) consider(rule->pattern, rule);
        if (best.match.empty()) {
            state.scopes.insert(state.scopes.end(), line.size() - at, state.current());
            return;
        }

        const auto skipped = static_cast<size_t>(best.match.position());
        const auto length = static_cast<size_t>(best.match.length());
        state.scopes.insert(state.scopes.end(), skipped, state.current());
        const bool opens = best.rule != nullptr && best.rule->isBlock;
        if (opens) {
            state.open.push_back(best.rule);
            state.names.push_back(best.rule->name);
        }
        std::vector<Scopes> own(length, state.current(best.rule && !opens ? best.rule->name : ""));
        for (auto const& [number, name] : best.rule ? best.rule->captures : std::map<size_t, std::string>{}) {
            const auto first = static_cast<size_t>(best.match.position(number)) - skipped;
            for (size_t i = 0; i < static_cast<size_t>(best.match.length(number)); ++i) own[first + i] += " " + name;
        }
        state.scopes.insert(state.scopes.end(), own.begin(), own.end());
        if (best.rule == nullptr) {
            state.open.pop_back();
            state.names.pop_back();
        }
        at += skipped + std::max<size_t>(length, 1);
        if (length == 0 && at <= line.size()) state.scopes.push_back(state.current());
    }
}

TextMateTokenizer::Result TextMateTokenizer::run(std::string_view text) const {
    State state;
    state.names.push_back(mGrammar["scopeName"]);
    for (size_t at = 0; at <= text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        runLine(std::string(text.substr(at, end - at)), state);
        if (end < text.size()) state.scopes.push_back(state.current());
        at = end + 1;
    }
    return { std::move(state.scopes), state.open.size() };
}

} // namespace filament_core::shader::test
