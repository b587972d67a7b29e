// SPDX-License-Identifier: Apache-2.0
/// clampIndices: an index that is not constant selects the nearest element in range, before drivers choose others.
///   What    indices of vectors, matrices and arrays: in access chains of local variables and of blocks beyond the
///           engine's own groups, whose indices are always in range; and OpVectorExtractDynamic, OpVectorInsertDynamic.
///   In      valid SPIR-V of glslang with 32-bit indices. Run it before the optimiser, which may find the index to be a
///           constant out of range and then makes a module that is not valid.
///   Limits  arrays with a length; runtime arrays stay as they are.
///   Thread  any. Fails: never for a valid module. Cost: two operations per such index, none where the optimiser sees
///           that it is in range.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> clampIndices(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
