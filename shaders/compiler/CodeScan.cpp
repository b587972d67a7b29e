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
    for (const std::string_view token : tokensOf(glsl)) {
        if (isWordCharacter(token[0])) mWords.emplace(token);
    }
}

} // namespace filament::shader
