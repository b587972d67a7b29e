// SPDX-License-Identifier: Apache-2.0
/// CodeScan: the words of a piece of GLSL outside its comments. Decides which interpolants the getters need.
///   May report too many (a function that is never called), but never misses one that the code really calls.
///   Thread  any, after construction. Memory: the words of the text.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace filament_core::shader {

class CodeScan {
public:
    explicit CodeScan(std::string_view glsl);

    std::set<std::string, std::less<>> const& words() const { return mWords; }
    bool mentions(std::string_view identifier) const { return mWords.contains(identifier); }
    /// Lines, from 0, to the first call of a function that the text does not declare; nothing if there is none.
    std::optional<uint32_t> lineOfCall(std::string_view function) const;

private:
    std::set<std::string, std::less<>> mWords;
    std::map<std::string, uint32_t, std::less<>> mCalls; ///< function -> line
    std::set<std::string, std::less<>> mDeclared;        ///< functions
};

} // namespace filament_core::shader
