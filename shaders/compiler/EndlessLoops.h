// SPDX-License-Identifier: Apache-2.0
/// findEndlessLoop: a block of a module that is reached, but from which no path leaves the function.
///   Why     no device may run such a loop: Mesa's cut it off after some iterations, each API after another count.
///   In      valid SPIR-V of glslang. A branch on the constants true and false takes one way only; every other
///           condition may become true and false.
///   Out     where its head is, if the module has debug information; nothing if every loop has an exit.
///   Thread  any. Fails: never for a valid module. Cost: two walks over the blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace filament_core::shader {

struct EndlessLoop {
    std::string file; ///< empty without debug information
    uint32_t line = 0;
};

std::optional<EndlessLoop> findEndlessLoop(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
