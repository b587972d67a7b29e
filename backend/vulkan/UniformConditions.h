// SPDX-License-Identifier: Apache-2.0
/// UniformConditions: makes conditions that uniforms take part in look as if nothing of them were known before the
/// draw. For Quirks::inlinesUniforms.
///   In      a module that readEdges() accepts.
///   Out     the same results: such a condition `c` becomes `v && c`, and a selector `v ? s : 0`, where v is true but
///           no compiler can know it: gl_FragCoord.x > 0, or gl_VertexIndex > -1. It stands first, because the driver
///           reads a condition from left to right and ends where something varies. Modules without such conditions stay
///           as they are.
///   Source  SPIR-V 1.6 specification, sections 2.4 (logical layout) and 3.52 (instructions).
///   Thread  any; a pure function.
///   Limits  sees through arithmetic, phis and variables of functions, not through calls. A module that is not valid
///           may become another one that is not valid, of whole instructions (fuzzed: tests/fuzz/ShaderWordsFuzz.cpp).
///   Cost    two walks over the words; one operation for each such condition and invocation.
///   Remove  with that quirk, once every supported Mesa gives up inlining uniforms where a stage does not shrink: then
///           tests/filament_core/engine/CompilationsTest.cpp passes without it.
#pragma once

#include "backend/api/Descriptions.h"

#include <cstdint>
#include <vector>

namespace filament_core::backend::vulkan {

std::vector<uint32_t> hideUniformConditions(std::vector<uint32_t> words, ShaderStage stage);

} // namespace filament_core::backend::vulkan
