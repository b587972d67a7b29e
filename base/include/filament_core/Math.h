// SPDX-License-Identifier: Apache-2.0
/// The vector and matrix types of the public API: GLM's types under the names of the shading language.
///   Matrices are column-major and multiply column vectors; they are named `resultFromSource`.
///   Space is right-handed, +Y up, in metres; angles are in radians unless the name says degrees.
///   Layout  the library was compiled with packed vectors, GLM's default. A file whose GLM_FORCE_... macros give them
///           another size, alignment, type or way into functions is not compiled: it could not call the library.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace filament_core {

using float2 = glm::vec2;
using float3 = glm::vec3;
using float4 = glm::vec4;
using float3x3 = glm::mat3;
using float4x4 = glm::mat4;
using double2 = glm::dvec2;
using double3 = glm::dvec3;
using double4 = glm::dvec4;
using double3x3 = glm::dmat3;
using double4x4 = glm::dmat4;
using uint2 = glm::uvec2;
using uint3 = glm::uvec3;
using uint4 = glm::uvec4;
using int2 = glm::ivec2;
using int3 = glm::ivec3;
using int4 = glm::ivec4;
using bool2 = glm::bvec2;
using bool3 = glm::bvec3;
using bool4 = glm::bvec4;

namespace detail {

template <class V, class T>
constexpr bool isPlain(size_t count) {
    return sizeof(V) == count * sizeof(T) && alignof(V) == alignof(T) && std::is_trivially_copyable_v<V> &&
           std::is_same_v<typename V::length_type, int>;
}
template <glm::length_t kCount, class T, glm::qualifier kQualifier>
constexpr bool isAsInLibrary(glm::vec<kCount, T, kQualifier> const*) {
    return kQualifier == glm::packed_highp && isPlain<glm::vec<kCount, T, kQualifier>, T>(kCount);
}
template <glm::length_t kColumns, glm::length_t kRows, class T, glm::qualifier kQualifier>
constexpr bool isAsInLibrary(glm::mat<kColumns, kRows, T, kQualifier> const*) {
    return kQualifier == glm::packed_highp && isPlain<glm::mat<kColumns, kRows, T, kQualifier>, T>(kColumns * kRows);
}
template <class... Types>
constexpr bool areAsInLibrary() {
    return (isAsInLibrary(static_cast<Types const*>(nullptr)) && ...);
}

} // namespace detail

static_assert(
        detail::areAsInLibrary<float2, float3, float4, float3x3, float4x4, double2, double3, double4, double3x3,
                               double4x4, uint2, uint3, uint4, int2, int3, int4, bool2, bool3, bool4>(),
        "filament_core was compiled with GLM's default vectors, but a macro changes them in this file. Compile files "
        "that include <filament_core/...> without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES, GLM_FORCE_ALIGNED, "
        "GLM_FORCE_CTOR_INIT, GLM_FORCE_SIZE_T_LENGTH, GLM_FORCE_CXX98, GLM_FORCE_CXX03 and GLM_FORCE_CXX_UNKNOWN");

} // namespace filament_core
