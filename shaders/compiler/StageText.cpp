// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/StageText.h"

#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslTokens.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace filament_core::shader {
namespace {

constexpr size_t kMaxBytes = 4 << 20;
constexpr size_t kMaxCodeIncludeDepth = 16;

/// The line without comments; `isInComment` says whether a comment of several lines is open.
std::string withoutComments(std::string_view line, bool& isInComment) {
    std::string out;
    while (!line.empty()) {
        if (isInComment) {
            const size_t end = line.find("*/");
            if (end == std::string_view::npos) break;
            isInComment = false;
            line.remove_prefix(end + 2);
        } else if (line.starts_with("//")) {
            break;
        } else if (line.starts_with("/*")) {
            isInComment = true;
            line.remove_prefix(2);
        } else {
            out += line[0];
            line.remove_prefix(1);
        }
    }
    return out;
}

std::string_view withoutBlanks(std::string_view text) {
    const size_t begin = text.find_first_not_of(" \t\r");
    return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

/// "include" and the like, and what follows; an empty name for lines that are no directive.
struct Directive {
    std::string_view name, rest;
};

Directive directiveOf(std::string_view line) {
    line = withoutBlanks(line);
    if (!line.starts_with('#')) return {};
    line = withoutBlanks(line.substr(1));
    const auto end = std::ranges::find_if_not(line, [](unsigned char c) { return std::isalpha(c) != 0; });
    const auto length = static_cast<size_t>(end - line.begin());
    return { line.substr(0, length), withoutBlanks(line.substr(length)) };
}

/// The path in quotes; empty if there is none.
std::string_view quotedPath(std::string_view rest) {
    const size_t open = rest.find('"'), close = rest.rfind('"');
    return open < close && close != std::string_view::npos ? rest.substr(open + 1, close - open - 1)
                                                           : std::string_view{};
}

/// "a/b.glsl", "c.glsl" -> "a/c.glsl"
std::string besides(std::string_view file, std::string_view path) {
    const size_t slash = file.rfind('/');
    const bool isAlone = slash == std::string_view::npos || path.starts_with('/');
    return isAlone ? std::string(path) : std::string(file.substr(0, slash + 1)) + std::string(path);
}

void replaceWhole(std::string& text, size_t from, std::string_view name, std::string_view replacement) {
    for (size_t at = text.find(name, from); at != std::string::npos; at = text.find(name, at + 1)) {
        const size_t end = at + name.size();
        const bool isWhole =
                (at == 0 || !isGlslWordPart(text[at - 1])) && (end == text.size() || !isGlslWordPart(text[end]));
        if (isWhole) text.replace(at, name.size(), replacement);
    }
}

/// The names that OpenGL has and Vulkan's GLSL does not. The engine merges draw calls, so that gl_InstanceIndex would
/// reveal which renderables share one.
std::string withVulkanNames(std::string_view line) {
    static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        { "gl_VertexID", "gl_VertexIndex" }, { "gl_InstanceID", "filament_instanceId()" }
    };
    std::string out(line);
    for (auto const& [name, replacement] : kNames) replaceWhole(out, 0, name, replacement);
    return out;
}

} // namespace

void StageText::line(std::string_view text) {
    mText += mPrefixed ? withPrefixes(text, *mPrefixed) : std::string(text);
    mText += '\n';
}

void StageText::define(std::string_view name, std::string_view value) {
    line(fmt::format("#define {} {}", name, value));
}

void StageText::rename(size_t from, std::string_view name, std::string_view replacement) {
    replaceWhole(mText, from, name, replacement);
}

void StageText::originate(SourcePosition const& at) {
    if (at.file) lineDirective(at.line, *at.file);
}

void StageText::lineDirective(uint32_t line, std::string_view file) {
    std::string name(file);
    std::ranges::replace_if(
            name, [](unsigned char c) { return c < ' ' || c == '"' || c == '\\'; }, '_');
    fmt::format_to(std::back_inserter(mText), "#line {} \"{}\"\n", line, name);
}

