// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/Animation.h"

#include "filament_core/assets/gltf/NodePose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::assets {
namespace {

using testing::ElementsAre;

std::vector<double> at(AnimationSampler const& sampler, double seconds) {
    std::vector<double> value(sampler.width);
    sampleAnimation(sampler, seconds, value);
    return value;
}

AnimationSampler sampler(Interpolation interpolation, uint32_t width, std::vector<float> times,
                         std::vector<float> values) {
    return { .interpolation = interpolation, .width = width, .times = std::move(times), .values = std::move(values) };
}

// At a key the result is its value, to the bit, whatever lies between the keys.
TEST(Animation, IsExactlyTheKeyAtAKey) {
    const std::vector<float> times{ 0.1f, 0.3f, 0.7f, 1.9f };
    const std::vector<float> values{ 0.1f, -3e-20f, 7e11f, 1 / 3.0f };
    std::vector<float> cubic;
    for (const float value : values) cubic.insert(cubic.end(), { 5e7f, value, -9e7f });
    for (const Interpolation kind : { Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline }) {
        const auto keys = sampler(kind, 1, times, kind == Interpolation::CubicSpline ? cubic : values);
        for (size_t i = 0; i < times.size(); ++i) {
            EXPECT_EQ(at(keys, static_cast<double>(times[i]))[0], static_cast<double>(values[i])) << i;
        }
    }
    AnimationSampler rotations = sampler(Interpolation::Linear, 4, { 0, 1 }, { 0, 0.6f, 0, 0.8f, 0.8f, 0, 0, 0.6f });
    rotations.isRotation = true;
    EXPECT_THAT(at(rotations, 0), ElementsAre(0, double(0.6f), 0, double(0.8f)));
    EXPECT_THAT(at(rotations, 1), ElementsAre(double(0.8f), 0, 0, double(0.6f)));
}

TEST(Animation, HoldsTheFirstAndTheLastKeyOutside) {
    for (const Interpolation kind : { Interpolation::Step, Interpolation::Linear }) {
        const auto keys = sampler(kind, 1, { 1, 2 }, { 10, 20 });
        EXPECT_EQ(at(keys, -1e300)[0], 10);
        EXPECT_EQ(at(keys, 0.999)[0], 10);
        EXPECT_EQ(at(keys, 2.001)[0], 20);
        EXPECT_EQ(at(keys, std::numeric_limits<double>::infinity())[0], 20);
        EXPECT_EQ(at(keys, std::nan(""))[0], 10) << "counts as 0";
    }
    EXPECT_EQ(at(sampler(Interpolation::Linear, 1, { 5 }, { 3 }), 7)[0], 3) << "one key is a constant";
}

TEST(Animation, StepsHoldUntilTheNextKeyAndLinesDoNot) {
    EXPECT_EQ(at(sampler(Interpolation::Step, 1, { 0, 1 }, { 4, 8 }), 0.999)[0], 4);
    EXPECT_EQ(at(sampler(Interpolation::Linear, 2, { 0, 2 }, { 4, 0, 8, -2 }), 0.5), (std::vector<double>{ 5, -0.5 }));
}

// The Hermite polynomials reproduce every cubic that has the given values and derivatives.
TEST(Animation, SplinesThroughACubicAreThatCubic) {
    const auto p = [](double t) { return 2 * t * t * t - 3 * t * t + 0.5 * t - 1; };
    const auto derivative = [](double t) { return 6 * t * t - 6 * t + 0.5; };
    std::vector<float> times{ 0, 0.5f, 2 }, values;
    for (const float t : times) {
        const auto slope = static_cast<float>(derivative(static_cast<double>(t)));
        values.insert(values.end(), { slope, static_cast<float>(p(static_cast<double>(t))), slope });
    }
    const auto keys = sampler(Interpolation::CubicSpline, 1, times, values);
    for (double t = 0; t <= 2; t += 0.0625) EXPECT_NEAR(at(keys, t)[0], p(t), 1e-6) << t;
}

// A rotation by 90 degrees about z: at every moment a proportional angle, on the unit sphere.
TEST(Animation, RotationsTurnAtConstantSpeedAlongTheShorterArc) {
    const auto half = static_cast<float>(std::numbers::sqrt2 / 2);
    for (const float sign : { 1.0f, -1.0f }) { // -q is the same rotation
        AnimationSampler keys =
                sampler(Interpolation::Linear, 4, { 0, 1 }, { 0, 0, 0, 1, 0, 0, sign * half, sign * half });
        keys.isRotation = true;
        for (double t = 0; t <= 0.99; t += 0.09) {
            const std::vector<double> q = at(keys, t);
            EXPECT_NEAR(q[2], std::sin(t * std::numbers::pi / 4), 1e-7) << t;
            EXPECT_NEAR(q[3], std::cos(t * std::numbers::pi / 4), 1e-7) << t;
        }
    }
}

TEST(Animation, CubicRotationsAreUnit) {
    AnimationSampler keys = sampler(Interpolation::CubicSpline, 4, { 0, 1 },
                                    { 0, 0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 4, 4, 3, 2, 1, 0, 0, 1, 0, 0, 0, 0, 0 });
    keys.isRotation = true;
    for (const double t : { 0.1, 0.5, 0.9 }) {
        const std::vector<double> q = at(keys, t);
        EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
    }
}

TEST(NodePose, ComesBackOutOfItsMatrix) {
    const NodePose pose{ { 1, -2, 3e6 }, { 0.5, -0.5, 0.1, 0.7 }, { -2, 0.5, 3 } };
    const double4x4 matrix = matrixFrom(pose), again = matrixFrom(poseFrom(matrix));
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) EXPECT_NEAR(matrix[column][row], again[column][row], 1e-9);
    }
    const NodePose flat = poseFrom(matrixFrom({ { 0, 0, 0 }, { 0, 0, 0, 1 }, { 1, 0, 1 } }));
    EXPECT_EQ(flat.scale, double3(1, 0, 1)) << "no direction survives a zero scale; nothing is NaN";
    EXPECT_EQ(flat.rotation, double4(0, 0, 0, 1));
}

TEST(NodePose, SlerpOfNearlyEqualAndOfOppositeRotationsIsFinite) {
    const double4 a(0, 0, 0, 1);
    for (const double4 b : { a, -a, double4(0, 0, 1e-9, 1), double4(1, 0, 0, 0) }) {
        const double4 q = slerp(a, b, 0.3);
        EXPECT_NEAR(glm::dot(q, q), 1, 1e-9);
    }
}

} // namespace
} // namespace filament_core::assets
