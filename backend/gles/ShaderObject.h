// SPDX-License-Identifier: Apache-2.0
/// Compiling and linking ESSL.
///   Thread  the driver thread.
///   Fails   reported as ShaderCompile with the program's name and the first line of the driver's log.
#pragma once

#include "backend/gles/Device.h"

#include <initializer_list>

namespace filament::backend::gles {

/// Text in pieces, as glShaderSource takes it.
using ShaderText = std::initializer_list<std::string_view>;

/// The linked program, or 0 (reported under `name`). With Device::programs: from there, if it is there, or kept there.
GLuint linkProgram(Device& device, ShaderText vertex, ShaderText fragment, std::string_view name);

} // namespace filament::backend::gles
