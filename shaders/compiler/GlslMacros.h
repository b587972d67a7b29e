// SPDX-License-Identifier: Apache-2.0
/// GlslMacros: how large the expansions of a text's macros become, from above, without expanding them.
///   Method  a linear form per macro: tokens + times * (tokens of the arguments). Of several definitions of a name, in
///           branches of #if, the larger one counts.
///   Thread  one.
///   Limits  sizes saturate at 2^40; macros use each other, and their calls nest, at most kMaxChain deep.
#pragma once

#include "shaders/compiler/GlslTokens.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace filament_core::shader {

/// Of an expansion: its tokens, its operators, and how often it repeats its arguments.
struct ExpansionSize {
    uint64_t tokens = 0, operators = 0, times = 0;

    void add(ExpansionSize const& other, uint64_t factor = 1);
    void addMark(std::string_view mark);
};

bool isOperator(std::string_view mark);

class GlslMacros {
public:
    static constexpr uint32_t kMaxChain = 100;

    /// `definition`: what follows #define.
    void define(std::string_view definition);
    /// Of the macro and of its arguments, whose tokens begin in `after` with a bracket; nothing if `name` is none.
    ExpansionSize sizeOf(std::string_view name, std::span<const GlslToken> after);
    bool isKnown(std::string_view name) const { return mMacros.contains(name); }
    bool isEmpty() const { return mMacros.empty(); }
    bool isTooDeep() const { return mIsTooDeep; } ///< sizes are not known then

private:
    struct Macro {
        bool hasArguments = false;
        std::set<std::string_view> parameters;
        std::vector<GlslToken> body;
        bool isMeasured = false, isOpen = false;
        ExpansionSize size{};
    };

    ExpansionSize measure(Macro& macro);
    ExpansionSize measure(std::vector<Macro>& definitions);
    ExpansionSize measure(std::span<const GlslToken> tokens, std::set<std::string_view> const& parameters);

    std::map<std::string_view, std::vector<Macro>> mMacros;
    uint32_t mChain = 0;
    bool mIsTooDeep = false;
};

} // namespace filament_core::shader
