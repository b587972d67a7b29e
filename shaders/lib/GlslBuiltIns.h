// SPDX-License-Identifier: Apache-2.0
/// The built-in GLSL functions that the shader library calls, for compiling it as C++, for float and for double. They
/// come from GLM, except those that the C++ library rounds in its own way (base/math/Elementary.h). `using namespace
/// glsl` makes them visible in a namespace that includes GLSL.
///   Rules   shaders/lib must not use built-ins that are missing here: the C++ code and the tests would not compile.
#pragma once

#include "base/math/Elementary.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace filament_core::shader::glsl {

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::fract;
using glm::inversesqrt;
using glm::max;
using glm::min;
using glm::mix;
using glm::smoothstep;
using glm::sqrt;

using elementary::acos;
using elementary::atan;
using elementary::cos;
using elementary::exp;
using elementary::exp2;
using elementary::log;
using elementary::log2;
using elementary::pow;
using elementary::sin;

/// GLSL's two-argument form.
template <std::floating_point T>
T atan(T y, T x) {
    return elementary::atan2(y, x);
}

// Component by component, as in GLSL.
template <class Function, glm::length_t L, class T, class... Vectors>
glm::vec<L, T> componentwise(Function function, glm::vec<L, T> const& first, Vectors const&... others) {
    glm::vec<L, T> result;
    for (glm::length_t i = 0; i < L; ++i) result[i] = function(first[i], others[i]...);
    return result;
}

template <glm::length_t L, class T>
glm::vec<L, T> exp(glm::vec<L, T> const& x) {
    return componentwise([](T each) { return elementary::exp(each); }, x);
}

template <glm::length_t L, class T>
glm::vec<L, T> pow(glm::vec<L, T> const& x, glm::vec<L, T> const& y) {
    return componentwise([](T each, T exponent) { return elementary::pow(each, exponent); }, x, y);
}

} // namespace filament_core::shader::glsl
