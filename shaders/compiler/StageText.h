// SPDX-License-Identifier: Apache-2.0
/// StageText: assembles the GLSL of one stage from the engine's files, generated lines and the author's blocks.
///   Every piece is preceded by a #line directive, so that errors name the author's file and line.
///   Includes are followed recursively, each file at most once per stage.
///   Thread  one at a time. Limits: 4 MiB of text.
///   Fails   InvalidArgument, "file:line: cannot find ..." for an unknown include.
#pragma once

#include "shaders/compiler/Jsonish.h"

#include <set>
#include <string>
#include <string_view>

namespace filament::shader {

class StageText {
public:
    explicit StageText(IncludeResolver const& includes) : mIncludes(includes) {}

    void line(std::string_view text);
    void define(std::string_view name, std::string_view value = {});
    /// The following lines come from `at`, until the next piece. Does nothing for positions without a file.
    void originate(SourcePosition const& at);
    Result<void> include(std::string_view path);
    Result<void> block(GlslBlock const& block);

    std::string const& text() const { return mText; }
    std::string take() && { return std::move(mText); }

private:
    Result<void> lines(std::string_view text, std::string_view file, uint32_t firstLine);
    Result<void> include(std::string_view path, std::string_view fromFile, uint32_t fromLine);
    void lineDirective(uint32_t line, std::string_view file);

    IncludeResolver const& mIncludes;
    std::string mText;
    std::set<std::string, std::less<>> mIncluded;
};

} // namespace filament::shader
