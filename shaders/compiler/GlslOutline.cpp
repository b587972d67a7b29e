// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslOutline.h"

#include "shaders/compiler/GlslTokens.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <utility>

namespace filament_core::shader {
namespace {

using Kind = GlslDeclaration::Kind;

constexpr std::array<std::string_view, 17> kQualifiers{ "const",         "in",        "out",     "inout",    "highp",
                                                        "mediump",       "lowp",      "uniform", "flat",     "smooth",
                                                        "centroid",      "invariant", "precise", "coherent", "readonly",
                                                        "noperspective", "precision" };

struct Located {
    std::string_view text;
    bool isWord = false;
    uint32_t line = 0;
};

using Tokens = std::span<const Located>;

/// The names of the guide for the types of GLSL.
std::string canonicalType(std::string_view type) {
    static constexpr std::pair<std::string_view, std::string_view> kAliases[] = {
        { "float", "vec" }, { "int", "ivec" }, { "uint", "uvec" }, { "bool", "bvec" }
    };
    if (type == "float3x3") return "mat3";
    if (type == "float4x4") return "mat4";
    for (auto const& [prefix, glsl] : kAliases) {
        const bool isVector = type.size() == prefix.size() + 1 && type.starts_with(prefix) && type.back() >= '2' &&
                              type.back() <= '4';
        if (isVector) return std::string(glsl) + type.back();
    }
    return std::string(type);
}

/// The index behind the bracket that closes the one at `open`.
size_t behindBracket(Tokens tokens, size_t open) {
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        if (tokens[i].text == "(" || tokens[i].text == "[") ++depth;
        if ((tokens[i].text == ")" || tokens[i].text == "]") && --depth == 0) return i + 1;
    }
    return tokens.size();
}

/// The first word that is not a qualifier, and the sizes of the array that it or its name may be.
std::string typeOf(Tokens tokens) {
    std::string type, sizes;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "[") {
            const size_t end = behindBracket(tokens, i);
            for (; i < end; ++i) sizes += tokens[i].text;
            --i;
        } else if (type.empty() && tokens[i].isWord && std::ranges::count(kQualifiers, tokens[i].text) == 0) {
            type = canonicalType(tokens[i].text);
        }
    }
    return type + sizes;
}

std::vector<std::string> parameterTypes(Tokens tokens) {
    std::vector<std::string> types;
    size_t begin = 0;
    for (size_t i = 0; i <= tokens.size(); ++i) {
        if (i < tokens.size() && tokens[i].text == "[") i = behindBracket(tokens, i) - 1;
        if (i < tokens.size() && tokens[i].text != ",") continue;
        std::string type = typeOf(tokens.subspan(begin, i - begin));
        if (!type.empty() && type != "void") types.push_back(std::move(type));
        begin = i + 1;
    }
    return types;
}

class Outline {
public:
    Outline(std::string_view glsl, std::string_view file) : mTokens(glsl), mFile(file) { mTokens.setLine(1); }

    std::vector<GlslDeclaration> run() {
        for (GlslToken token = mTokens.next(); !token.text.empty(); token = mTokens.next()) {
            if (token.text == "#" && token.beginsLine)
                directive();
            else if (token.text == "{" && !mStatement.empty())
                body();
            else if (token.text == ";")
                endStatement(false);
            else
                mStatement.push_back({ token.text, token.isWord, mTokens.line() });
        }
        return std::move(mFound);
    }

private:
    void directive() {
        const GlslToken name = mTokens.next();
        if (name.beginsLine) return;
        const uint32_t line = mTokens.line();
        if (name.text == "define") {
            const GlslToken macro = mTokens.next();
            if (!macro.beginsLine && macro.isWord) add(Kind::Macro, { macro.text, true, line });
        }
        const std::string_view rest = mTokens.restOfLine();
        if (name.text != "line") return;
        uint32_t next = line + 1;
        readLineDirective(rest, next, mFile);
        mTokens.setLine(next - 1);
    }

