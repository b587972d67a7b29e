// SPDX-License-Identifier: Apache-2.0
#include "base/math/GaussLegendre.h"

#include "base/math/Elementary.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace filament_core {

// Newton's iteration towards the roots of Legendre's polynomial. Press et al. 2007, "Numerical Recipes", section 4.6.1.
std::vector<QuadratureNode> gaussLegendre(int count) {
    std::vector<QuadratureNode> nodes;
    for (int i = 0; i < count; ++i) {
        double x = elementary::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 8; ++step) {
            double value = 1, before = 0;
            for (int n = 1; n <= count; ++n) {
                const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                before = std::exchange(value, next);
            }
            slope = count * (x * value - before) / (x * x - 1);
            x -= value / slope;
        }
        nodes.push_back({ (x + 1) / 2, 1 / ((1 - x * x) * slope * slope) });
    }
    return nodes;
}

} // namespace filament_core
