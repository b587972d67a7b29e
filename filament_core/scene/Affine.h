// SPDX-License-Identifier: Apache-2.0
/// Affine: a transform without its last row, which is always (0 0 0 1): 96 bytes instead of 128, 36 products a
/// composition instead of 64. Four columns of three; double, because translations are metres in a world.
///   Bits    compose() adds in the order of a full matrix product, so it equals double4x4 * double4x4 to the bit.
///   Fails   never. What is not finite, or not affine, becomes zero: a point that draws nothing and stays one.
#pragma once

#include "filament_core/math/Math.h"

#include <glm/mat4x3.hpp>

namespace filament::scene {

using Affine = glm::dmat4x3;

inline bool isFinite(Affine const& a) {
    // x - x is 0 for finite x and NaN for the others
    const double3 zero = ((a[0] - a[0]) + (a[1] - a[1])) + ((a[2] - a[2]) + (a[3] - a[3]));
    return zero.x + zero.y + zero.z == 0;
}

inline Affine finiteOrZero(Affine const& a) { return isFinite(a) ? a : Affine(0.0); }

/// Zero for a matrix with another last row than (0 0 0 1).
inline Affine affineFrom(double4x4 const& m) {
    const bool isAffine = m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
    return isAffine ? finiteOrZero(Affine(m)) : Affine(0.0);
}

inline double4x4 matrixFrom(Affine const& a) {
    return { double4(a[0], 0), double4(a[1], 0), double4(a[2], 0), double4(a[3], 1) };
}

inline double3 transformVector(Affine const& a, double3 const& v) { return a[0] * v.x + a[1] * v.y + a[2] * v.z; }

inline double3 transformPoint(Affine const& a, double3 const& p) { return transformVector(a, p) + a[3]; }

/// First `b`, then `a`. Zero where the product of two finite transforms leaves the range of double.
inline Affine compose(Affine const& a, Affine const& b) {
    return finiteOrZero(
            { transformVector(a, b[0]), transformVector(a, b[1]), transformVector(a, b[2]), transformPoint(a, b[3]) });
}

/// Zero where there is none.
inline Affine inverse(Affine const& a) {
    const double3x3 linear = glm::inverse(double3x3(a[0], a[1], a[2]));
    return finiteOrZero({ linear[0], linear[1], linear[2], -(linear * a[3]) });
}

} // namespace filament::scene
