// SPDX-License-Identifier: Apache-2.0
/// CodeScan: which words a piece of GLSL has outside of its comments. Decides which interpolants the getters need.
///   May say yes too often (a function that is never called), never no for code that really calls it.
///   Thread  any, once made. Memory: the words of the text.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace filament::shader {

class CodeScan {
public:
    explicit CodeScan(std::string_view glsl);

    bool mentions(std::string_view identifier) const { return mWords.contains(identifier); }
    /// Lines, from 0, to the first call of a function that the text does not declare; nothing if there is none.
    std::optional<uint32_t> lineOfCall(std::string_view function) const;

private:
    std::set<std::string, std::less<>> mWords;
    std::map<std::string, uint32_t, std::less<>> mCalls; ///< function -> line
    std::set<std::string, std::less<>> mDeclared;        ///< functions
};

} // namespace filament::shader