/// Counts the author's #if, and collects the macros.
void StageText::watch(std::string_view line) {
    const Directive directive = directiveOf(line);
    if (directive.name.starts_with("if")) ++mConditions;
    if (directive.name == "endif" && mConditions > 0) --mConditions;
    if (directive.name != "define") return;
    const auto end = std::ranges::find_if_not(directive.rest, isGlslWordPart);
    mMacros.emplace_back(directive.rest.begin(), end);
}

Result<void> StageText::lines(std::string_view text, Open const& file, uint32_t firstLine) {
    if (mText.size() + text.size() > kMaxBytes)
        return fail(ErrorCode::InvalidArgument, "{}: the shader is larger than 4 MiB", file.name);
    mOpen.push_back(file);
    lineDirective(firstLine, file.name);
    const bool wasInComment = std::exchange(mIsInComment, false);
    for (uint32_t number = firstLine; !text.empty(); ++number) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view current = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const bool beginsInComment = mIsInComment;
        const std::string code = withoutComments(current, mIsInComment);
        const Directive directive = directiveOf(code);
        if (directive.name == "include" && !beginsInComment) {
            if (Result<void> done = include(quotedPath(directive.rest), number); !done) return done;
            if (mIsInComment) mText += "/*\n";
            lineDirective(number + 1, file.name);
        } else {
            watch(code);
            mText += withVulkanNames(current);
            mText += '\n';
        }
    }
    mIsInComment = wasInComment;
    mOpen.pop_back();
    return {};
}

Result<void> StageText::cannotInclude(uint32_t fromLine, std::string const& why) {
    if (mConditions == 0) return fail(ErrorCode::InvalidArgument, "{}:{}: {}", mOpen.back().name, fromLine, why);
    lineDirective(fromLine, mOpen.back().name);
    mText += fmt::format("#error {}\n", kMissingInclude);
    return {};
}

Result<void> StageText::include(std::string_view path, uint32_t fromLine) {
    if (path.empty()) return cannotInclude(fromLine, "#include needs a path in quotes");
    if (embeddedSource(path)) return include(path);
    std::string found = besides(mOpen.back().path, path);
    std::optional<std::string> text = mIncludes ? mIncludes(found) : std::nullopt;
    if (!text && found != path) {
        found = path;
        text = mIncludes ? mIncludes(found) : std::nullopt;
    }
    if (!text) return cannotInclude(fromLine, fmt::format("cannot find the file \"{}\" of this #include", path));
    if (std::ranges::count(mOpen, found, &Open::path) > 0)
        return cannotInclude(fromLine, fmt::format("\"{}\" includes itself", path));
    if (mOpen.size() >= kMaxCodeIncludeDepth) return cannotInclude(fromLine, "includes are nested more than 16 deep");
    return lines(*text, { found, found }, 1);
}

Result<void> StageText::include(std::string_view path) {
    if (!mIncluded.emplace(path).second) return {};
    const std::optional<std::string_view> text = embeddedSource(path);
    if (!text) return fail(ErrorCode::Internal, "the engine has no file \"{}\"", path);
    const Open file{ std::string(path), std::string(path) };
    const bool isWanted =
            !mOpen.empty() && !isEngineFile(mOpen.back().path); // by the author, who gives it macros and uses its names
    if (!isEngineFile(path)) return lines(*text, file, 1);
    const uint32_t conditions = mConditions;
    const std::vector<std::string> macros = mMacros;
    Result<void> done = lines(mPrefixed && !isWanted ? withPrefixes(*text, *mPrefixed) : *text, file, 1);
    mConditions = conditions;
    mMacros = macros;
    return done;
}

Result<void> StageText::block(GlslBlock const& block) {
    mConditions = 0;
    mMacros.clear();
    Result<void> done;
    if (!block.defines.empty()) done = lines(block.defines, { {}, "command line" }, 1);
    if (done) done = lines(block.text, { {}, block.at.file ? *block.at.file : "material" }, block.at.line);
    if (done && mConditions > 0) return errorAt(block.at, "this block has an #if without its #endif");
    lineDirective(1, "generated");
    for (std::string const& macro : mMacros) mText += fmt::format("#undef {}\n", macro);
    return done;
}

} // namespace filament_core::shader
