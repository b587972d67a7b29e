// SPDX-License-Identifier: Apache-2.0
/// A SPIR-V module as words, for units that read it instruction by instruction.
///   In      a valid module (of glslang or SPIRV-Tools).   Thread  any.   Fails: never.
#pragma once

#include <spirv_cross/spirv.hpp>

#include <cstdint>
#include <span>

namespace filament::shader {

inline constexpr size_t kModuleHeaderWords = 5; ///< magic number, version, generator, bound of the ids, schema

/// `visit(op, words)` for every instruction; words[0] is the instruction's own first word.
void forEachInstruction(std::span<const uint32_t> module, auto&& visit) {
    for (size_t at = kModuleHeaderWords; at < module.size();) {
        const size_t count = module[at] >> 16;
        visit(static_cast<spv::Op>(module[at] & 0xFFFF), module.subspan(at, count));
        at += count;
    }
}

} // namespace filament::shader
