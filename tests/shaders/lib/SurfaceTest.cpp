// SPDX-License-Identifier: Apache-2.0
// aa.glsl, ao.glsl and tangent.glsl: computations on a surface before and after lighting.
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {
namespace {

// Kaplanyan's filter adds at most `threshold` to alpha^2, and nothing if the normal is constant.
TEST(SpecularAntiAliasing, OnlyEverRoughens) {
    EXPECT_NEAR(filteredPerceptualRoughness(0.3f, vec3(0.0f), vec3(0.0f), 0.15f, 0.2f), 0.3f, 1e-6f);
    const float filtered = filteredPerceptualRoughness(0.1f, vec3(9, 0, 0), vec3(0, 9, 0), 0.15f, 0.2f);
    EXPECT_NEAR(filtered, std::pow(1e-4f + 0.2f, 0.25f), 1e-5f);
    for (const float edge : kEdges) {
        const float roughness = clampPerceptualRoughness(edge);
        for (const float derivative : { 0.0f, 1e-20f, 0.1f, 1e10f }) {
            const float result =
                    filteredPerceptualRoughness(roughness, vec3(derivative), vec3(derivative), 0.15f, 0.2f);
            EXPECT_GE(result, roughness * 0.999f);
            EXPECT_LE(result, 1.0f);
        }
    }
}

TEST(AmbientOcclusion, SpecularOcclusionLeavesTheUnoccludedAloneAndBlackensTheHidden) {
    for (const float nov : kEdges) {
        for (const float roughness : kEdges) {
            const float alpha = roughness * roughness;
            EXPECT_EQ(specularOcclusion(nov, 1.0f, alpha), 1.0f);
            EXPECT_NEAR(specularOcclusion(nov, 0.0f, alpha), 0.0f, 1e-6f);
            for (const float visibility : kEdges) {
                const float occlusion = specularOcclusion(nov, visibility, alpha);
                EXPECT_TRUE(occlusion >= 0 && occlusion <= 1);
            }
        }
    }
    EXPECT_NEAR(specularOcclusion(0.5f, 0.6f, 1.0f), 0.6f, 0.01f) << "a diffuse-like lobe sees the visibility itself";
}

TEST(AmbientOcclusion, BouncedOcclusionBrightensBrightSurfacesMoreThanDarkOnes) {
    for (const float visibility : kEdges) {
        const vec3 dark = multiBounceAo(visibility, vec3(0.05f)), bright = multiBounceAo(visibility, vec3(0.9f));
        EXPECT_GE(dark.x, visibility);
        EXPECT_GE(bright.x, dark.x);
        EXPECT_LE(bright.x, 1.01f);
    }
    EXPECT_NEAR(multiBounceAo(1.0f, vec3(0.5f)).y, 1.0f, 0.01f);
}

// Compares a frame from a quaternion with the rotation matrix of the same axis and angle.
TEST(TangentFrame, ATangentQuaternionIsTheRotationOfTheAxes) {
    const vec3 axis = glm::normalize(vec3(1, 2, 3));
    for (float angle = 0.1f; angle < 6.2f; angle += 0.3f) {
        const vec4 q(axis * std::sin(angle / 2), std::cos(angle / 2));
        const auto rotate = [&](vec3 v) { // Rodrigues
            return v * std::cos(angle) + cross(axis, v) * std::sin(angle) +
                   axis * (dot(axis, v) * (1 - std::cos(angle)));
        };
        vec3 n, t, b;
        tangentFrame(q, n, t, b);
        const float handedness = q.w < 0 ? -1.0f : 1.0f;
        EXPECT_LT(glm::distance(n, rotate(vec3(0, 0, 1))), 1e-5f);
        EXPECT_LT(glm::distance(t, rotate(vec3(1, 0, 0))), 1e-5f);
        EXPECT_LT(glm::distance(b, rotate(vec3(0, 1, 0)) * handedness), 1e-5f);
    }
}

TEST(TangentFrame, NegatingATangentQuaternionFlipsTheBitangentOnly) {
    const vec4 q = glm::normalize(vec4(0.1f, -0.5f, 0.3f, 0.7f));
    vec3 n0, t0, b0, n1, t1, b1;
    tangentFrame(q, n0, t0, b0);
    tangentFrame(-q, n1, t1, b1);
    EXPECT_EQ(n0, n1);
    EXPECT_EQ(t0, t1);
    EXPECT_EQ(b0, -b1);
}

} // namespace
} // namespace filament_core::shader::lib
