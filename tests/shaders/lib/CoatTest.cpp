// SPDX-License-Identifier: Apache-2.0
// coat.glsl: the lobe of a clear coat, and the light that it leaves to the layers below.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

/// The reflectance of the coat's own lobe towards v.
double coatAlbedo(double nov, double alpha) {
    const vec3 v = viewAt(nov);
    return integrateHalf(v,
                         [&](vec3 l, vec3 h) {
                             return ndfGgx(h.z, alpha) * visibilitySmithGgxCorrelated(nov, l.z, alpha) *
                                    coatFresnel(dot(v, h), 1.0) * l.z;
                         },
                         { .polar = 800, .azimuth = 96, .polePower = 4 });
}

double kelemenAlbedo(double nov, double alpha) {
    const vec3 v = viewAt(nov);
    return integrateHalf(v,
                         [&](vec3 l, vec3 h) {
                             const double voh = dot(v, h);
                             return ndfGgx(h.z, alpha) * visibilityKelemen(voh) * coatFresnel(voh, 1.0) * l.z;
                         },
                         { .polar = 800, .azimuth = 96, .polePower = 4 });
}

/// A white Lambert reflector below the coat, under light from everywhere.
double attenuatedDiffuse(double nov) {
    return integrateUpper([&](vec3 l) { return diffuseLambert() * l.z * coatAttenuation(nov, l.z, 1.0); });
}

TEST(Coat, NoCoatLeavesTheBaseAsItIs) {
    EXPECT_EQ(coatFresnel(0.3, 0.0), 0);
    EXPECT_EQ(coatAttenuation(0.3, 0.7, 0.0), 1);
    EXPECT_EQ(coatAverageTransmission(0.0), 1);
    EXPECT_EQ(f0UnderCoat(vec3(0.2, 0.5, 0.9), 0.0), vec3(0.2, 0.5, 0.9));
}

TEST(Coat, ReflectsAsSchlickSaysForAnIndexOfOneAndAHalf) {
    for (const double cosine : { 0.0, 0.2, 0.6, 1.0 }) {
        EXPECT_NEAR(coatFresnel(cosine, 1.0), fresnelSchlick(vec3(f0FromIor(1.5)), 1.0, cosine).x, 1e-12);
        EXPECT_NEAR(coatFresnel(cosine, 0.5), coatFresnel(cosine, 1.0) / 2, 1e-12);
    }
}

TEST(Coat, TheAverageTransmissionIsTheIntegralOverTheHemisphere) {
    const double average = integrateUpper([](vec3 l) { return coatTransmission(l.z, 1.0) * l.z; }) / kPiOfTests;
    EXPECT_NEAR(coatAverageTransmission(1.0), average, 1e-5);
}

TEST(Coat, AttenuationIsReciprocal) {
    EXPECT_EQ(coatAttenuation(0.2, 0.7, 0.9), coatAttenuation(0.7, 0.2, 0.9));
    EXPECT_EQ(visibilityKelemen(0.5), 1.0);
}

// Goes through the index of refraction, which f0UnderCoat() never computes.
TEST(Coat, TheBaseBordersOnTheCoatInsteadOfAir) {
    for (const double f0 : { 0.0, 0.02, 0.04, 0.3, 0.75, 0.99 }) {
        const double ior = iorFromF0(f0), r = (ior - 1.5) / (ior + 1.5);
        EXPECT_NEAR(f0UnderCoat(f0), r * r, 1e-12) << f0;
    }
    EXPECT_EQ(f0UnderCoat(1.0), 1);
    EXPECT_NEAR(f0UnderCoat(0.04), 0, 1e-30) << "the same glass on both sides";
}

// The cubic that others use to avoid the root is up to 0.03 too bright; the root is affordable.
TEST(Coat, TheExactFormIsWorthItsRoot) {
    double worst = 0;
    for (int i = 0; i <= 1000; ++i) {
        const double f0 = i / 1000.0;
        const double cubic = saturate(f0 * (f0 * (0.941892 - 0.263008 * f0) + 0.346479) - 0.0285998);
        worst = std::max(worst, std::abs(cubic - f0UnderCoat(f0)));
    }
    EXPECT_GT(worst, 2e-3);
    EXPECT_LT(worst, 0.05);
}

TEST(Coat, KelemensVisibilityNeverReflectsMoreThanArrivesWhereCoatsAreSmooth) {
    for (const double roughness : { 0.1, 0.3, 0.5 }) {
        for (const double nov : { 0.05, 0.2, 0.6, 1.0 }) {
            EXPECT_LT(kelemenAlbedo(nov, roughness * roughness), kNoGain) << roughness << ' ' << nov;
        }
    }
}

TEST(Coat, TheFurnaceOfAWhiteBaseBelowAnyCoatHasNoGain) {
    for (const double roughness : { 0.1, 0.4, 0.7, 1.0 }) {
        for (const double nov : { 0.05, 0.2, 0.5, 1.0 }) {
            const double reflected = coatAlbedo(nov, roughness * roughness);
            const double diffuse = reflected + attenuatedDiffuse(nov);
            const double mirror = reflected + sq(coatTransmission(nov, 1.0));
            EXPECT_LT(diffuse, kNoGain) << roughness << ' ' << nov;
            EXPECT_LT(mirror, kNoGain) << roughness << ' ' << nov;
            EXPECT_GT(diffuse, nov < 0.3 ? 0.25 : 0.85);
        }
    }
}

// With the albedo of the lobe instead of Fresnel's equations nothing is lost on the way out, so only the 9 % of the way
// in remain.
TEST(Coat, ARoughCoatLosesNothingAtGrazingAnglesWhenItsAlbedoComesFromTheTable) {
    for (const double roughness : { 0.1, 0.4, 0.7, 1.0 }) {
        for (const double nov : { 0.05, 0.2, 0.5, 1.0 }) {
            const vec3 v = viewAt(nov);
            const auto entry = integrateHalf(v,
                                             [&](vec3 l, vec3 h) {
                                                 const double lobe =
                                                         ndfGgx(h.z, sq(roughness)) *
                                                         visibilitySmithGgxCorrelated(nov, l.z, sq(roughness)) * l.z;
                                                 return vec3(lobe * pow5(1 - dot(v, h)), lobe, 0);
                                             },
                                             { .polar = 800, .azimuth = 96, .polePower = 4 });
            const double out = coatTransmissionFromDfg(vec2(entry.x, entry.y), 1.0);
            const double total = coatAlbedo(nov, sq(roughness)) + out * coatAverageTransmission(1.0);
            EXPECT_LT(total, kNoGain) << roughness << ' ' << nov;
            EXPECT_GT(total, 0.91) << roughness << ' ' << nov;
        }
    }
}

// Image-based light has no single direction: its diffuse part enters with the average.
TEST(Coat, TheDiffuseBaseGetsTheSameFromTheSkyAsFromItsLights) {
    for (const double nov : { 0.1, 0.5, 1.0 }) {
        EXPECT_NEAR(coatTransmission(nov, 1.0) * coatAverageTransmission(1.0), attenuatedDiffuse(nov), 1e-4);
    }
}

} // namespace
} // namespace filament_core::shader::lib64
