// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/FragmentOutputs.h"

#include "backend/api/Descriptions.h"

#include <algorithm>
#include <array>

namespace filament_core::shader {
namespace {

// SPIR-V specification 1.3: 3.32.3, 3.32.8, 3.32.9, 3.7, 3.20, 3.21.
constexpr uint32_t kFunction = 54, kVariable = 59, kDecorate = 71;
constexpr uint32_t kOutputStorage = 3, kBuiltIn = 11, kLocation = 30, kFragDepth = 22;

/// Calls visit(op, words) for each instruction before the first function.
template <class Visit>
void visitDeclarations(std::span<const uint32_t> spirv, Visit&& visit) {
    constexpr size_t kHeader = 5;
    for (size_t at = kHeader; at < spirv.size();) {
        const uint32_t op = spirv[at] & 0xFFFF;
        const size_t count = spirv[at] >> 16;
        if (count == 0 || count > spirv.size() - at || op == kFunction) return;
        visit(op, spirv.subspan(at, count));
        at += count;
    }
}

} // namespace

FragmentOutputs fragmentOutputs(std::span<const uint32_t> spirv) {
    std::array<uint32_t, backend::kMaxColorAttachments + 1> variables{}; // and the depth
    size_t count = 0;
    visitDeclarations(spirv, [&](uint32_t op, std::span<const uint32_t> words) {
        const bool isOutput = op == kVariable && words.size() >= 4 && words[3] == kOutputStorage;
        if (isOutput && count < variables.size()) variables[count++] = words[2];
    });
    FragmentOutputs outputs;
    visitDeclarations(spirv, [&](uint32_t op, std::span<const uint32_t> words) {
        const auto known = std::span(variables).first(count);
        if (op != kDecorate || words.size() != 4 || std::ranges::find(known, words[1]) == known.end()) return;
        if (words[2] == kLocation) outputs.colors |= 1u << (words[3] & 31);
        if (words[2] == kBuiltIn && words[3] == kFragDepth) outputs.depth = true;
    });
    return outputs;
}

} // namespace filament_core::shader
