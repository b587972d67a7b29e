// SPDX-License-Identifier: Apache-2.0
/// RGBM: radiance in four bytes, for devices without half-float or shared-exponent textures. Colour and a common factor
/// of the square root of radiance; decoded by radianceFromRgbm() of shaders/lib/ibl.glsl, also after filtering, which
/// is where the format is at its worst: neighbours with other factors mix too dark or too bright.
///   Finite values above the maximum are clamped to it, of all components by the same factor; NaN and negative values
///   become 0.
///   Thread  pure functions. Memory: none. Fails: never.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament {

inline constexpr float kRgbmRange = 16.0f;                 ///< as in shaders/lib/ibl.glsl
inline constexpr float kMaxRgbm = kRgbmRange * kRgbmRange; ///< of a component

/// R in bits 0..7, G, B, the factor in 24..31: RGBA8 in memory.
uint32_t packRgbm(float3 radiance);
float3 unpackRgbm(uint32_t bits);

} // namespace filament
