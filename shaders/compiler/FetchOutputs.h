// SPDX-License-Identifier: Apache-2.0
/// withFetchOutputs: declares a fragment output for every subpass input without an output at its attachment's location.
///   Why     OpenGL ES reads the pixel of colour attachment i through the output at location i, so ESSL needs that
///           output even if the shader only reads. The variable is never written, so the pixel keeps its value.
///   In      valid fragment SPIR-V; only for the ESSL: the Vulkan module does not get these outputs.
///   Thread  any. Fails: never for a valid module.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> withFetchOutputs(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
