// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/EsslConditions.h"

#include <cctype>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace filament_core::shader {
namespace {

constexpr std::string_view kMacro = "SPIRV_CROSS_CONSTANT_ID_";

bool isWordStart(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isWordPart(char c) { return isWordStart(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    return lines;
}

size_t indentOf(std::string_view line) {
    const size_t indent = line.find_first_not_of(' ');
    return indent == std::string_view::npos ? line.size() : indent;
}

/// What is between a beginning and an end.
std::optional<std::string_view> between(std::string_view text, std::string_view begin, std::string_view end) {
    if (text.size() < begin.size() + end.size() || !text.starts_with(begin) || !text.ends_with(end)) return {};
    return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

/// Expressions of the preprocessor for constants of the text.
class Constants {
public:
    /// "const bool _42 = (quality_fog != 0);"
    void read(std::string_view line) {
        for (const std::string_view type : { "const bool ", "const int " }) {
            const auto definition = between(line, type, ";");
            const size_t equals = definition ? definition->find(" = ") : std::string_view::npos;
            if (equals == std::string_view::npos) continue;
            if (auto value = expression(definition->substr(equals + 3)))
                mValues.emplace(definition->substr(0, equals), "(" + *value + ")");
        }
    }

    /// Nothing if something of it is unknown, or cannot be written for the preprocessor.
    std::optional<std::string> expression(std::string_view text) const {
        std::string out;
        for (size_t i = 0; i < text.size();) {
            if (!isWordStart(text[i])) {
                if (!isKnownSign(text[i])) return {};
                out += text[i++];
                continue;
            }
            const size_t begin = i;
            while (i < text.size() && isWordPart(text[i])) ++i;
            const std::string_view word = text.substr(begin, i - begin);
            const auto value = mValues.find(word);
            if (value == mValues.end() && !word.starts_with(kMacro)) return {};
            out += value == mValues.end() ? word : std::string_view(value->second);
        }
        return out;
    }

private:
    /// Of numbers and operators of whole numbers.
    static bool isKnownSign(char c) {
        return std::string_view(" ()!=<>&|^~+-*0123456789").find(c) != std::string_view::npos;
    }

    std::map<std::string, std::string, std::less<>> mValues;
};

/// Adds lines, and the directives that a branch needs.
class Rewriter {
public:
    explicit Rewriter(std::vector<std::string_view> lines) : mLines(std::move(lines)) {}

    std::string rewrite() {
        for (mAt = 0; mAt < mLines.size(); ++mAt) step(mLines[mAt]);
        return std::move(mOut);
    }

private:
    void add(std::string_view line) {
        mOut += line;
        mOut += '\n';
    }

    std::string_view next(size_t distance) const {
        return mAt + distance < mLines.size() ? mLines[mAt + distance] : std::string_view();
    }

    /// A line that has nothing but this, as far in.
    static bool isAt(std::string_view line, size_t indent, std::string_view word) {
        return indentOf(line) == indent && line.substr(indent) == word;
    }

    void step(std::string_view line) {
        const size_t indent = indentOf(line);
        if (indent == 0) mConstants.read(line);
        const bool isElse = !mBranches.empty() && isAt(line, mBranches.back(), "else");
        if (isElse) return add("#else");
        const auto condition = between(line.substr(indent), "if (", ")");
        const auto known = condition && isAt(next(1), indent, "{") ? mConstants.expression(*condition) : std::nullopt;
        if (known) {
            mBranches.push_back(indent);
            return add("#if " + *known);
        }
        add(asComparison(line));
        const bool ends = !mBranches.empty() && isAt(line, mBranches.back(), "}");
        if (!ends || isAt(next(1), indent, "else")) return;
        mBranches.pop_back();
        add("#endif");
    }

    /// The default of a bool.
    static std::string asComparison(std::string_view line) {
        std::string text(line);
        for (const auto& [word, comparison] :
             { std::pair{ " true", " (1 == 1)" }, std::pair{ " false", " (1 == 0)" } }) {
            if (line.starts_with("#define " + std::string(kMacro)) && line.ends_with(word))
                text.replace(text.size() - std::string_view(word).size(), std::string::npos, comparison);
        }
        return text;
    }

    std::vector<std::string_view> mLines;
    size_t mAt = 0;
    Constants mConstants;
    std::vector<size_t> mBranches; ///< how far in the open ones stand, outermost first
    std::string mOut;
};

} // namespace

std::string preprocessConditions(std::string_view essl) { return Rewriter(linesOf(essl)).rewrite(); }

} // namespace filament_core::shader
