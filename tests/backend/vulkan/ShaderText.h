// SPDX-License-Identifier: Apache-2.0
/// GLSL text to SPIR-V words, for the tests of this folder only (the engine's compiler is another room).
#pragma once

#include "backend/api/Descriptions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::backend::vulkan {

/// Words of a module for Vulkan 1.1; fails the current test with glslang's log if the text does not compile.
std::vector<uint32_t> spirvFromGlsl(ShaderStage stage, std::string const& text);

} // namespace filament_core::backend::vulkan
