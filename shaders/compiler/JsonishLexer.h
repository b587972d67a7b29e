// SPDX-License-Identifier: Apache-2.0
/// Tokens of the JSONish language, and raw GLSL blocks.
///   Thread  one at a time. Fails: next() gives TokenKind::Error once, with the reason as text.
#pragma once

#include "shaders/compiler/Jsonish.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

enum class TokenKind : uint8_t {
    Word,
    Quoted,
    OpenBrace,
    CloseBrace,
    OpenBracket,
    CloseBracket,
    Colon,
    Comma,
    End,
    Error
};

struct Token {
    TokenKind kind = TokenKind::End;
    std::string text; ///< of words and strings; of errors the reason
    SourcePosition at;
};

class JsonishLexer {
public:
    JsonishLexer(std::string_view text, std::string_view fileName, IncludeResolver const& includes);

    Token next();
    /// Behind an opening brace: everything up to the brace that closes it. Comments may contain braces.
    Result<GlslBlock> rawBlock();
    SourcePosition position() const;

private:
    struct Input {
        std::string text;
        std::shared_ptr<const std::string> file;
        size_t at = 0;
        uint32_t line = 1;
    };

    Input& input() { return mInputs.back(); }
    bool atEnd() { return input().at >= input().text.size(); }
    char peek(size_t ahead = 0) {
        const size_t at = input().at + ahead;
        return at < input().text.size() ? input().text[at] : '\0';
    }
    void advance();
    bool startsWith(std::string_view text) {
        return std::string_view(input().text).substr(input().at).starts_with(text);
    }
    bool skipComment();
    bool skipBlank();
    Token token(TokenKind kind, std::string text = {});
    Token error(std::string reason) { return token(TokenKind::Error, std::move(reason)); }
    Token quoted();
    Token word();
    bool atInclude();
    std::string include();

    IncludeResolver const& mIncludes;
    std::vector<Input> mInputs; ///< the file and the includes being read
    size_t mTotalBytes = 0;
};

} // namespace filament_core::shader
