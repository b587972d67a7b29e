// SPDX-License-Identifier: Apache-2.0
/// TangentFrame: normal, tangent and handedness as one unit quaternion in four signed 16-bit integers.
///   Decoded   by tangentFrame() of shaders/lib/tangent.glsl.
///   Encoding  q rotates +x to the tangent and +z to the normal; +y goes to cross(normal, tangent). q and -q are the
///             same rotation, so the sign of w is free to encode whether the bitangent is +cross or -cross. w is kept
///             away from 0, where an integer has no sign, by one step of 1/32767, which turns the frame by 0.0035
///             degrees. The 8-bit form is the same with steps of 1/127, or 0.9 degrees.
///   In        any vectors: those that are not unit, not perpendicular, zero or not finite are repaired (Gram-Schmidt).
///   Thread    any. Cost: a square root and a division.
#pragma once

#include "base/math/Math.h"

#include <array>
#include <cstdint>

namespace filament_core::assets {

/// A unit vector perpendicular to the unit vector `normal`.
///   Duff et al. 2017, "Building an Orthonormal Basis, Revisited": continuous on either side of z = 0.
float3 anyTangent(float3 normal);

/// `vector` normalised, or `fallback` if its length is unusable.
float3 normalizedOr(float3 vector, float3 fallback);

/// The quaternion before rounding, with |w| at least `leastW`. `handedness` < 0 flips the bitangent.
float4 tangentFrameQuaternion(float3 normal, float3 tangent, float handedness, float leastW);

std::array<int16_t, 4> encodeTangentFrame(float3 normal, float3 tangent, float handedness);

} // namespace filament_core::assets
