// SPDX-License-Identifier: Apache-2.0
// refraction.glsl: directions compared with a ray traced through a ball, path lengths and absorption with their
// definitions.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

const vec3 kNormal(0, 0, 1);
constexpr double kIors[] = { 1.0, 1.01, 1.33, 1.5, 2.42 };
constexpr double kCosines[] = { 0.001, 0.2, 0.7, 1.0 };

double sineTo(vec3 n, vec3 d) { return glm::length(cross(n, d)); }

TEST(Refraction, SnellsLawHoldsAtTheEntry) {
    for (const double ior : kIors) {
        for (const double nov : kCosines) {
            const vec3 view = viewAt(nov), inside = refractedInside(kNormal, view, ior);
            EXPECT_NEAR(glm::length(inside), 1, 1e-12);
            EXPECT_LE(inside.z, 0);
            EXPECT_NEAR(sineTo(kNormal, view), ior * sineTo(kNormal, inside), 1e-12);
            EXPECT_NEAR(-inside.z, refractedCosine(nov, ior), 1e-12);
            const vec3 general = refractOrReflect(-view, kNormal, 1 / ior);
            EXPECT_LT(glm::distance(inside, general), 1e-7);
        }
    }
}

TEST(Refraction, AllLightIsReflectedBeyondTheCriticalAngleAndNoneJumpsThere) {
    const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));
    const vec3 beyond = viewAt(critical - 0.01), before = viewAt(critical + 0.01), at = viewAt(critical + 1e-12);
    EXPECT_LT(glm::distance(refractOrReflect(-beyond, kNormal, 1.5), vec3(-beyond.x, 0, beyond.z)), 1e-12);
    EXPECT_LT(refractOrReflect(-before, kNormal, 1.5).z, 0);
    EXPECT_NEAR(refractOrReflect(-at, kNormal, 1.5).z, 0, 1e-5) << "along the surface";
}

// The ball of diameter 2 below the origin: intersects the ray with it and refracts it twice.
TEST(Refraction, TheSolidModelIsARayThroughABall) {
    for (const double ior : kIors) {
        for (const double nov : kCosines) {
            const vec3 view = viewAt(nov), centre(0, 0, -1);
            const vec3 inside = refractOrReflect(-view, kNormal, 1 / ior);
            const double length = 2 * dot(centre, inside);
            const vec3 exitNormal = inside * length - centre;
            EXPECT_NEAR(glm::length(exitNormal), 1, 1e-12);
            EXPECT_NEAR(solidPathLength(nov, ior, 2.0), length, 1e-9);
            if (nov < 0.1) continue; // refractOrReflect() loses the grazing angle that refractedSolid() keeps
            EXPECT_LT(glm::distance(refractedSolid(kNormal, view, ior), refractOrReflect(inside, -exitNormal, ior)),
                      1e-9)
                    << ior << ' ' << nov;
        }
    }
}

TEST(Refraction, TheExitIsAtTheOtherEndOfTheChord) {
    for (const double ior : kIors) {
        for (const double nov : kCosines) {
            const vec3 centre(0, 0, -1), exit = solidExit(kNormal, viewAt(nov), ior, 2.0);
            EXPECT_NEAR(glm::length(exit - centre), 1, 1e-9) << "on the ball";
            EXPECT_NEAR(glm::length(exit), solidPathLength(nov, ior, 2.0), 1e-12);
        }
    }
}

// Half of a lobe's light, and of a normal distribution's, on either side of an edge.
TEST(Refraction, ARoughInterfaceBlursAnEdgeLikeANormalDistribution) {
    for (const double roughness : { 0.1, 0.5, 1.0 }) {
        const double alpha = roughness * roughness, within = alpha / std::sqrt(3.0);
        EXPECT_NEAR(within / std::sqrt(alpha * alpha + within * within), 0.5, 1e-12); // of the slopes of GGX
        const double deviation = transmittedDeviation(roughness);
        EXPECT_NEAR(std::erf(2 * within / (deviation * std::sqrt(2.0))), 0.5, 1e-3);
    }
    EXPECT_EQ(transmittedDeviation(0.0), 0);
}

