// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/GlslMacros.h"

#include <algorithm>
#include <utility>

namespace filament_core::shader {
namespace {

constexpr uint64_t kHuge = uint64_t(1) << 40;

uint64_t saturated(uint64_t a, uint64_t factor, uint64_t b) {
    if (factor != 0 && b > kHuge / factor) return kHuge;
    return std::min(a + factor * b, kHuge);
}

/// The tokens between the bracket with which `tokens` begins and the one that closes it.
std::span<const GlslToken> insideBracket(std::span<const GlslToken> tokens) {
    size_t depth = 0;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text == "(") ++depth;
        if (tokens[i].text == ")" && --depth == 0) return tokens.subspan(1, i - 1);
    }
    return tokens.subspan(1);
}

} // namespace

bool isOperator(std::string_view mark) {
    return mark != ")" && mark != "]" && mark != "," && mark != ";" && mark != "}";
}

void ExpansionSize::add(ExpansionSize const& other, uint64_t factor) {
    tokens = saturated(tokens, factor, other.tokens);
    operators = saturated(operators, factor, other.operators);
    times = saturated(times, factor, other.times);
}

void ExpansionSize::addMark(std::string_view mark) {
    ++tokens;
    if (isOperator(mark)) ++operators;
}

void GlslMacros::define(std::string_view definition) {
    GlslTokens tokens(definition);
    const GlslToken name = tokens.next();
    if (!name.isWord) return; // glslang reports it
    Macro macro;
    GlslToken token = tokens.next();
    macro.hasArguments = token.text == "(" && token.touches;
    if (macro.hasArguments) {
        while (!token.text.empty() && token.text != ")") {
            token = tokens.next();
            if (token.isWord) macro.parameters.insert(token.text);
        }
        token = tokens.next();
    }
    for (; !token.text.empty(); token = tokens.next()) macro.body.push_back(token);
    mMacros[name.text].push_back(std::move(macro));
}

ExpansionSize GlslMacros::sizeOf(std::string_view name, std::span<const GlslToken> after) {
    const auto found = mMacros.find(name);
    if (found == mMacros.end()) return {};
    ExpansionSize size = measure(found->second);
    if (size.times > 0 && !after.empty() && after[0].text == "(")
        size.add(measure(insideBracket(after), {}), size.times);
    return size;
}

ExpansionSize GlslMacros::measure(std::vector<Macro>& definitions) {
    ExpansionSize most;
    for (Macro& macro : definitions) {
        const ExpansionSize size = measure(macro);
        most = { std::max(most.tokens, size.tokens), std::max(most.operators, size.operators),
                 std::max(most.times, size.times) };
    }
    return most;
}

ExpansionSize GlslMacros::measure(Macro& macro) {
    if (macro.isMeasured || macro.isOpen) return macro.size; // open: the preprocessor does not expand it again
    macro.isOpen = true;
    macro.size = measure(macro.body, macro.parameters);
    macro.isOpen = false;
    macro.isMeasured = true;
    return macro.size;
}

ExpansionSize GlslMacros::measure(std::span<const GlslToken> tokens, std::set<std::string_view> const& parameters) {
    ExpansionSize sum;
    if (mChain >= kMaxChain) {
        mIsTooDeep = true;
        return sum;
    }
    ++mChain;
    for (size_t i = 0; i < tokens.size(); ++i) {
        if (!tokens[i].isWord) {
            sum.addMark(tokens[i].text);
            continue;
        }
        ++sum.tokens;
        if (parameters.contains(tokens[i].text)) ++sum.times;
        const auto found = mMacros.find(tokens[i].text);
        if (found == mMacros.end()) continue;
        ExpansionSize size = measure(found->second);
        const uint64_t times = std::exchange(size.times, 0);
        sum.add(size);
        if (times == 0 || i + 1 >= tokens.size() || tokens[i + 1].text != "(") continue;
        const std::span<const GlslToken> inside = insideBracket(tokens.subspan(i + 1));
        sum.add(measure(inside, parameters), times);
        i += inside.size() + 1;
    }
    --mChain;
    return sum;
}

} // namespace filament_core::shader
