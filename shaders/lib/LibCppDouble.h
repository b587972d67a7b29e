// SPDX-License-Identifier: Apache-2.0
/// The shader library in double precision, in namespace filament_core::shader::lib64: the formulas without significant
/// rounding. The reference renderer shades with it; the numerics tests compare fp32 and fp16 with it.
///   Source  the build copies shaders/lib/*.glsl with `float` as double and literals without f
///           (cmake/DoublePrecisionGlsl.cmake); every file, every function, rebuilt when one of them changes. Link
///           shader_lib64.
///   Differs from LibCpp.h only in its types: vec3 is glm::dvec3. Clamps that exist for fp32, such as kMinAlpha, stay:
///   they are part of the material model.
///   Memory  none. Thread: pure functions.
#pragma once

#include "shaders/lib/GlslBuiltIns.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace filament_core::shader::lib64 {

using glm::uint;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;

using namespace glsl;

// GLSL functions have no linkage: they are internal here, and not every file that includes them calls all of them.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace {

#include "generated/shaders/lib64/all.inl"

} // namespace
#pragma GCC diagnostic pop

#undef OUT

} // namespace filament_core::shader::lib64
