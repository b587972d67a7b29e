// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslLimits.h"

#include "shaders/compiler/GlslMacros.h"
#include "shaders/compiler/GlslOutline.h"
#include "shaders/compiler/GlslTokens.h"

namespace filament_core::shader {
namespace {

/// The depth of the syntax tree: operators since the last separator, in all brackets that are open.
class ExpressionDepth {
public:
    uint64_t depth() const { return mSum; }
    size_t brackets() const { return mLevels.size() - 1; }
    bool isInList() const { return mLevels.back().isList; }

    void add(uint64_t operators) {
        mLevels.back().value += operators;
        mSum += operators;
    }
    void separate() {
        Level& level = mLevels.back();
        level.most = std::max(level.most, level.value);
        mSum -= level.value;
        level.value = 0;
    }
    void open(bool isList) {
        add(1);
        mLevels.push_back({ .isList = isList });
    }
    void close() {
        if (mLevels.size() < 2) return; // glslang reports it
        separate();
        const uint64_t inside = mLevels.back().most;
        mLevels.pop_back();
        add(inside); // as the operand of what follows
    }
    void endStatement() {
        mLevels.assign(1, {});
        mSum = 0;
    }

private:
    struct Level {
        uint64_t value = 0, most = 0;
        bool isList = false; ///< of arguments or values: they are beside each other in the tree
    };
    std::vector<Level> mLevels{ {} };
    uint64_t mSum = 0;
};

/// One pass over the tokens of a stage; the macros are known.
class LimitCheck {
public:
    explicit LimitCheck(GlslMacros& macros) : mMacros(macros) {}

    /// Returns what is exceeded at token `i`, or null.
    const char* check(std::span<const GlslToken> tokens, size_t i) {
        GlslToken const& token = tokens[i];
        ++mTokens;
        if (token.isWord)
            word(tokens, i);
        else
            mark(token.text);
        if (mMacros.isTooDeep()) return "macros use macros more than 100 deep; use functions";
        if (mTokens > kMaxTokens)
            return "the macros of this shader expand to more than a million tokens; use functions";
        if (mDepth.brackets() + mBlocks.size() > kMaxNesting) return "brackets are nested too deeply; use variables";
        if (mDepth.depth() > kMaxDepth) return "this expression has too many operators; split it with variables";
        if (mBlocks.back().elses > kMaxElses) return "this function has more than a thousand else; use a table";
        if (mInlined > kMaxInlined) return "functions that call functions add up to too much code; use loops";
        mPrevious = token;
        return nullptr;
    }

private:
    static constexpr uint32_t kMaxElses = 1000;

    struct Block {
        uint32_t elses = 0; ///< each nests in the one before
    };

    void word(std::span<const GlslToken> tokens, size_t i) {
        const std::string_view text = tokens[i].text;
        const auto after = tokens.subspan(i + 1);
        ++mInlined;
        if (text == "else") ++mBlocks.back().elses;
        if (text == "else" || text == "do") mDepth.add(1);
        if (mMacros.isKnown(text)) {
            const ExpansionSize size = mMacros.sizeOf(text, after);
            mTokens += size.tokens;
            mDepth.add(size.operators);
        }
        if (after.empty() || after[0].text != "(") return;
        if (mBlocks.size() == 1 && mDepth.brackets() == 0) mFunction = text;
        if (const auto called = mFunctions.find(text); called != mFunctions.end()) mInlined += called->second;
    }

    void mark(std::string_view text) {
        const bool isValue = mPrevious.text == "=" || mPrevious.text == "," || mPrevious.text == "(";
        if (text == "(" || text == "[") {
            mDepth.open(mPrevious.isWord || mPrevious.text == "]");
        } else if (text == "{" && (isValue || (mPrevious.text == "{" && mDepth.isInList()))) {
            mDepth.open(true);
        } else if (text == ")" || text == "]" || (text == "}" && mDepth.isInList())) {
            mDepth.close();
        } else if (text == "{" || text == "}") {
            mDepth.endStatement();
            text == "{" ? openBlock() : closeBlock();
        } else if (text == ";" && mDepth.brackets() == 0) {
            mDepth.endStatement();
        } else if (text == ";" || (text == "," && mDepth.isInList())) {
            mDepth.separate();
        } else {
            mDepth.add(1);
        }
    }

    void openBlock() {
        if (mBlocks.size() == 1) mInlined = 0;
        mBlocks.push_back({});
    }

    void closeBlock() {
        if (mBlocks.size() < 2) return; // glslang reports it
        mBlocks.pop_back();
        if (mBlocks.size() > 1) return;
        uint64_t& known = mFunctions[mFunction];
        known = std::max(known, mInlined); // the largest of several overloads
    }

    GlslMacros& mMacros;
    ExpressionDepth mDepth;
    std::vector<Block> mBlocks{ {} };
    std::map<std::string_view, uint64_t> mFunctions; // tokens with all calls inlined
    std::string_view mFunction;
    GlslToken mPrevious;
    uint64_t mTokens = 0, mInlined = 0;
};

/// A token and where the author wrote it.
struct LocatedTokens {
    std::vector<GlslToken> tokens;
    std::vector<std::pair<size_t, std::string_view>> files; // from this token on
    std::vector<uint32_t> lines;                            // of every token
};

/// `#line NUMBER "file"`
void readLine(std::string_view rest, GlslTokens& tokens, LocatedTokens& text) {
    uint32_t line = tokens.line() + 1;
    std::string_view file;
    readLineDirective(rest, line, file);
    tokens.setLine(line - 1); // the next line has this number
    if (!file.empty()) text.files.emplace_back(text.tokens.size(), file);
}

LocatedTokens locatedTokensOf(std::string_view glsl, std::string_view name, GlslMacros& macros) {
    LocatedTokens text;
    text.files.emplace_back(0, name);
    GlslTokens tokens(glsl);
    tokens.setLine(1);
    for (GlslToken token = tokens.next(); !token.text.empty(); token = tokens.next()) {
        if (token.text == "#" && token.beginsLine) {
            const GlslToken directive = tokens.next();
            if (directive.beginsLine) continue;
            const std::string_view rest = tokens.restOfLine();
            if (directive.text == "define") macros.define(rest);
            if (directive.text == "line") readLine(rest, tokens, text);
            continue;
        }
        text.tokens.push_back(token);
        text.lines.push_back(tokens.line());
    }
    return text;
}

std::string placeOfToken(LocatedTokens const& text, size_t token) {
    std::string_view file;
    for (auto const& [from, name] : text.files)
        if (from <= token) file = name;
    return std::string(file) + ':' + std::to_string(text.lines[token]);
}

} // namespace

Result<void> checkGlslLimits(std::string_view glsl, std::string_view name) {
    GlslMacros macros;
    const LocatedTokens text = locatedTokensOf(glsl, name, macros);
    LimitCheck check(macros);
    for (size_t i = 0; i < text.tokens.size(); ++i) {
        if (const char* const exceeded = check.check(text.tokens, i))
            return fail(ErrorCode::InvalidArgument, "{}: {}", placeOfToken(text, i), exceeded);
    }
    return {};
}

} // namespace filament_core::shader
