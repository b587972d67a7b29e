// SPDX-License-Identifier: Apache-2.0
/// Maps directions of the world to a cube map and to an equirectangular panorama.
///   Cube    faces +x -x +y -y +z -z with the s and t of the table that OpenGL ES and Vulkan share (ES 3.2 table 8.25,
///           Vulkan 1.3 table "Cube map face and coordinate selection"); row 0 of a face is t = -1.
///   Picture direction d is seen at u = 0.5 - atan2(d.x, d.z) / 2pi, v = acos(d.y) / pi; row 0 is the zenith.
///   Thread  pure functions.
#pragma once

#include "base/math/Elementary.h"
#include "base/math/Math.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {

/// s and t in [-1, 1] inside the face.
struct CubePoint {
    uint32_t face = 0;
    float s = 0, t = 0;
};

/// Not normalised: the point on the cube [-1, 1]^3.
inline float3 directionFromCube(CubePoint point) {
    const float s = point.s, t = point.t;
    switch (point.face) {
    case 0:
        return { 1, -t, -s };
    case 1:
        return { -1, -t, s };
    case 2:
        return { s, 1, t };
    case 3:
        return { s, -1, -t };
    case 4:
        return { s, -t, 1 };
    default:
        return { -s, -t, -1 };
    }
}

/// direction != 0, any length. Ties go to x before y before z.
inline CubePoint cubeFromDirection(float3 d) {
    const float ax = std::fabs(d.x), ay = std::fabs(d.y), az = std::fabs(d.z);
    if (ax >= ay && ax >= az) {
        const float inverse = 1.0f / ax;
        return d.x > 0 ? CubePoint{ 0, -d.z * inverse, -d.y * inverse } : CubePoint{ 1, d.z * inverse, -d.y * inverse };
    }
    if (ay >= az) {
        const float inverse = 1.0f / ay;
        return d.y > 0 ? CubePoint{ 2, d.x * inverse, d.z * inverse } : CubePoint{ 3, d.x * inverse, -d.z * inverse };
    }
    const float inverse = 1.0f / az;
    return d.z > 0 ? CubePoint{ 4, d.x * inverse, -d.y * inverse } : CubePoint{ 5, -d.x * inverse, -d.y * inverse };
}

/// Centre of texel (x, y) of a face of `size` texels, in [-1, 1].
inline float faceCoordinate(int texel, uint32_t size) {
    return (2.0f * static_cast<float>(texel) + 1.0f) / static_cast<float>(size) - 1.0f;
}

/// Solid angle of the part of a face from (0, 0) to (s, t); differences of four values give any rectangle. From the
/// integral of (1 + s^2 + t^2)^(-3/2).
inline double cornerSolidAngle(double s, double t) { return elementary::atan2(s * t, std::sqrt(s * s + t * t + 1.0)); }

/// u in [0, 1], v in [0, 1]. direction is a unit vector.
inline float2 equirectFromDirection(float3 d) {
    return { 0.5f - elementary::atan2(d.x, d.z) / (2.0f * kPi), elementary::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi };
}

inline float3 directionFromEquirect(float2 uv) {
    const float azimuth = (0.5f - uv.x) * 2.0f * kPi, polar = uv.y * kPi;
    return { elementary::sin(azimuth) * elementary::sin(polar), elementary::cos(polar),
             elementary::cos(azimuth) * elementary::sin(polar) };
}

} // namespace filament_core::assets
