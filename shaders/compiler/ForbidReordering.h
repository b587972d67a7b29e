// SPDX-License-Identifier: Apache-2.0
/// forbidReordering: marks every floating-point operation and function of a module so that drivers may not fuse,
/// reorder or replace it (SPIR-V: NoContraction; `precise` in the ESSL made from it).
///   Why     Mesa's GLSL compiler balances chains such as ((a + b) + c) + d into (a + b) + (c + d); its SPIR-V front
///           end does not (measured: every third result of a four-component dot product differed).
///   In      valid SPIR-V. Thread: any. Fails: never for a valid module. Cost: one pass over the words; no measurable
///           time on the software devices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> forbidReordering(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
