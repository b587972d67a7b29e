// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/StageText.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace filament::shader {
namespace {

constexpr size_t kMaxBytes = 4 << 20;

/// The path of `#include "path"`; no value for other lines; empty for an include without quotes.
std::optional<std::string_view> includedPath(std::string_view line) {
    const size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos || !line.substr(begin).starts_with("#include")) return std::nullopt;
    const size_t open = line.find('"'), close = line.rfind('"');
    return open < close && close != std::string_view::npos ? line.substr(open + 1, close - open - 1)
                                                           : std::string_view{};
}

} // namespace

void StageText::line(std::string_view text) {
    mText += text;
    mText += '\n';
}

void StageText::define(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(mText), "#define {} {}\n", name, value);
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

Result<void> StageText::lines(std::string_view text, std::string_view file, uint32_t firstLine) {
    if (mText.size() + text.size() > kMaxBytes)
        return fail(ErrorCode::InvalidArgument, "{}: the shader is larger than 4 MiB", file);
    lineDirective(firstLine, file);
    for (uint32_t number = firstLine; !text.empty(); ++number) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view current = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (const auto path = includedPath(current)) {
            if (Result<void> done = include(*path, file, number); !done) return done;
            lineDirective(number + 1, file);
        } else {
            line(current);
        }
    }
    return {};
}

Result<void> StageText::include(std::string_view path, std::string_view fromFile, uint32_t fromLine) {
    if (mIncluded.contains(path)) return {};
    mIncluded.emplace(path);
    const std::optional<std::string> text = mIncludes ? mIncludes(path) : std::nullopt;
    if (!text)
        return fail(ErrorCode::InvalidArgument, "{}:{}: cannot find the file \"{}\" of this #include", fromFile,
                    fromLine, path);
    return lines(*text, path, 1);
}

Result<void> StageText::include(std::string_view path) { return include(path, "generated", 1); }

Result<void> StageText::block(GlslBlock const& block) {
    return lines(block.text, block.at.file ? std::string_view(*block.at.file) : "material", block.at.line);
}

} // namespace filament::shader