// The blur of each level, measured: its kernel convolved level by level, then linear weights between its texels.
TEST(Refraction, ALevelOfThePictureIsBlurredAsMuchAsItsNumberSays) {
    for (int level = 0; level <= 7; ++level) {
        double variance = 0;
        for (int n = 0; n < level; ++n) // weights 1, 3, 3, 1 at +-1/2 and +-3/2 texels of level n
            variance += (2 * (3 * 0.25 + 1 * 2.25) / 8) * std::exp2(2 * n);
        variance += std::exp2(2 * level) / 6;
        EXPECT_NEAR(pictureLevel(std::sqrt(variance)), level == 0 ? 0.0 : level, 1e-9) << level;
    }
    EXPECT_EQ(pictureLevel(0.0), 0);
    EXPECT_EQ(pictureLevel(0.4), 0);
}

TEST(Refraction, AnIndexOfOneChangesNothing) {
    for (const double nov : kCosines) {
        const vec3 view = viewAt(nov);
        EXPECT_LT(glm::distance(refractedSolid(kNormal, view, 1.0), -view), 1e-12);
        EXPECT_LT(glm::distance(refractedInside(kNormal, view, 1.0), -view), 1e-12);
    }
    EXPECT_EQ(refractionPerceptualRoughness(0.7, 1.0), 0);
    EXPECT_EQ(refractionPerceptualRoughness(0.7, 1.5), 0.7);
    EXPECT_EQ(dispersedIor(1.0, 5.0), vec3(1.0));
    EXPECT_EQ(thinReflectance(vec3(0.0)), vec3(0.0));
}

TEST(Refraction, ThinLayersAreCrossedAlongTheBentRay) {
    EXPECT_NEAR(thinPathLength(1.0, 1.5, 0.001), 0.001, 1e-15);
    EXPECT_NEAR(thinPathLength(0.0, 1.5, 0.001), 0.001 / std::sqrt(1 - 1 / 2.25), 1e-12);
    EXPECT_EQ(thinPathLength(0.0, 1.0, 0.5), 16) << "along the surface, where it would be infinite";
}

// Every bounce separately, with the tint at each crossing.
TEST(Refraction, AThinLayerWithAColorReflectsAndTransmitsTheSumOfAllBounces) {
    for (const double f : { 0.0, 0.04, 0.3, 0.9 }) {
        for (const double tint : { 0.0, 0.25, 0.8, 1.0 }) {
            double inside = (1 - f) * tint, passed = 0, far = 0; // at the far interface
            for (int bounce = 0; bounce < 400; ++bounce) {
                passed += inside * (1 - f);
                inside *= f * tint; // at the near one
                far += inside * (1 - f);
                inside *= f * tint;
            }
            EXPECT_NEAR(thinTransmittance(vec3(f), vec3(tint)).x, passed, 1e-9);
            EXPECT_NEAR(thinFarReflectance(vec3(f), vec3(tint)).x, far, 1e-9);
        }
        const double together = (thinTransmittance(vec3(f), vec3(1.0)) + thinFarReflectance(vec3(f), vec3(1.0))).x;
        EXPECT_NEAR(together, 1 - f, 1e-9) << "clear glass loses nothing";
        EXPECT_NEAR((thinFarReflectance(vec3(f), vec3(1.0)) + f).x, thinReflectance(vec3(f)).x, 1e-9);
    }
    EXPECT_LE(thinTransmittance(vec3(1.0), vec3(1.0)).x, 0.0);
}

// Every bounce separately: f, then (1-f)^2 f (f^2)^k.
TEST(Refraction, AThinLayerReflectsTheSumOfAllBounces) {
    for (const double f : { 0.04, 0.3, 0.9 }) {
        double sum = f;
        for (int bounce = 0; bounce < 400; ++bounce) sum += sq(1 - f) * f * std::pow(f, 2 * bounce);
        EXPECT_NEAR(thinReflectance(vec3(f)).x, sum, 1e-9);
    }
    EXPECT_EQ(thinReflectance(vec3(1.0)), vec3(1.0));
}

