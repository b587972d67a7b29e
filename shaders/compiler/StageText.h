// SPDX-License-Identifier: Apache-2.0
/// StageText: assembles the GLSL of one stage from the engine's files, generated lines and the author's blocks.
///   Every piece is preceded by a #line directive, so that errors name the author's file and line.
///   Includes are followed recursively. Each of the engine's files appears at most once per stage; an author's file
///   appears as often as it is included. Paths are relative to the including file, or else to the material.
///   Names   the engine's pieces and the generated lines get prefixes where the author uses the same names
///           (EngineNames.h); the author's macros end with the block.
///   Thread  one at a time. Limits: 4 MiB of text, includes 16 deep.
///   Fails   InvalidArgument, "file:line: cannot find ..." for an unknown include and for a file that includes itself.
///           Behind an #if, that is an error only if the branch is active: kMissingInclude stands in its place.
#pragma once

#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/Jsonish.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// What follows #error in place of an include that cannot be followed, in a branch that may be inactive.
inline constexpr std::string_view kMissingInclude = "filament_missing_include";

class StageText {
public:
    explicit StageText(IncludeResolver const& includes, NameSet const* prefixed = nullptr)
            : mIncludes(includes), mPrefixed(prefixed) {}

    void line(std::string_view text);
    void asItIs(std::string_view text) { mText += text; } ///< whole lines, without prefixes
    void define(std::string_view name, std::string_view value = {});
    /// Every whole `name` behind the first `from` bytes becomes `replacement`.
    void rename(size_t from, std::string_view name, std::string_view replacement);
    /// The following lines come from `at`, until the next piece. Does nothing for positions without a file.
    void originate(SourcePosition const& at);
    Result<void> include(std::string_view path);
    Result<void> block(GlslBlock const& block);

    std::string const& text() const { return mText; }
    std::string take() && { return std::move(mText); }

private:
    /// A file that is being read: its path as the resolver knows it; of a block, which names no path, its display name.
    struct Open {
        std::string path, name;
    };

    Result<void> lines(std::string_view text, Open const& file, uint32_t firstLine);
    Result<void> include(std::string_view path, uint32_t fromLine);
    Result<void> cannotInclude(uint32_t fromLine, std::string const& why);
    void lineDirective(uint32_t line, std::string_view file);
    void watch(std::string_view line);

    IncludeResolver const& mIncludes;
    NameSet const* mPrefixed;
    std::string mText;
    std::set<std::string, std::less<>> mIncluded; ///< files of the engine
    std::vector<Open> mOpen;
    std::vector<std::string> mMacros; ///< of the author's block
    uint32_t mConditions = 0;         ///< #if that are open in the author's block
    bool mIsInComment = false;
};

} // namespace filament_core::shader
