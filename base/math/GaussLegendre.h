// SPDX-License-Identifier: Apache-2.0
/// Gauss-Legendre quadrature: the sum of weight * f(x) over the nodes approximates the integral of f over [0, 1], and
/// is exact for polynomials up to degree 2 count - 1.
///   Thread  any. Cost: 8 count^2 steps, so compute the nodes once.
#pragma once

#include <vector>

namespace filament_core {

struct QuadratureNode {
    double x = 0; // in (0, 1)
    double weight = 0;
};

/// count > 0. Ordered from the node nearest to 1 downwards.
std::vector<QuadratureNode> gaussLegendre(int count);

} // namespace filament_core
