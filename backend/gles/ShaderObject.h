// SPDX-License-Identifier: Apache-2.0
/// Compiling and linking ESSL.
///   Thread  the driver thread.
///   Fails   reported as ShaderCompile with the program's name and the first line of the driver's log.
#pragma once

#include "backend/gles/Device.h"

#include <array>
#include <span>
#include <string_view>

namespace filament_core::backend::gles {

/// The text of one stage in pieces, for glShaderSource.
struct StageText {
    GLenum stage = GL_VERTEX_SHADER;
    std::array<std::string_view, 3> pieces{};
};

/// The linked program, or 0 (reported under `name`). Device::programs, if present, provides it or stores it.
GLuint linkProgram(Device& device, std::span<const StageText> stages, std::string_view name);

} // namespace filament_core::backend::gles
