// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Jsonish.h"

#include "shaders/compiler/JsonishLexer.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

namespace filament_core::shader {
namespace {

constexpr int kMaxValueDepth = 32;

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) { return std::tolower(static_cast<unsigned char>(x)) == y; });
}

std::string describe(Token const& token) {
    switch (token.kind) {
    case TokenKind::End:
        return "the end of the file";
    case TokenKind::Quoted:
        return "\"" + token.text + "\"";
    default:
        return "'" + token.text + "'";
    }
}

/// An unquoted word that looks like a boolean or a number is one.
JsonValue scalar(Token const& token) {
    JsonValue value{ .kind = JsonValue::Kind::String, .at = token.at, .text = token.text };
    if (token.kind == TokenKind::Quoted) return value;
    const bool isTrue = equalsIgnoringCase(token.text, "true"), isFalse = equalsIgnoringCase(token.text, "false");
    if (isTrue || isFalse) {
        value.kind = JsonValue::Kind::Bool;
        value.boolean = isTrue;
        return value;
    }
    const char* const end = token.text.data() + token.text.size();
    const auto parsed = std::from_chars(token.text.data(), end, value.number);
    if (parsed.ec == std::errc{} && parsed.ptr == end) value.kind = JsonValue::Kind::Number;
    return value;
}

class Parser {
public:
    Parser(std::string_view text, std::string_view fileName, IncludeResolver const& includes)
            : mLexer(text, fileName, includes) {}

    Result<MaterialText> file() {
        MaterialText out;
        bool hasMaterial = false;
        for (Token token = mLexer.next(); token.kind != TokenKind::End; token = mLexer.next()) {
            if (token.kind != TokenKind::Word) return unexpected(token, "'material', 'vertex' or 'fragment'");
            Token brace = mLexer.next();
            if (brace.kind != TokenKind::OpenBrace) return unexpected(brace, "'{'");
            if (token.text == "material") {
                if (std::exchange(hasMaterial, true)) return errorAt(token.at, "there are two material blocks");
                Result<JsonValue> object = objectBody(token.at, 0);
                if (!object) return object.error();
                out.material = std::move(*object);
            } else if (token.text == "vertex" || token.text == "fragment") {
                if (Result<void> done = rawBlock(token, token.text == "vertex" ? out.vertex : out.fragment); !done)
                    return done.error();
            } else {
                return unexpected(token, "'material', 'vertex' or 'fragment'");
            }
        }
        if (!hasMaterial) return errorAt(mLexer.position(), "there is no material block");
        return out;
    }

private:
    static Error unexpected(Token const& token, const char* wanted) {
        if (token.kind == TokenKind::Error) return errorAt(token.at, token.text);
        return errorAt(token.at, fmt::format("expected {}, found {}", wanted, describe(token)));
    }

    Result<void> rawBlock(Token const& name, std::optional<GlslBlock>& out) {
        if (out) return errorAt(name.at, fmt::format("there are two {} blocks", name.text));
        Result<GlslBlock> block = mLexer.rawBlock();
        if (!block) return block.error();
        out = std::move(*block);
        return {};
    }

    Result<JsonValue> value(Token const& token, int depth) {
        if (depth > kMaxValueDepth) return errorAt(token.at, "values are nested too deeply");
        switch (token.kind) {
        case TokenKind::Word:
        case TokenKind::Quoted:
            return scalar(token);
        case TokenKind::OpenBrace:
            return objectBody(token.at, depth + 1);
        case TokenKind::OpenBracket:
            return arrayBody(token.at, depth + 1);
        default:
            return unexpected(token, "a value");
        }
    }

    /// Called after the opening brace.
    Result<JsonValue> objectBody(SourcePosition const& at, int depth) {
        JsonValue object{ .kind = JsonValue::Kind::Object, .at = at };
        for (Token key = mLexer.next(); key.kind != TokenKind::CloseBrace; key = mLexer.next()) {
            if (key.kind != TokenKind::Word && key.kind != TokenKind::Quoted)
                return unexpected(key, "a property name or '}'");
            const Token colon = mLexer.next();
            if (colon.kind != TokenKind::Colon) return unexpected(colon, "':'");
            Result<JsonValue> member = value(mLexer.next(), depth);
            if (!member) return member;
            object.members.push_back({ key.text, std::move(*member) });
            const Token separator = mLexer.next();
            if (separator.kind == TokenKind::CloseBrace) break;
            if (separator.kind != TokenKind::Comma) return unexpected(separator, "',' or '}'");
        }
        return object;
    }

    /// Called after the opening bracket.
    Result<JsonValue> arrayBody(SourcePosition const& at, int depth) {
        JsonValue array{ .kind = JsonValue::Kind::Array, .at = at };
        for (Token token = mLexer.next(); token.kind != TokenKind::CloseBracket; token = mLexer.next()) {
            Result<JsonValue> item = value(token, depth);
            if (!item) return item;
            array.items.push_back(std::move(*item));
            const Token separator = mLexer.next();
            if (separator.kind == TokenKind::CloseBracket) break;
            if (separator.kind != TokenKind::Comma) return unexpected(separator, "',' or ']'");
        }
        return array;
    }

    JsonishLexer mLexer;
};

} // namespace

Error errorAt(SourcePosition const& at, std::string const& message, ErrorCode code) {
    return { code, fmt::format("{}:{}: {}", at.file ? *at.file : std::string("material"), at.line, message) };
}

const char* toString(JsonValue::Kind kind) {
    switch (kind) {
    case JsonValue::Kind::Bool:
        return "a boolean";
    case JsonValue::Kind::Number:
        return "a number";
    case JsonValue::Kind::String:
        return "a string";
    case JsonValue::Kind::Array:
        return "an array";
    case JsonValue::Kind::Object:
        return "an object";
    }
    return "a value";
}

Result<MaterialText> parseMaterialText(std::string_view text, std::string_view fileName,
                                       IncludeResolver const& includes) {
    if (text.size() > 1 << 20)
        return fail(ErrorCode::InvalidArgument, "{}: the material is larger than 1 MiB", fileName);
    return Parser(text, fileName, includes).file();
}

} // namespace filament_core::shader
