// SPDX-License-Identifier: Apache-2.0
/// IEEE 754 binary16 and the packed unsigned floats of the graphics APIs, rounded to nearest even.
///   Finite values above the format's maximum are clamped to it, so that a sun does not become infinite. NaN becomes 0,
///   and negative values become 0 in the unsigned formats.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament_core {

inline constexpr float kMaxHalf = 65504.0f;
inline constexpr float kMaxFloat11 = 65024.0f; ///< 6 bits of mantissa
inline constexpr float kMaxFloat10 = 64512.0f; ///< 5 bits of mantissa

uint16_t halfFromFloat(float value);
float floatFromHalf(uint16_t bits);

/// R in bits 0..10, G in 11..21, B in 22..31 (OpenGL R11F_G11F_B10F, Vulkan B10G11R11_UFLOAT_PACK32).
uint32_t packR11G11B10F(float3 value);
float3 unpackR11G11B10F(uint32_t bits);

} // namespace filament_core
