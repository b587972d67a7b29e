// SPDX-License-Identifier: Apache-2.0
/// compileDispatch: compiles a compute stage of the engine (shaders/compute) in both languages.
///   In      the text of a .comp file. It sees the interface of the engine's shaders, the quality constants and those
///           of variants (specialisation constants, 0 by default), and may include the engine's files.
///   Out     the code. Its bindings are numbered by shader::fogLightLayout(), the layout of the engine's dispatches.
///   Thread  any; pure: equal text gives equal bytes.
///   Fails   InvalidArgument or Unsupported with "file:line: reason".
#pragma once

#include "base/Result.h"
#include "shaders/package/Package.h"

#include <string_view>

namespace filament_core::shader {

Result<StageCode> compileDispatch(std::string_view text, std::string_view fileName);

} // namespace filament_core::shader
