// SPDX-License-Identifier: Apache-2.0
/// SPIR-V -> ESSL 3.10 through SPIRV-Cross, bindings numbered by backend::flatBinding.
///   Thread  any. Fails: Unsupported with SPIRV-Cross's reason.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Result.h"

#include <cstdint>
#include <span>
#include <string>

namespace filament_core::shader {

Result<std::string> esslFromSpirv(std::span<const uint32_t> spirv, backend::ProgramLayout const& layout);

} // namespace filament_core::shader
