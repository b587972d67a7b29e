// SPDX-License-Identifier: Apache-2.0
/// GlslCpp: what the text from scripts/glsl_to_cpp.py needs: types and built-in functions of GLSL in double precision,
/// and textures as functions.
///   Thread  one: the text has global variables, like a fragment.
///   Not     derivatives (they are 0: a flat surface), images, 32-bit integers beyond what the texts use.
#pragma once

#include "shaders/lib/GlslBuiltIns.h"

#include <filament_core/Math.h>

#include <glm/matrix.hpp>

namespace filament_core::shader::composition {

using uint = unsigned;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using mat3 = glm::dmat3;
using mat4 = glm::dmat4;
using bvec2 = glm::bvec2;
using bvec3 = glm::bvec3;
using bvec4 = glm::bvec4;
using ivec2 = glm::ivec2;
using ivec3 = glm::ivec3;
using ivec4 = glm::ivec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;

using namespace glsl; // what shaders/lib calls, and:
using elementary::tan;
using glm::abs;
using glm::ceil;
using glm::floor;
using glm::inversesqrt;
using glm::length;
using glm::mod;
using glm::normalize;
using glm::reflect;
using glm::refract;
using glm::sign;
using glm::smoothstep;
using glm::step;
using glm::transpose;

template <class T>
T dFdx(T const& x) {
    return x * 0.0;
}
template <class T>
T dFdy(T const& x) {
    return x * 0.0;
}

template <int... Lanes, class V>
auto swizzle(V const& v) {
    return glm::vec<sizeof...(Lanes), double>(v[Lanes]...);
}

/// Components of a vector that are assigned to.
template <class V, int... Lanes>
struct LanesOf {
    using Value = glm::vec<sizeof...(Lanes), double>;
    V& v;
    operator Value() const { return Value(v[Lanes]...); }
    void operator=(Value const& value) const {
        int i = 0;
        ((v[Lanes] = value[i++]), ...);
    }
    template <class T>
    void operator+=(T const& value) const {
        *this = Value(*this) + value;
    }
    template <class T>
    void operator-=(T const& value) const {
        *this = Value(*this) - value;
    }
    template <class T>
    void operator*=(T const& value) const {
        *this = Value(*this) * value;
    }
    template <class T>
    void operator/=(T const& value) const {
        *this = Value(*this) / value;
    }
};

template <int... Lanes, class V>
LanesOf<V, Lanes...> lanesOf(V& v) {
    return { v };
}

/// Only the split-sum table is looked up; all other textures are white: a white furnace.
struct samplerCube {};
struct samplerCubeArray {};
struct sampler2D {
    vec4 (*texel)(vec2 uv) = nullptr; ///< null: white
};

inline vec4 textureLod(samplerCube, vec3, double) { return vec4(1.0); }
inline vec4 textureLod(samplerCubeArray, vec4, double) { return vec4(1.0); }
inline vec4 texture(samplerCube, vec3) { return vec4(1.0); }
inline vec4 textureLod(sampler2D const& map, vec2 uv, double) { return map.texel ? map.texel(uv) : vec4(1.0); }
inline vec4 texture(sampler2D const& map, vec2 uv) { return textureLod(map, uv, 0.0); }
inline vec2 unpackHalf2x16(uint32_t) { return vec2(0.0); } // no fog is lit here
inline vec4 texelFetch(sampler2D const&, ivec2, int) { return vec4(1.0); }

inline vec4 gl_FragCoord{ 0.5f, 0.5f, 0.5f, 1.0f };
inline bool gl_FrontFacing = true;

} // namespace filament_core::shader::composition
