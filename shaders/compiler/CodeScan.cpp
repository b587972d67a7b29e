// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CodeScan.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace filament::shader {
namespace {

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

size_t skipComment(std::string_view text, size_t at) {
    if (text.substr(at).starts_with("//")) return std::min(text.find('\n', at), text.size());
    if (text.substr(at).starts_with("/*")) {
        const size_t end = text.find("*/", at + 2);
        return end == std::string_view::npos ? text.size() : end + 2;
    }
    return at;
}

/// Words, and every other visible character by itself; comments and blanks are gone.
std::vector<std::string_view> tokensOf(std::string_view text) {
    std::vector<std::string_view> tokens;
    for (size_t at = 0; at < text.size();) {
        if (const size_t behind = skipComment(text, at); behind != at) {
            at = behind;
            continue;
        }
        size_t end = at + 1;
        if (isWordCharacter(text[at])) {
            while (end < text.size() && isWordCharacter(text[end])) ++end;
        }
        if (!std::isspace(static_cast<unsigned char>(text[at]))) tokens.push_back(text.substr(at, end - at));
        at = end;
    }
    return tokens;
}

} // namespace

CodeScan::CodeScan(std::string_view glsl) {
    const std::vector<std::string_view> tokens = tokensOf(glsl);
    std::set<std::string_view> inputs;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (isWordCharacter(tokens[i][0])) mWords.emplace(tokens[i]);
        if (tokens[i] == "define") mHasMacros = true;
        if (tokens[i] == "MaterialInputs" && i + 1 < tokens.size()) inputs.insert(tokens[i + 1]);
    }
    for (size_t i = 0; i + 2 < tokens.size(); ++i) {
        if (tokens[i + 1] == "." && inputs.contains(tokens[i])) mMembers.emplace(tokens[i + 2]);
    }
}

bool CodeScan::touches(std::string_view member) const {
    return mMembers.contains(member) || (mHasMacros && mentions(member));
}

} // namespace filament::shader
