// SPDX-License-Identifier: Apache-2.0
/// RGBD: radiance in four bytes, as EXT_lights_image_based stores it in images: a colour and the number that it is to
/// be divided by. unpackRgbd() is the nearest float to colour / divisor, exact for a divisor of 255 as for one of 1.
///   Packing: finite values above the maximum are clamped to it, all components by the same factor; NaN and negative
///   values become 0. The divisor is the largest that fits, so that the brightest component keeps 7 bits or more.
///   Thread  pure functions. Memory: none. Fails: never.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament_core {

inline constexpr float kMaxRgbd = 255.0f; ///< per component

/// R in bits 0..7, G, B, the divisor in 24..31: RGBA8 in memory.
uint32_t packRgbd(float3 radiance);
/// Black for the divisor 0, which no radiance has.
float3 unpackRgbd(uint32_t bits);

} // namespace filament_core
