// SPDX-License-Identifier: Apache-2.0
/// canonicalOrder: one form for all SPIR-V modules that differ only in traces of code that the optimiser removed.
///   Why     dead code leaves traces: another order of constants, other ids. Without this step, a material that sets a
///           property to its default would differ from one that does not set it.
///   Out     types, constants and variables in the order in which the functions first need them; ids counted from 1 in
///           the order of their definition; names and decorations sorted by them.
///   Thread  any. Memory: the module twice. Fails: Internal for a module that SPIRV-Tools cannot read.
#pragma once

#include "base/Result.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

Result<std::vector<uint32_t>> canonicalOrder(std::span<const uint32_t> module);

} // namespace filament_core::shader
