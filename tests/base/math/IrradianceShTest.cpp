// SPDX-License-Identifier: Apache-2.0
// Coefficients of irradiance that turn with a box.
#include "base/math/IrradianceSh.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include <random>

namespace filament_core {
namespace {

using Coefficients = std::array<float4, 9>;

double valueOf(Coefficients const& sh, double3 n, int channel) {
    const std::array<double, 9> basis{
        1, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3 * n.z * n.z - 1, n.z * n.x, n.x * n.x - n.y * n.y
    };
    double sum = 0;
    for (size_t i = 0; i < sh.size(); ++i) sum += static_cast<double>(sh[i][channel]) * basis[i];
    return sum;
}

TEST(IrradianceSh, ATurnedNormalHasTheSameValue) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-1, 1);
    const auto unit = [&] { return glm::normalize(double3(number(random), number(random), number(random)) + 1e-3); };
    for (int round = 0; round < 1000; ++round) {
        Coefficients sh;
        for (float4& c : sh) c = float4(number(random), number(random), number(random), number(random));
        const double3x3 turn(glm::rotate(double4x4(1), 3.0 * static_cast<double>(number(random)), unit()));
        const Coefficients turned = rotateIrradianceSh(sh, float3x3(turn));
        const double3 n = unit();
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(valueOf(turned, double3x3(float3x3(turn)) * n, channel), valueOf(sh, n, channel), 2e-6);
        for (size_t i = 0; i < sh.size(); ++i) ASSERT_EQ(turned[i].w, sh[i].w);
    }
}

TEST(IrradianceSh, WithoutATurnNoBitChanges) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> number(-3, 3);
    Coefficients sh;
    for (float4& c : sh) c = float4(number(random), number(random), number(random), number(random));
    const Coefficients turned = rotateIrradianceSh(sh, float3x3(1));
    for (size_t i = 0; i < sh.size(); ++i) EXPECT_EQ(turned[i], sh[i]) << i;
}

} // namespace
} // namespace filament_core
