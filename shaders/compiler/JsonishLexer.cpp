// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/JsonishLexer.h"

#include <fmt/core.h>

#include <utility>

namespace filament_core::shader {
namespace {

constexpr size_t kMaxIncludeDepth = 8;
constexpr size_t kMaxTotalBytes = 1 << 20;

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool endsWord(char c) {
    return isSpace(c) || c == ',' || c == ':' || c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '\0';
}

} // namespace

JsonishLexer::JsonishLexer(std::string_view text, std::string_view fileName, IncludeResolver const& includes)
        : mIncludes(includes), mTotalBytes(text.size()) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; // some editors write it at the start of UTF-8
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    mInputs.push_back({ std::string(text), std::make_shared<std::string>(fileName) });
}

SourcePosition JsonishLexer::position() const { return { mInputs.back().file, mInputs.back().line }; }

void JsonishLexer::advance() {
    if (peek() == '\n') ++input().line;
    ++input().at;
}

/// Returns true if there was a comment; an unclosed one ends with the file.
bool JsonishLexer::skipComment() {
    if (startsWith("//")) {
        while (!atEnd() && peek() != '\n') advance();
        return true;
    }
    if (!startsWith("/*")) return false;
    advance();
    advance();
    while (!atEnd() && !startsWith("*/")) advance();
    if (!atEnd()) advance(), advance();
    return true;
}

/// Returns true if something was skipped.
bool JsonishLexer::skipBlank() {
    if (!atEnd() && isSpace(peek())) {
        advance();
        return true;
    }
    if (!atEnd() && skipComment()) return true;
    if (atEnd() && mInputs.size() > 1) {
        mInputs.pop_back();
        return true;
    }
    return false;
}

Token JsonishLexer::token(TokenKind kind, std::string text) { return { kind, std::move(text), position() }; }

/// As in C, there may be blanks behind the '#'.
bool JsonishLexer::atInclude() {
    constexpr std::string_view kInclude = "include";
    if (peek() != '#') return false;
    size_t at = 1;
    while (peek(at) == ' ' || peek(at) == '\t') ++at;
    for (const char letter : kInclude) {
        if (peek(at++) != letter) return false;
    }
    const char next = peek(at);
    return next == '"' || next == ' ' || next == '\t' || next == '\n' || next == '\0';
}

/// Returns an empty string, or why the include cannot be followed.
std::string JsonishLexer::include() {
    while (peek() != '"' && peek() != '\n' && !atEnd()) advance();
    const Token path = peek() == '"' ? quoted() : error("");
    if (path.kind != TokenKind::Quoted) return "#include needs a path in quotes";
    if (mInputs.size() >= kMaxIncludeDepth)
        return fmt::format("\"{}\" is included too deeply; does it include itself?", path.text);
    std::string name = path.text;
    const size_t folder = mInputs.size() > 1 ? input().file->rfind('/') : std::string::npos;
    if (folder != std::string::npos) name.insert(0, input().file->substr(0, folder + 1)); // beside the including file
    std::optional<std::string> text = mIncludes ? mIncludes(name) : std::nullopt;
    if (!text && name != path.text) {
        name = path.text;
        text = mIncludes ? mIncludes(name) : std::nullopt;
    }
    if (!text) return fmt::format("cannot find the file \"{}\" of this #include", path.text);
    mTotalBytes += text->size();
    if (mTotalBytes > kMaxTotalBytes) return "the material with its includes is larger than 1 MiB";
    mInputs.push_back({ std::move(*text), std::make_shared<std::string>(name) });
    return {};
}

Token JsonishLexer::quoted() {
    Token result = token(TokenKind::Quoted);
    advance();
    while (peek() != '"') {
        if (atEnd() || peek() == '\n') return { TokenKind::Error, "this string has no closing quote", result.at };
        if (peek() == '\\' && (peek(1) == '"' || peek(1) == '\\')) advance();
        result.text += peek();
        advance();
    }
    advance();
    return result;
}

/// A run of unquoted characters, including an array size, as in float[9].
Token JsonishLexer::word() {
    Token result = token(TokenKind::Word);
    while (!endsWord(peek())) {
        result.text += peek();
        advance();
    }
    if (peek() != '[') return result;
    size_t length = 1;
    while (peek(length) >= '0' && peek(length) <= '9') ++length;
    if (peek(length) != ']') return result;
    for (size_t i = 0; i <= length; ++i) {
        result.text += peek();
        advance();
    }
    return result;
}

Token JsonishLexer::next() {
    while (skipBlank()) {
    }
    while (atInclude()) {
        if (std::string problem = include(); !problem.empty()) return error(std::move(problem));
        while (skipBlank()) {
        }
    }
    if (atEnd()) return token(TokenKind::End);
    constexpr std::pair<char, TokenKind> kMarks[] = { { '{', TokenKind::OpenBrace },   { '}', TokenKind::CloseBrace },
                                                      { '[', TokenKind::OpenBracket }, { ']', TokenKind::CloseBracket },
                                                      { ':', TokenKind::Colon },       { ',', TokenKind::Comma } };
    for (auto const& [mark, kind] : kMarks) {
        if (peek() != mark) continue;
        Token result = token(kind, std::string(1, mark));
        advance();
        return result;
    }
    if (peek() == '"') return quoted();
    if (peek() == '\0') return error("this file contains a zero byte; is it a text file?");
    return word();
}

Result<GlslBlock> JsonishLexer::rawBlock() {
    GlslBlock block{ .text = {}, .at = position() };
    const size_t begin = input().at;
    for (int depth = 1; !atEnd();) {
        if (skipComment()) continue;
        if (peek() == '{') ++depth;
        if (peek() == '}' && --depth == 0) {
            block.text = input().text.substr(begin, input().at - begin);
            advance();
            return block;
        }
        advance();
    }
    return errorAt(block.at, "this block has no closing brace");
}

} // namespace filament_core::shader
