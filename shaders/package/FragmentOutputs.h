// SPDX-License-Identifier: Apache-2.0
/// FragmentOutputs: what a fragment stage writes.
///   In      valid SPIR-V. Of anything else: some answer.
///   Memory  allocates nothing.   Cost: its declarations are read, not its functions.
#pragma once

#include <cstdint>
#include <span>

namespace filament_core::shader {

struct FragmentOutputs {
    uint32_t colors = 0; ///< bit n: the colour of attachment n
    bool depth = false;
};

FragmentOutputs fragmentOutputs(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
