// SPDX-License-Identifier: Apache-2.0
/// lowerExactly: spells out, in one fixed order, every operation that a driver may expand in its own way.
///   Why     Mesa takes SPIR-V and GLSL through different front ends, which expand some operations differently; the
///           last bit of a dot product then depends on the API. After this pass both see additions and products.
///   What    dot, matrix products, outer product, determinant, inverse, normalize, length, distance, reflect, refract,
///           cross, faceforward, mix, smoothstep, fma, mod, tan, asin, acos, atan, radians, degrees, the hyperbolic
///           functions and their inverses, division by a constant (multiplication by its rounded reciprocal), and % of
///           signed integers.
///   In      valid SPIR-V; run it after the optimiser, which would re-form some of them.
///   Limits  32-bit floats; modf, frexp and ldexp stay as they are.
///   Thread  any. Fails: never for a valid module. Cost: one pass over the words.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament::shader {

std::vector<uint32_t> lowerExactly(std::span<const uint32_t> spirv);

} // namespace filament::shader
