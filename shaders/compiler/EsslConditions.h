// SPDX-License-Identifier: Apache-2.0
/// preprocessConditions: turns branches on specialisation constants into branches of the preprocessor.
///   Why     one ESSL text serves every set of lights and effects. A compiler drops what a program never runs only
///           after it has parsed and translated all of it; its preprocessor does so before, in a tenth of the time.
///   In      ESSL of SPIRV-Cross: a constant is the macro SPIRV_CROSS_CONSTANT_ID_N with a default, `const bool _42 =
///           (...)` follows from such, and the braces of a branch stand alone in their lines.
///   Out     the same program. `if (_42)` and its `else` become `#if` and `#else`; what follows from no constant, or by
///           operators that the preprocessor lacks, stays. Bool macros are comparisons, because a preprocessor of ESSL
///           knows neither true nor false (OpenGL ES Shading Language 3.10, section 3.4).
///   Thread  any; a pure function. Cost: one walk over the text.
#pragma once

#include <string>
#include <string_view>

namespace filament_core::shader {

std::string preprocessConditions(std::string_view essl);

} // namespace filament_core::shader
