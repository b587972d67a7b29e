// SPDX-License-Identifier: Apache-2.0
// occlusion.glsl and normals.glsl: cones compared with counted solid angles, blended normals with rotations.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

TEST(Cones, TheVisibleConeIntegratesToItsVisibility) {
    for (const double visibility : { 0.0, 0.1, 0.5, 0.9, 1.0 }) {
        const double cosine = 1 - visibilityConeVersine(visibility);
        EXPECT_NEAR(1 - cosine * cosine, visibility, 1e-12) << "the integral of cos / pi over the cone is sin^2";
        EXPECT_NEAR(std::cos(coneAngle(visibilityConeVersine(visibility))), cosine, 1e-12);
    }
}

TEST(Cones, TheSpecularConeRunsFromAMirrorToATenth) {
    EXPECT_EQ(specularConeVersine(0.0), 0);
    EXPECT_NEAR(specularConeVersine(1.0), 0.9, 1e-7);
    EXPECT_NEAR(specularConeVersine(0.5), 1 - std::pow(10, -0.25), 1e-7);
}

// Counted on a grid of directions. The smooth step has a known error in between: 0.055 of the hemisphere.
TEST(Cones, TheIntersectionIsTheSolidAngleInBoth) {
    for (const double a : { 0.1, 0.5 }) {
        for (const double b : { 0.2, 0.6 }) {
            for (double between = 0; between < 3; between += 0.1) {
                const vec3 axis(std::sin(between), 0, std::cos(between));
                const double both =
                        integrateUpper([&](vec3 d) { return d.z > 1 - a && dot(d, axis) > 1 - b ? 1.0 : 0.0; }) /
                        (2 * kPiOfTests);
                EXPECT_NEAR(coneIntersection(a, b, std::cos(between)), both, 0.055) << a << ' ' << b << ' ' << between;
            }
        }
    }
}

TEST(Cones, IntersectionsAreSymmetricAndReachBothEnds) {
    EXPECT_EQ(coneIntersection(0.3, 0.1, 0.8), coneIntersection(0.1, 0.3, 0.8));
    EXPECT_NEAR(coneIntersection(0.3, 0.1, 1.0), 0.1, 1e-12);
    EXPECT_EQ(coneIntersection(0.3, 0.1, -1.0), 0);
}

TEST(SpecularOcclusion, ConesLeaveTheUnoccludedAloneAndBlackenTheHidden) {
    for (const double roughness : { 0.045, 0.3, 1.0 }) {
        EXPECT_EQ(specularOcclusionCones(1.0, 1.0, roughness), 1) << "along the bent normal";
        EXPECT_EQ(specularOcclusionCones(0.0, 0.5, roughness), 0);
    }
    EXPECT_EQ(specularOcclusionCones(0.2, 0.0, 0.1), 0) << "a narrow lobe away from the only hole";
    EXPECT_EQ(specularOcclusionCones(0.2, 1.0, 0.1), 1) << "and into it";
}

TEST(SpecularOcclusion, ReflectionsFadeAsTheySinkBelowTheSurface) {
    const vec3 n(0, 0, 1);
    EXPECT_EQ(horizonOcclusion(vec3(0.6, 0, 0.8), n), 1);
    EXPECT_EQ(horizonOcclusion(vec3(1, 0, 0), n), 1);
    EXPECT_NEAR(horizonOcclusion(vec3(0.8, 0, -0.6), n), 0.16, 1e-12);
    EXPECT_EQ(horizonOcclusion(vec3(0, 0, -1), n), 0);
}

TEST(Normals, ATexelIsAUnitVectorAndGreyIsTheSurfacesOwn) {
    EXPECT_EQ(normalFromTexel(vec3(0.5, 0.5, 1.0), 1.0), vec3(0, 0, 1));
    EXPECT_EQ(normalFromTexel(vec3(0.5), 1.0), vec3(0, 0, 1)) << "no normal at all";
    const vec3 steep = normalFromTexel(vec3(0.75, 0.5, 0.75), 2.0), plain = normalFromTexel(vec3(0.75, 0.5, 0.75), 1.0);
    EXPECT_NEAR(glm::length(steep), 1, 1e-12);
    EXPECT_NEAR(steep.x / steep.z, 2 * plain.x / plain.z, 1e-12) << "twice the slope";
    EXPECT_EQ(normalFromTexel(vec3(0.9, 0.2, 0.8), 0.0), vec3(0, 0, 1));
}

TEST(Normals, FlatMapsAreNeutral) {
    const vec3 n = glm::normalize(vec3(0.3, -0.5, 0.8)), up(0, 0, 1);
    EXPECT_LT(glm::distance(blendNormalsReoriented(n, up), n), 1e-12);
    EXPECT_LT(glm::distance(blendNormalsReoriented(up, n), n), 1e-12);
    EXPECT_LT(glm::distance(blendNormalsUdn(n, up), n), 1e-12);
}

// The rotation that takes +z to the base along the shortest arc, by Rodrigues.
TEST(Normals, ReorientingIsARotation) {
    const vec3 base = glm::normalize(vec3(0.4, 0.2, 0.7)), up(0, 0, 1);
    for (const vec3 raw : { vec3(0.1, 0.2, 0.9), vec3(-0.7, 0.1, 0.3), vec3(0.2, -0.9, 0.1) }) {
        const vec3 detail = glm::normalize(raw), axis = glm::normalize(cross(up, base));
        const double c = base.z, s = std::sqrt(1 - c * c);
        const vec3 turned = detail * c + cross(axis, detail) * s + axis * (dot(axis, detail) * (1 - c));
        EXPECT_LT(glm::distance(blendNormalsReoriented(base, detail), turned), 1e-12);
    }
}

TEST(Normals, WidthsAreThoseOfALobeWithTheSameMean) {
    EXPECT_EQ(normalWidth(1.0), 0);
    EXPECT_EQ(normalWidth(1.0 + 1e-9), 0) << "rounding";
    EXPECT_EQ(normalWidth(0.0), 1) << "they cancel out";
    for (const double length : { 0.9, 0.99, 0.999 }) // 1 - length is about the variance of slopes along an axis
        EXPECT_NEAR(normalWidth(length) * normalWidth(length), 2 * (1 - length), 2 * (1 - length) * (1 - length));
    EXPECT_GT(normalWidth(0.8), normalWidth(0.9));
}

TEST(Normals, WidthsAddToRoughnessAsVariances) {
    for (const double roughness : { 0.0, 0.3, 0.7, 1.0 }) {
        EXPECT_NEAR(widenedPerceptualRoughness(roughness, 0.0), roughness, 1e-12);
        const double alpha = std::pow(widenedPerceptualRoughness(roughness, 0.2), 2);
        EXPECT_NEAR(alpha * alpha, std::min(std::pow(roughness, 4) + 0.04, 1.0), 1e-12);
    }
    EXPECT_EQ(widenedPerceptualRoughness(0.5, 1.0), 1);
    EXPECT_EQ(widenedPerceptualRoughness(0.5, -0.2), widenedPerceptualRoughness(0.5, 0.2)) << "mirrored slopes";
}

} // namespace
} // namespace filament_core::shader::lib64
