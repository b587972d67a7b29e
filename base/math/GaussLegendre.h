// SPDX-License-Identifier: Apache-2.0
/// Gauss-Legendre quadrature: the integral of f over [0, 1] is about the sum of weight * f(x) over the nodes, and is
/// that for polynomials of degree 2 count - 1.
///   Thread  any. Cost: 8 count^2 steps: make the nodes once.
#pragma once

#include <vector>

namespace filament {

struct QuadratureNode {
    double x = 0; // in (0, 1)
    double weight = 0;
};

/// count > 0. From the node nearest to 1 down.
std::vector<QuadratureNode> gaussLegendre(int count);

} // namespace filament
