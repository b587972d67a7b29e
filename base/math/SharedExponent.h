// SPDX-License-Identifier: Apache-2.0
/// The 32-bit format RGB9E5: three unsigned mantissas of 9 bits with a common exponent of 5 bits.
///   Finite values above the maximum are clamped to it; NaN and negative values become 0.
///   Source  OpenGL 4.6, section 8.5.2; Vulkan E5B9G9R9_UFLOAT_PACK32. Rounded to nearest, halves up, as specified.
///   Thread  pure functions. Memory: none. Fails: never.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament_core {

inline constexpr float kMaxRgb9E5 = 65408.0f; ///< (2^9 - 1) / 2^9 * 2^(31 - 15)

/// R in bits 0..8, G in 9..17, B in 18..26, the exponent in 27..31.
uint32_t packRgb9E5(float3 value);
float3 unpackRgb9E5(uint32_t bits);

} // namespace filament_core
