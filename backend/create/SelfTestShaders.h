// SPDX-License-Identifier: Apache-2.0
/// The shaders of the self-test (backend/create/self_test), embedded by the build.
#pragma once

#include "backend/api/Driver.h"

#include <string_view>

namespace filament_core::backend {

/// The shader of that file as SPIR-V or as text, without copying; empty if there is none of that name.
std::span<const std::byte> selfTestShader(std::string_view file, ShaderLanguage language);

} // namespace filament_core::backend
