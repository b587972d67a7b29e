// SPDX-License-Identifier: Apache-2.0
/// Irradiance as nine polynomial coefficients (irradianceSh() of shaders/lib/ibl.glsl): 1; y, z, x; x y, y z,
/// 3 z^2 - 1, z x, x^2 - y^2.
///   Thread  pure functions.   Memory: none.   Fails: never.
#pragma once

#include "base/math/Math.h"

#include <array>

namespace filament_core {

/// Coefficients whose value for worldFromLocal n is that of the given ones for n. Irradiance is a quadratic form of the
/// normal (Ramamoorthi and Hanrahan 2001, section 3.2), c + b.n + n.Q n, and turns as one: b to R b, Q, which has no
/// trace, to R Q R^T. Vector: float3, or float4, whose w is kept. worldFromLocal: three unit vectors at right angles.
template <class Vector>
std::array<Vector, 9> rotateIrradianceSh(std::array<Vector, 9> const& sh, float3x3 const& worldFromLocal) {
    std::array<Vector, 9> turned = sh;
    const double3x3 turn(worldFromLocal);
    for (int channel = 0; channel < 3; ++channel) {
        const auto of = [&](size_t i) { return static_cast<double>(sh[i][channel]); };
        const double3 linear = turn * double3(of(3), of(1), of(2));
        const double3x3 form{ of(8) - of(6), of(4) / 2, of(7) / 2, of(4) / 2, -of(8) - of(6),
                              of(5) / 2,     of(7) / 2, of(5) / 2, 2 * of(6) };
        const double3x3 q = turn * form * glm::transpose(turn);
        const std::array values{ linear.y,      linear.z,      linear.x,      2.0 * q[0][1],
                                 2.0 * q[1][2], q[2][2] / 2.0, 2.0 * q[2][0], (q[0][0] - q[1][1]) / 2.0 };
        for (size_t i = 0; i < values.size(); ++i) turned[i + 1][channel] = static_cast<float>(values[i]);
    }
    return turned;
}

} // namespace filament_core
