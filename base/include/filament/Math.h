// SPDX-License-Identifier: Apache-2.0
/// The vector and matrix types of the public API: GLM's types under the names of the shading language.
///   Matrices are column-major and multiply column vectors; they are named `resultFromSource`.
///   Space is right-handed, +Y up, in metres; angles are in radians unless the name says degrees.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace filament {

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

} // namespace filament
