// SPDX-License-Identifier: Apache-2.0
/// The first two steps of compileProgram, around glslang and SPIRV-Tools.
///   Thread  any. Memory: what the result holds. Deterministic.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"
#include "shaders/compiler/CompileProgram.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace filament::shader {

/// GLSL 450 with Vulkan semantics -> SPIR-V 1.3 with names. `#line n "file"` is understood and `name` is the file until
/// then.
///   Fails   InvalidArgument, "file:line: reason" of the first error and how many more there are.
Result<std::vector<uint32_t>> spirvFromGlsl(std::string_view glsl, backend::ShaderStage stage, std::string_view name);

/// SPIRV-Tools' passes for `goal`, which is not None. Fails: Internal if the module is not valid.
Result<std::vector<uint32_t>> optimizeSpirv(std::span<const uint32_t> spirv,
                                            Optimization goal = Optimization::Performance);

/// Computes in 16-bit floats whatever is marked RelaxedPrecision, with conversions where the two kinds meet. Vulkan
/// drivers may do so by themselves; Mesa's does not, so the compiler does.
///   Limits  of optimizeSpirv()'s making: no calls, no local variables. The coordinates of textures must be computed in
///           32 bits: Mesa 22 takes a conversion from 16 bits away and then stops the process ("Cannot emit physreg
///           copy instruction").
///   Fails   Unsupported if there is something that SPIRV-Tools cannot convert.
Result<std::vector<uint32_t>> halfFromRelaxed(std::span<const uint32_t> spirv);

/// Drops the names, which no driver needs.
Result<std::vector<uint32_t>> stripSpirv(std::span<const uint32_t> spirv);

} // namespace filament::shader
