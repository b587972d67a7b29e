// SPDX-License-Identifier: Apache-2.0
/// The built-in GLSL functions that the shader library calls, for compiling it as C++. They come from GLM, for float
/// and for double. `using namespace glsl` makes them visible in a namespace that includes GLSL.
///   Rules   shaders/lib must not use built-ins that are missing here: the C++ code and the tests would not compile.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace filament::shader::glsl {

using glm::abs;
using glm::acos;
using glm::atan;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;

} // namespace filament::shader::glsl
