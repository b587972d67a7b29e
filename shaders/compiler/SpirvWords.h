// SPDX-License-Identifier: Apache-2.0
/// A SPIR-V module as words, for units that read it instruction by instruction.
///   In      a valid module (of glslang or SPIRV-Tools).   Thread  any.   Fails: never.
#pragma once

#include <spirv_cross/spirv.hpp>

#include <cstdint>
#include <span>

namespace filament_core::shader {

/// A module, or one of its instructions.
using SpirvWords = std::span<const uint32_t>;
using SpirvId = uint32_t; ///< 0 is none

inline constexpr size_t kModuleHeaderWords = 5; ///< magic number, version, generator, bound of the ids, schema
inline constexpr size_t kModuleBoundWord = 3;   ///< of the header

inline bool isTypeDeclaration(spv::Op op) { return op >= spv::OpTypeVoid && op <= spv::OpTypeForwardPointer; }

/// `visit(op, words)` for every instruction; words[0] is the instruction's own first word.
void forEachInstruction(SpirvWords module, auto&& visit) {
    for (size_t at = kModuleHeaderWords; at < module.size();) {
        const size_t count = module[at] >> 16;
        visit(static_cast<spv::Op>(module[at] & 0xFFFF), module.subspan(at, count));
        at += count;
    }
}

} // namespace filament_core::shader
