// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CodeScan.h"

#include "shaders/compiler/GlslTokens.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace filament_core::shader {
namespace {

size_t skipComment(std::string_view text, size_t at) {
    if (text.substr(at).starts_with("//")) return std::min(text.find('\n', at), text.size());
    if (text.substr(at).starts_with("/*")) {
        const size_t end = text.find("*/", at + 2);
        return end == std::string_view::npos ? text.size() : end + 2;
    }
    return at;
}

/// Splits into words; every other visible character is a token of its own. Comments and blanks are dropped.
std::vector<std::string_view> tokensOf(std::string_view text) {
    std::vector<std::string_view> tokens;
    for (size_t at = 0; at < text.size();) {
        if (const size_t behind = skipComment(text, at); behind != at) {
            at = behind;
            continue;
        }
        size_t end = at + 1;
        if (isGlslWordPart(text[at])) {
            while (end < text.size() && isGlslWordPart(text[end])) ++end;
        }
        if (!std::isspace(static_cast<unsigned char>(text[at]))) tokens.push_back(text.substr(at, end - at));
        at = end;
    }
    return tokens;
}

} // namespace

CodeScan::CodeScan(std::string_view glsl) {
    const std::vector<std::string_view> tokens = tokensOf(glsl);
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (!isGlslWordPart(tokens[i][0])) continue;
        mWords.emplace(tokens[i]);
        if (i + 1 == tokens.size() || tokens[i + 1] != "(") continue;
        // A type is followed by the declared name.
        const bool isCall =
                i == 0 || !isGlslWordPart(tokens[i - 1][0]) || tokens[i - 1] == "return" || tokens[i - 1] == "else";
        if (!isCall) mDeclared.emplace(tokens[i]);
        const auto before = glsl.substr(0, static_cast<size_t>(tokens[i].data() - glsl.data()));
        if (isCall) mCalls.try_emplace(std::string(tokens[i]), static_cast<uint32_t>(std::ranges::count(before, '\n')));
    }
}

std::optional<uint32_t> CodeScan::lineOfCall(std::string_view function) const {
    const auto found = mCalls.find(function);
    return found == mCalls.end() || mDeclared.contains(function) ? std::nullopt : std::optional(found->second);
}

} // namespace filament_core::shader
