// SPDX-License-Identifier: Apache-2.0
/// The shader library in 16 bits, one prelude for each way there is.
///   SPIR-V  types and literals are rewritten to those of GL_EXT_shader_explicit_arithmetic_types_float16: a literal
///           with suffix f would lift everything that it touches to 32 bits.
///   ESSL    `precision mediump float;` in front of the text as it is. A device may still compute in 32 bits.
///   Macro   HALF_PRECISION is defined in both, for the constants that 16 bits round to 0 (brdf.glsl).
///   Thread  any. Fails: never; what is not GLSL comes out as it went in.
#pragma once

#include <string>
#include <string_view>

namespace filament::shader {

/// Goes behind #version, before what float16FromGlsl() returned.
inline constexpr std::string_view kFloat16Prelude =
        "#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require\n#define HALF_PRECISION 1\n";
inline constexpr std::string_view kMediumpPrelude = "precision mediump float;\n#define HALF_PRECISION 1\n";

/// float -> float16_t, vec3 -> f16vec3, mat4 -> f16mat4, 0.1f -> 0.0999755859375hf, the nearest number of 16 bits.
/// Comments are rewritten like everything else.
std::string float16FromGlsl(std::string_view glsl);

} // namespace filament::shader
