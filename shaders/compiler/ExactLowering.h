// SPDX-License-Identifier: Apache-2.0
/// lowerExactly: writes out, in one fixed order, every operation that drivers may expand in different ways.
///   Why     Mesa uses different front ends for SPIR-V and GLSL, which expand some operations differently; the last bit
///           of a dot product then depends on the API. After this pass both see additions and multiplications.
///   What    dot, matrix products, outer product, determinant, inverse, normalize, length, distance, reflect, refract,
///           cross, faceforward, mix, clamp, step, smoothstep, fma, mod, tan, asin, acos, atan, radians, degrees, the
///           hyperbolic functions and their inverses, division by a constant (multiplication by its rounded
///           reciprocal), quotients and remainders of integers, and pow with a small whole exponent, which becomes
///           products. Conversions to integers are clamped to their range, and bit casts of NaN give one pattern
///           (docs/materials-undefined.md). Functions of functions, such as log(exp2(x)), are separated by a sum, so
///           that no driver folds them. Minima, maxima, arcs and mod of values that follow from constants choose what
///           they give for NaN and 0 themselves, because drivers compute constants by other rules than variables.
///           Negative coordinates of look-ups in flat textures lose the bits that one of two ways to repeat a texture
///           rounds away.
///   In      valid SPIR-V; run it after the optimiser, which would restore some of the operations.
///   Limits  32-bit floats; modf, frexp and ldexp are not changed.
///   Thread  any. Fails: never for a valid module. Cost: one pass over the words.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::shader {

std::vector<uint32_t> lowerExactly(std::span<const uint32_t> spirv);

} // namespace filament_core::shader
