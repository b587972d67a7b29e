// SPDX-License-Identifier: Apache-2.0
/// Gives variables and indices that GLSL leaves undefined one value, before drivers choose different ones.
///   initializeVariables   a local variable without a value starts as zero (run it before the optimiser, which removes
///                         the values that nobody reads).
///   hasDynamicIndices     whether an index that is not constant selects from a local variable or from a block beyond
///                         the engine's own groups, whose indices are always in range.
///   In      valid SPIR-V. Thread: any. Fails: never for a valid module. Cost: one pass over the words.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament::shader {

std::vector<uint32_t> initializeVariables(std::span<const uint32_t> spirv);
bool hasDynamicIndices(std::span<const uint32_t> spirv);

} // namespace filament::shader
