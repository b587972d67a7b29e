// SPDX-License-Identifier: Apache-2.0
/// groupProgram: a fragment shader that evaluates several rows, one per pixel.
///   In      texel i of the three inputs: s; u, with the row's index in the group in w; v.
///   Out     RGBA32F: the components of the result, followed by 0.
///   Half    as for lit materials in half precision: mediump text, from which the compiler makes 16-bit SPIR-V and
///           ESSL. Inputs and output stay 32-bit.
///   Cost    several rows share a program because a driver needs a third of a second for each new program.
///   Thread  any. Fails: NotFound if the sources of shaders/lib are missing; errors of the compiler.
#pragma once

#include "shaders/compiler/CompileProgram.h"
#include "tools/numerics/table/Points.h"

namespace filament_core::shader::numerics {

/// `library`: the result of libraryText(), or a mutated form of it.
Result<ProgramShaders> groupProgram(std::string const& library, std::span<Row const* const> rows, Format format);

/// The text of shaders/lib with math.glsl first, and the rows' own wrappers.
Result<std::string> libraryText();

} // namespace filament_core::shader::numerics
