// SPDX-License-Identifier: Apache-2.0
/// initializeVariables: a local variable without a value starts as zero, before drivers choose different values.
///   In      valid SPIR-V. Run it before the optimiser, which removes unused values.
///   Thread  any. Fails: never for a valid module. Cost: one pass over the words.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> initializeVariables(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