    GlslDeclaration& add(Kind kind, Located const& name) {
        return mFound.emplace_back(GlslDeclaration{
                .kind = kind, .name = std::string(name.text), .file = std::string(mFile), .line = name.line });
    }

    void skipBody() {
        int depth = 1;
        for (GlslToken token = mTokens.next(); !token.text.empty() && depth > 0;) {
            if (token.text == "#" && token.beginsLine) directive();
            if (token.text == "{") ++depth;
            if (token.text == "}" && --depth == 0) return;
            token = mTokens.next();
        }
    }

    bool has(std::string_view text) const { return std::ranges::count(mStatement, text, &Located::text) > 0; }

    void body() {
        dropLayout();
        if (has("=")) return skipBody(); // a list of initial values
        if (has("(")) {
            endStatement(true);
            return skipBody();
        }
        const bool isStruct = has("struct");
        if (!mStatement.empty() && mStatement.back().isWord && mStatement.back().text != "struct")
            add(isStruct ? Kind::Struct : Kind::Block, mStatement.back());
        skipBody();
        mStatement.assign(1, { "struct", true, mTokens.line() }); // the type of what follows
    }

    void dropLayout() {
        const auto layout = std::ranges::find(mStatement, "layout", &Located::text);
        if (layout == mStatement.end()) return;
        const auto at = static_cast<size_t>(layout - mStatement.begin());
        const size_t end = at + 1 < mStatement.size() ? behindBracket(mStatement, at + 1) : mStatement.size();
        mStatement.erase(layout, mStatement.begin() + static_cast<std::ptrdiff_t>(end));
    }

    void endStatement(bool isDefinition) {
        dropLayout();
        const Tokens statement = mStatement;
        const auto find = [&](std::string_view text) {
            return static_cast<size_t>(std::ranges::find(statement, text, &Located::text) - statement.begin());
        };
        const size_t open = find("("), equals = find("=");
        if (open < equals && open > 0)
            function(statement, open, isDefinition);
        else if (!statement.empty() && statement[0].text != "precision")
            variables(statement);
        mStatement.clear();
    }

    void function(Tokens statement, size_t open, bool isDefinition) {
        if (!statement[open - 1].isWord) return;
        GlslDeclaration& made = add(Kind::Function, statement[open - 1]);
        made.type = typeOf(statement.first(open - 1));
        const size_t end = behindBracket(statement, open);
        made.parameters = parameterTypes(statement.subspan(open + 1, end - open - (end > open + 1 ? 2 : 1)));
        made.isDefinition = isDefinition;
    }

    /// Every word in front of a separator is a name, except for the type.
    void variables(Tokens statement) {
        for (size_t i = 1; i < statement.size(); ++i) {
            const std::string_view mark = i + 1 < statement.size() ? statement[i + 1].text : ",";
            const bool isName = statement[i].isWord && (mark == "," || mark == "=" || mark == "[");
            if (isName) add(Kind::Variable, statement[i]);
            if (mark != "=" && mark != "[") continue;
            for (++i; i < statement.size() && statement[i].text != ",";)
                i = statement[i].text == "(" || statement[i].text == "[" ? behindBracket(statement, i) : i + 1;
        }
    }

    GlslTokens mTokens;
    std::string_view mFile;
    std::vector<Located> mStatement;
    std::vector<GlslDeclaration> mFound;
};

} // namespace

void readLineDirective(std::string_view rest, uint32_t& line, std::string_view& file) {
    const size_t digit = rest.find_first_of("0123456789");
    if (digit == std::string_view::npos) return;
    std::from_chars(rest.data() + digit, rest.data() + rest.size(), line);
    const size_t open = rest.find('"'), close = rest.rfind('"');
    if (open < close && close != std::string_view::npos) file = rest.substr(open + 1, close - open - 1);
}

std::vector<GlslDeclaration> outlineOf(std::string_view glsl, std::string_view file) {
    return Outline(glsl, file).run();
}

} // namespace filament_core::shader
