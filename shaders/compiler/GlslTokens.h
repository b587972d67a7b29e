// SPDX-License-Identifier: Apache-2.0
/// GlslTokens: splits GLSL into words and marks, without comments. For estimates: numbers are words, and an operator of
/// several characters is several marks.
///   Thread  one. Memory: none; tokens point into the text.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>

namespace filament_core::shader {

inline bool isGlslWordPart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct GlslToken {
    std::string_view text; ///< empty: the end
    bool isWord = false;
    bool beginsLine = false; ///< the first of its line: '#' is then a directive
    bool touches = false;    ///< no blank in front of it, as "(" in #define NAME(
};

class GlslTokens {
public:
    explicit GlslTokens(std::string_view text) : mRest(text) {}

    uint32_t line() const { return mLine; } ///< from 0
    void setLine(uint32_t line) { mLine = line; }

    GlslToken next() {
        const bool touches = !skipBlanks();
        if (mRest.empty()) return {};
        GlslToken token{ mRest.substr(0, 1), isWordStart(mRest[0]), mBeginsLine, touches };
        if (token.isWord) token.text = mRest.substr(0, wordLength());
        mRest.remove_prefix(token.text.size());
        mBeginsLine = false;
        return token;
    }

    /// The rest of the line, with those that "\" joins to it.
    std::string_view restOfLine() {
        size_t end = mRest.find('\n');
        while (end != std::string_view::npos && end > 0 && mRest[end - 1] == '\\') {
            ++mLine;
            end = mRest.find('\n', end + 1);
        }
        const std::string_view line = mRest.substr(0, end);
        mRest.remove_prefix(line.size());
        return line;
    }

private:
    bool isWordStart(char c) const {
        const bool isFraction = c == '.' && mRest.size() > 1 && std::isdigit(static_cast<unsigned char>(mRest[1])) != 0;
        return isGlslWordPart(c) || isFraction;
    }

    size_t wordLength() const {
        const bool isNumber = std::isalpha(static_cast<unsigned char>(mRest[0])) == 0 && mRest[0] != '_';
        size_t length = 1;
        while (length < mRest.size() && (isGlslWordPart(mRest[length]) || (isNumber && mRest[length] == '.'))) ++length;
        return length;
    }

    /// Returns whether there was anything.
    bool skipBlanks() {
        const size_t before = mRest.size();
        while (!mRest.empty()) {
            if (mRest[0] == '\n') ++mLine, mBeginsLine = true;
            if (mRest[0] == '\\' || std::isspace(static_cast<unsigned char>(mRest[0])) != 0) {
                mRest.remove_prefix(1);
            } else if (mRest.starts_with("//")) {
                mRest.remove_prefix(std::min(mRest.find('\n'), mRest.size()));
            } else if (mRest.starts_with("/*")) {
                const std::string_view comment = mRest.substr(0, mRest.find("*/", 2));
                mLine += static_cast<uint32_t>(std::ranges::count(comment, '\n'));
                mRest.remove_prefix(std::min(comment.size() + 2, mRest.size()));
            } else {
                break;
            }
        }
        return mRest.size() != before;
    }

    std::string_view mRest;
    uint32_t mLine = 0;
    bool mBeginsLine = true;
};

} // namespace filament_core::shader
