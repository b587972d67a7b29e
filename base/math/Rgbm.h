// SPDX-License-Identifier: Apache-2.0
/// RGBM: radiance in four bytes, for devices without half-float or shared-exponent textures. Stores the square root of
/// radiance as a colour and a common factor. radianceFromRgbm() of shaders/lib/ibl.glsl decodes it, also after
/// filtering; there the format is weakest: neighbours with different factors mix too dark or too bright.
///   Finite values above the maximum are clamped to it, all components by the same factor; NaN and negative values
///   become 0.
///   Thread  pure functions. Memory: none. Fails: never.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament_core {

inline constexpr float kRgbmRange = 16.0f;                 ///< as in shaders/lib/ibl.glsl
inline constexpr float kMaxRgbm = kRgbmRange * kRgbmRange; ///< per component

/// R in bits 0..7, G, B, the factor in 24..31: RGBA8 in memory.
uint32_t packRgbm(float3 radiance);
float3 unpackRgbm(uint32_t bits);

} // namespace filament_core
