// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/TangentFrame.h"
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace filament_core::assets::test {
namespace {

struct Frame {
    float3 normal, tangent, bitangent;
};

/// What the shader computes from the four integers.
Frame decoded(std::array<int16_t, 4> const& encoded) {
    float4 q;
    for (int i = 0; i < 4; ++i) q[i] = std::max(static_cast<float>(encoded[static_cast<size_t>(i)]) / 32767.0f, -1.0f);
    Frame frame;
    shader::lib::tangentFrame(q, frame.normal, frame.tangent, frame.bitangent);
    return frame;
}

float3 randomDirection(std::mt19937& random) {
    std::normal_distribution<float> gauss;
    return normalizedOr(float3(gauss(random), gauss(random), gauss(random)), float3(1, 0, 0));
}

void expectNear(float3 actual, float3 expected, float tolerance) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

constexpr float kTolerance = 2e-4f; // 16 bits: a step is 3e-5, and squares of four components add up

TEST(TangentFrame, TheShaderGetsBackWhatWasEncoded) {
    std::mt19937 random(1);
    for (int i = 0; i < 20'000; ++i) {
        const float3 normal = randomDirection(random), other = randomDirection(random);
        const float3 tangent = normalizedOr(other - normal * glm::dot(other, normal), anyTangent(normal));
        const float handedness = i % 2 == 0 ? 1.0f : -1.0f;
        const Frame frame = decoded(encodeTangentFrame(normal, tangent, handedness));
        expectNear(frame.normal, normal, kTolerance);
        expectNear(frame.tangent, tangent, kTolerance);
        expectNear(frame.bitangent, glm::cross(normal, tangent) * handedness, kTolerance);
    }
}

TEST(TangentFrame, HalfTurnsKeepTheirHandedness) {
    // rotations by 180 degrees have w = 0, where the sign would be lost
    for (const float3 normal :
         { float3(0, 0, -1), float3(1, 0, 0), float3(-1, 0, 0), float3(0, 1, 0), float3(0, -1, 0) }) {
        for (const float3 axis :
             { float3(1, 0, 0), float3(-1, 0, 0), float3(0, 1, 0), float3(0, -1, 0), float3(0, 0, 1) }) {
            if (std::abs(glm::dot(axis, normal)) > 0.5f) continue;
            for (const float handedness : { 1.0f, -1.0f }) {
                const auto encoded = encodeTangentFrame(normal, axis, handedness);
                EXPECT_NE(encoded[3], 0);
                const Frame frame = decoded(encoded);
                expectNear(frame.normal, normal, kTolerance);
                expectNear(frame.tangent, axis, kTolerance);
                expectNear(frame.bitangent, glm::cross(normal, axis) * handedness, kTolerance);
            }
        }
    }
}

TEST(TangentFrame, UnusableVectorsAreRepairedAndTheNormalStays) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    const float3 normal(0, 0.6f, 0.8f);
    for (const float3 tangent :
         { float3(0.0f), normal, -normal, float3(nan, 0, 0), float3(inf, 1, 0), float3(1e-38f), normal * 1e30f }) {
        const Frame frame = decoded(encodeTangentFrame(normal, tangent, 1));
        expectNear(frame.normal, normal, kTolerance);
        EXPECT_NEAR(glm::dot(frame.normal, frame.tangent), 0, kTolerance);
        EXPECT_NEAR(glm::length(frame.tangent), 1, kTolerance);
    }
    expectNear(decoded(encodeTangentFrame(float3(nan), float3(1, 0, 0), 1)).normal, float3(0, 0, 1), kTolerance);
    expectNear(decoded(encodeTangentFrame(float3(0, 1e-25f, 0), float3(1, 0, 0), 1)).normal, float3(0, 1, 0),
               kTolerance);
    expectNear(decoded(encodeTangentFrame(float3(0, 1e25f, 0), float3(1, 0, 0), 1)).normal, float3(0, 1, 0),
               kTolerance);
}

TEST(TangentFrame, AnyTangentIsPerpendicularAndUnit) {
    std::mt19937 random(2);
    for (int i = 0; i < 10'000; ++i) {
        const float3 normal = i == 0 ? float3(0, 0, -1) : i == 1 ? float3(0, 0, 1) : randomDirection(random);
        const float3 tangent = anyTangent(normal);
        EXPECT_NEAR(glm::dot(normal, tangent), 0, 1e-6f);
        EXPECT_NEAR(glm::length(tangent), 1, 1e-6f);
    }
}

} // namespace
} // namespace filament_core::assets::test
