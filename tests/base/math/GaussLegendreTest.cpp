// SPDX-License-Identifier: Apache-2.0
#include "base/math/GaussLegendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core {
namespace {

double integralOfPower(int count, int power) {
    double sum = 0;
    for (QuadratureNode const& node : gaussLegendre(count)) sum += node.weight * std::pow(node.x, power);
    return sum;
}

TEST(GaussLegendre, IsExactForPolynomialsOfTwiceItsNodesLessOneAndForNoMore) {
    for (const int count : { 1, 2, 5, 8, 16 }) {
        for (int power = 0; power < 2 * count; ++power)
            EXPECT_NEAR(integralOfPower(count, power), 1.0 / (power + 1), 1e-14) << count << ' ' << power;
    }
    for (const int count : { 1, 2, 5 })
        EXPECT_GT(std::abs(integralOfPower(count, 2 * count) - 1.0 / (2 * count + 1)), 1e-6) << count;
}

TEST(GaussLegendre, NodesAreInsideAndTheirOwnMirrorImage) {
    const std::vector<QuadratureNode> nodes = gaussLegendre(7);
    ASSERT_EQ(nodes.size(), 7u);
    for (size_t i = 0; i < 7; ++i) {
        EXPECT_GT(nodes[i].x, 0);
        EXPECT_LT(nodes[i].x, 1);
        EXPECT_NEAR(nodes[i].x + nodes[6 - i].x, 1, 1e-14);
        EXPECT_NEAR(nodes[i].weight, nodes[6 - i].weight, 1e-14);
    }
}

} // namespace
} // namespace filament_core
