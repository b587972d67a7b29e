// SPDX-License-Identifier: Apache-2.0
/// CodeScan: what a piece of GLSL mentions, found by reading its words. Decides what a material pays for.
///   May say yes too often (the material then computes something that it ignores), never no for code that really does
///   it: where macros could hide a member access, any mention of the word counts.
///   Thread  any, once made. Memory: the words of the text.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace filament::shader {

class CodeScan {
public:
    explicit CodeScan(std::string_view glsl);

    bool mentions(std::string_view identifier) const { return mWords.contains(identifier); }
    /// `member` of a variable of type MaterialInputs is read or written.
    bool touches(std::string_view member) const;

private:
    std::set<std::string, std::less<>> mWords;
    std::set<std::string, std::less<>> mMembers; ///< y of every x.y with x a MaterialInputs
    bool mHasMacros = false;
};

} // namespace filament::shader
