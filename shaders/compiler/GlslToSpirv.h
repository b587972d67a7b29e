// SPDX-License-Identifier: Apache-2.0
/// The first two steps of compileProgram, around glslang and SPIRV-Tools.
///   Thread  any. Memory: what the result holds. Deterministic.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"
#include "shaders/compiler/CompileProgram.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::shader {

/// GLSL 450 with Vulkan semantics -> SPIR-V 1.3 with names. `#line n "file"` is understood and `name` is the file until
/// then.
///   Fails   InvalidArgument, "file:line: reason": a line for each line of the source that is wrong; also for a loop
///           without an exit (EndlessLoops.h).
///   `withLines`: with OpLine and variables as in the source, for messages.
Result<std::vector<uint32_t>> spirvFromGlsl(std::string_view glsl, backend::ShaderStage stage, std::string_view name,
                                            bool withLines = false);

/// SPIRV-Tools' passes for `goal`, which is not None. Fails: Internal if the module is not valid.
Result<std::vector<uint32_t>> optimizeSpirv(std::span<const uint32_t> spirv,
                                            Optimization goal = Optimization::Performance);

/// The same as if specialisation constants, bools or ints, had these values.
Result<std::vector<uint32_t>> optimizeWith(std::span<const uint32_t> spirv,
                                           std::span<const backend::ConstantValue> constants);

/// Converts everything marked RelaxedPrecision to 16-bit floats, with conversions at the boundaries. Vulkan drivers may
/// do so themselves; Mesa's does not, so the compiler does.
///   Limits  output of optimizeSpirv(): no calls, no local variables. Texture coordinates must be computed in 32 bits:
///           Mesa 22 removes a conversion from 16 bits and then aborts the process ("Cannot emit physreg copy
///           instruction").
///   Fails   Unsupported for operations that SPIRV-Tools cannot convert.
Result<std::vector<uint32_t>> halfFromRelaxed(std::span<const uint32_t> spirv);

/// As text, for people. Fails: Corrupt for words that are no module.
Result<std::string> disassembleSpirv(std::span<const uint32_t> spirv);

/// Drops the names, which no driver needs.
Result<std::vector<uint32_t>> stripSpirv(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
