// SPDX-License-Identifier: Apache-2.0
/// groupProgram: a fragment shader that evaluates several rows, one of them at each pixel.
///   In      texel i of the three inputs: s; u and, in w, the row's index in the group; v.
///   Out     RGBA32F: the components of the result, 0 behind them.
///   Half    what lit materials in half precision get: mediump text, of which the compiler makes 16-bit SPIR-V and
///           ESSL. Inputs and output stay 32-bit.
///   Cost    one program for several rows: a driver needs a third of a second for each program that it has not seen.
///   Thread  any. Fails: NotFound if the sources of shaders/lib are not where the build left them; what the compiler
///           says.
#pragma once

#include "shaders/compiler/CompileProgram.h"
#include "tools/numerics/table/Points.h"

namespace filament::shader::numerics {

/// `library`: what libraryText() returned, or a mutant of it.
Result<ProgramShaders> groupProgram(std::string const& library, std::span<Row const* const> rows, Format format);

/// The text of shaders/lib with math.glsl first, and the rows' own wrappers.
Result<std::string> libraryText();

} // namespace filament::shader::numerics