// Abbe's number of the result must be 20 / dispersion.
TEST(Refraction, DispersionSpreadsTheIndicesAsTheAbbeNumberSays) {
    const vec3 ior = dispersedIor(1.5, 0.5);
    EXPECT_NEAR((ior.y - 1) / (ior.z - ior.x), 20 / 0.5, 1e-9);
    EXPECT_EQ(dispersedIor(1.5, 0.0), vec3(1.5));
    EXPECT_EQ(dispersedIor(1.2, 100.0).x, 1) << "not below air";
}

TEST(Refraction, AbsorptionMultipliesOverDistances) {
    const vec3 absorption(0.0, 0.5, 3.0);
    EXPECT_EQ(transmittance(absorption, 0.0), vec3(1.0));
    const vec3 once = transmittance(absorption, 0.7), twice = transmittance(absorption, 1.4);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(once[i] * once[i], twice[i], 1e-12);
    EXPECT_EQ(transmittanceWithoutThickness(vec3(0.0, 0.25, 2.0)), vec3(1.0, 0.75, 0.0));
}

TEST(Refraction, AbsorptionOfAColourAtADistanceGivesThatColourThere) {
    const vec3 color(0.9, 0.3, 0.01);
    const vec3 back = transmittance(absorptionAtDistance(color, 0.25), 0.25);
    EXPECT_LT(glm::distance(back, color), 1e-12);
    EXPECT_EQ(absorptionAtDistance(color, std::numeric_limits<double>::infinity()), vec3(0.0));
    EXPECT_EQ(absorptionAtDistance(vec3(1.0), 0.0), vec3(0.0));
}

TEST(Specular, IndexReflectanceAndF0SayTheSame) {
    for (const double ior : { 1.0, 1.33, 1.5, 2.2 }) {
        EXPECT_NEAR(reflectanceFromIor(ior), reflectanceFromF0(f0FromIor(ior)), 1e-12);
        EXPECT_NEAR(iorFromReflectance(reflectanceFromIor(ior)), ior, 1e-12);
        EXPECT_NEAR(f0FromReflectance(reflectanceFromIor(ior)), f0FromIor(ior), 1e-12);
    }
    EXPECT_NEAR(iorFromReflectance(0.5), 1.5, 1e-12);
}

TEST(Specular, NeutralWeightsGiveTheStandardMaterial) {
    const vec3 base(0.8, 0.4, 0.1), white(1.0);
    for (const double metallic : { 0.0, 0.3, 1.0 }) {
        EXPECT_LT(glm::distance(f0FromSpecular(base, metallic, 0.04, white, 1.0), f0FromBaseColor(base, metallic, 0.5)),
                  1e-12);
        EXPECT_EQ(f90FromSpecular(1.0, metallic), 1);
    }
    EXPECT_EQ(f0FromSpecular(base, 1.0, 0.04, vec3(0.0), 0.0), base) << "metals are not concerned";
    EXPECT_EQ(f0FromSpecular(base, 0.0, 0.04, vec3(100.0), 1.0), white) << "no more than all";
    EXPECT_EQ(f90FromSpecular(0.0, 0.0), 0);
}

TEST(Specular, SpecularGlossinessLeavesToTheDiffuseLobeWhatItDoesNotReflect) {
    EXPECT_EQ(diffuseColorFromSpecularGlossiness(vec3(0.5), vec3(0.0)), vec3(0.5));
    EXPECT_EQ(diffuseColorFromSpecularGlossiness(vec3(1.0), vec3(0.25, 0.75, 0.5)), vec3(0.25));
    EXPECT_EQ(perceptualRoughnessFromGlossiness(0.75), 0.25);
}

} // namespace
} // namespace filament_core::shader::lib64
