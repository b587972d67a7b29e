// SPDX-License-Identifier: Apache-2.0
/// Compiling and linking ESSL.
///   Thread  the driver thread.
///   Fails   reported as ShaderCompile with the program's name and the first line of the driver's log.
#pragma once

#include "backend/gles/Device.h"

#include <initializer_list>

namespace filament::backend::gles {

/// Text in pieces, for glShaderSource.
using ShaderText = std::initializer_list<std::string_view>;

/// The linked program, or 0 (reported under `name`). Device::programs, if present, provides it or stores it.
GLuint linkProgram(Device& device, ShaderText vertex, ShaderText fragment, std::string_view name);

} // namespace filament::backend::gles
