// SPDX-License-Identifier: Apache-2.0
/// foldConstants: a module without the code that the values of specialisation constants rule out.
///   Why     the material compiler writes one module for every set of lights and effects. Drivers, too, drop what a
///           pipeline never runs, but only after they have translated all of it: half the time of a first frame.
///   In      a module that readEdges() accepts, and the constants of the program.
///   Out     the same results. A branch whose condition follows from the constants becomes a jump, and blocks that
///           nothing reaches any more are gone, with the names and decorations of what they define. The constants
///           stay, so the pipeline specialises as before. Modules without such branches stay as they are.
///   Source  SPIR-V 1.6 specification, sections 2.4 (logical layout), 2.11 (structured control flow) and 3.52.
///   Thread  any; a pure function.
///   Limits  conditions of 32-bit integers and booleans; selections, not loops and switches. A module that is not valid
///           may become another one that is not valid, of whole instructions (fuzzed: tests/fuzz/ShaderWordsFuzz.cpp).
///   Cost    three walks over the words: 0.5 ms for 220 KB.
#pragma once

#include "backend/api/Descriptions.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::backend::vulkan {

std::vector<uint32_t> foldConstants(std::vector<uint32_t> words, std::span<const ConstantValue> constants);

} // namespace filament_core::backend::vulkan
