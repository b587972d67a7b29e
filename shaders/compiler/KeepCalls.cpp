// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/KeepCalls.h"

#include "shaders/compiler/SpirvWords.h"

#include <algorithm>

namespace filament_core::shader {

std::vector<uint32_t> keepCalls(std::span<const uint32_t> module) {
    std::vector<uint32_t> marked(module.begin(), module.end());
    std::vector<SpirvId> kept;
    forEachInstruction(module, [&](spv::Op op, SpirvWords words) {
        if (op == spv::OpName) {
            const std::string_view name(reinterpret_cast<const char*>(words.data() + 2));
            const auto isOf = [&](std::string_view call) { return name.starts_with(call); };
            if (std::ranges::any_of(kKeptCalls, isOf)) kept.push_back(words[1]);
        }
        // Result type, result, control, type: SPIR-V specification 1.3, 3.32.9.
        if (op == spv::OpFunction && std::ranges::count(kept, words[2]) > 0)
            marked[static_cast<size_t>(&words[3] - module.data())] = spv::FunctionControlDontInlineMask;
    });
    return marked;
}

} // namespace filament_core::shader
