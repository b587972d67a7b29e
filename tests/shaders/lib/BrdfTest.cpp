// SPDX-License-Identifier: Apache-2.0
// Physics of the specular lobe: properties of any correct D, V and F, whatever the formula.
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::shader::lib {
namespace {

vec3 viewAt(float nov) { return { std::sqrt(1 - nov * nov), 0, nov }; }

// Fraction of light that a white mirror-faceted surface reflects towards v after one bounce, by brute force: the lobe
// is integrated over half vectors, dl = 4 voh dh.
double albedoByHalfVectors(float nov, float alpha) {
    const vec3 v = viewAt(nov);
    return integrateHemisphere(
            [&](vec3 h) {
                const float voh = dot(v, h);
                const float nol = 2 * voh * h.z - v.z;
                if (voh <= 0 || nol <= 0) return 0.0;
                return double(ndfGgx(h.z, alpha)) * visibilitySmithGgxCorrelated(nov, nol, alpha) * nol * 4 * voh;
            },
            1500, 96, 4);
}

TEST(Brdf, TheNormalDistributionCoversTheSurfaceExactlyOnce) {
    for (const float roughness : { 0.045f, 0.1f, 0.2f, 0.4f, 0.7f, 1.0f }) {
        const float alpha = alphaFromPerceptual(roughness);
        // power 6: half of the points within a cosine of 1 - 2^-6, for lobes of a tenth of a degree
        const double covered = integrateHemisphere([&](vec3 h) { return ndfGgx(h.z, alpha) * h.z; }, 4000, 4, 6);
        EXPECT_NEAR(covered, 1.0, roughness < 0.1f ? 0.01 : 1e-3) << "roughness " << roughness;
    }
}

TEST(Brdf, TheNormalDistributionPeaksAtOneOverPiAlphaSquared) {
    for (const float alpha : { kMinAlpha, 0.01f, 0.25f, 1.0f }) {
        EXPECT_NEAR(ndfGgx(1.0f, alpha) * kPiExact * alpha * alpha, 1.0, 1e-5);
    }
}

// Compares double precision from the exact cosine with fp32 from the rounded cosine and from the vectors.
TEST(Brdf, TheCrossProductFormKeepsTheHighlightOfTheLeastRoughnessWhereTheCosineFormLosesPercents) {
    const double alpha = kMinAlpha, a2 = alpha * alpha;
    double worstFromCosine = 0, worstFromVectors = 0;
    for (int i = 1; i <= 200; ++i) {
        const double angle = i * 2.5e-5;
        const vec3 n(0, 0, 1);
        const vec3 h(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
        const double sine = std::sin(angle), denominator = sine * sine + a2 * (1 - sine * sine);
        const double exact = a2 / (kPiExact * denominator * denominator);
        worstFromCosine = std::max(worstFromCosine, std::fabs(ndfGgx(h.z, kMinAlpha) / exact - 1));
        worstFromVectors = std::max(worstFromVectors, std::fabs(ndfGgxFromVectors(n, h, kMinAlpha) / exact - 1));
    }
    EXPECT_LT(worstFromVectors, 1e-5);
    EXPECT_LT(worstFromCosine, 0.04);
    EXPECT_GT(worstFromCosine, 100 * worstFromVectors);
}

TEST(Brdf, BothFormsOfTheNormalDistributionAgreeAwayFromThePeak) {
    for (const float alpha : { 0.04f, 0.3f, 1.0f }) {
        for (const float noh : { 0.1f, 0.5f, 0.9f, 0.99f }) {
            const vec3 h = viewAt(noh);
            EXPECT_NEAR(ndfGgxFromVectors(vec3(0, 0, 1), h, alpha) / ndfGgx(h.z, alpha), 1.0, 1e-4);
        }
    }
}

// Smith's masking must leave exactly the projected area of the visible facets: the weak white furnace of Heitz 2014.
// Checked through the separable G1 that the correlated form reduces to when the light is at the normal.
TEST(Brdf, MaskingTowardsTheNormalIsSmithsMaskingFunction) {
    for (const float alpha : { 0.01f, 0.2f, 0.6f, 1.0f }) {
        for (const float nov : { 0.05f, 0.3f, 0.8f, 1.0f }) {
            const double tan2 = (1.0 - double(nov) * nov) / (double(nov) * nov);
            const double g1 = 2 / (1 + std::sqrt(1 + double(alpha) * alpha * tan2));
            EXPECT_NEAR(visibilitySmithGgxCorrelated(nov, 1.0f, alpha) * 4 * nov / g1, 1.0, 1e-5);
        }
    }
}

TEST(Brdf, TheSpecularLobeIsReciprocal) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.001f, 1.0f);
    for (int i = 0; i < 1000; ++i) {
        const float nov = uniform(random), nol = uniform(random), alpha = uniform(random);
        EXPECT_FLOAT_EQ(visibilitySmithGgxCorrelated(nov, nol, alpha), visibilitySmithGgxCorrelated(nol, nov, alpha));
        EXPECT_FLOAT_EQ(visibilitySmithGgxCorrelatedFast(nov, nol, alpha),
                        visibilitySmithGgxCorrelatedFast(nol, nov, alpha));
    }
}

TEST(Brdf, TheFastVisibilityIsExactAtBothEndsAndNeverBrighterThanASixth) {
    for (const float nov : { 0.1f, 0.4f, 0.9f }) {
        for (const float nol : { 0.1f, 0.5f, 1.0f }) {
            EXPECT_NEAR(visibilitySmithGgxCorrelatedFast(nov, nol, 1.0f) / visibilitySmithGgxCorrelated(nov, nol, 1.0f),
                        1, 1e-5);
            EXPECT_NEAR(visibilitySmithGgxCorrelatedFast(nov, nol, 1e-4f) /
                                visibilitySmithGgxCorrelated(nov, nol, 1e-4f),
                        1, 1e-2);
            for (const float alpha : { 0.1f, 0.3f, 0.6f }) {
                const float ratio = visibilitySmithGgxCorrelatedFast(nov, nol, alpha) /
                                    visibilitySmithGgxCorrelated(nov, nol, alpha);
                EXPECT_LE(ratio, 1.001f);
                EXPECT_GT(ratio, 0.6f);
            }
        }
    }
}

TEST(Brdf, OneBounceNeverReflectsMoreThanArrives) {
    for (const float alpha : { 0.1f, 0.3f, 0.6f, 1.0f }) {
        for (const float nov : { 0.05f, 0.3f, 0.7f, 1.0f }) {
            const double albedo = albedoByHalfVectors(nov, alpha);
            EXPECT_LT(albedo, 1.003) << "nov " << nov << " alpha " << alpha;
            EXPECT_GT(albedo, 0.3);
        }
    }
}

// The furnace: in white light a white surface must vanish. dfg.y is the albedo of one bounce.
TEST(Brdf, EnergyCompensationMakesAWhiteMetalPassTheFurnaceThatItFailsWithout) {
    const float alpha = 1.0f, nov = 0.5f;
    const auto albedo = static_cast<float>(albedoByHalfVectors(nov, alpha));
    EXPECT_LT(albedo, 0.75f);
    const vec3 compensated = albedo * energyCompensation(vec3(1.0f), vec2(0.1f, albedo));
    EXPECT_NEAR(compensated.x, 1.0f, 1e-6f);
    EXPECT_NEAR(specularDfg(vec3(1.0f), 1.0f, vec2(0.1f, albedo)).x, albedo, 1e-6f) << "split sum of f0 = 1 is dfg.y";
}

TEST(Brdf, EnergyCompensationLeavesDielectricsAlmostAlone) {
    const vec3 factor = energyCompensation(vec3(0.04f), vec2(0.05f, 0.6f));
    EXPECT_NEAR(factor.x, 1.0f + 0.04f * (1 / 0.6f - 1), 1e-6f);
    EXPECT_EQ(energyCompensation(vec3(0.7f), vec2(0.0f, 1.0f)), vec3(1.0f));
}

TEST(Brdf, FresnelRunsFromF0AtNormalIncidenceToF90AtGrazing) {
    const vec3 f0(0.04f, 0.5f, 1.0f);
    EXPECT_EQ(fresnelSchlick(f0, 1.0f, 1.0f), f0);
    EXPECT_EQ(fresnelSchlick(f0, 1.0f, 0.0f), vec3(1.0f));
    vec3 last = f0;
    for (int i = 100; i >= 0; --i) {
        const vec3 f = fresnelSchlick(f0, 1.0f, static_cast<float>(i) / 100);
        EXPECT_GE(f.x, last.x);
        last = f;
    }
}

// Fresnel's equations for an unpolarised wave, ior 1.5: Schlick's fit is known to stay within 0.02 there.
TEST(Brdf, SchlickFollowsFresnelsEquationsForGlass) {
    for (int i = 0; i <= 100; ++i) {
        const double c = i / 100.0, g = std::sqrt(1.5 * 1.5 - 1 + c * c);
        const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
        EXPECT_NEAR(fresnelSchlick(vec3(f0FromIor(1.5f)), 1.0f, static_cast<float>(c)).x, 0.5 * a * a * (1 + b * b),
                    0.04);
    }
}

TEST(Brdf, IndexOfRefractionAndF0AreInverses) {
    for (const float ior : { 1.0f, 1.33f, 1.5f, 1.77f, 2.42f }) EXPECT_NEAR(iorFromF0(f0FromIor(ior)), ior, 1e-4f);
    EXPECT_NEAR(f0FromIor(1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(f0FromReflectance(0.5f), 0.04f, 1e-7f);
    EXPECT_NEAR(f0FromReflectance(0.35f), 0.0196f, 1e-6f);
}

TEST(Brdf, MetalsReflectTheirBaseColourAndHaveNoDiffuse) {
    const vec3 gold(1.0f, 0.85f, 0.57f);
    EXPECT_EQ(f0FromBaseColor(gold, 1.0f, 0.5f), gold);
    EXPECT_EQ(diffuseColor(gold, 1.0f), vec3(0.0f));
    EXPECT_NEAR(f0FromBaseColor(gold, 0.0f, 0.5f).y, 0.04f, 1e-7f);
    EXPECT_EQ(diffuseColor(gold, 0.0f), gold);
    EXPECT_NEAR(diffuseLambert() * integrateHemisphere([](vec3 d) { return d.z; }), 1.0, 1e-4);
}

TEST(Brdf, RoughnessIsClampedToWhatThePrecisionHolds) {
    EXPECT_EQ(clampPerceptualRoughness(0.0f), 0.045f);
    EXPECT_EQ(clampPerceptualRoughness(2.0f), 1.0f);
    EXPECT_FLOAT_EQ(alphaFromPerceptual(clampPerceptualRoughness(0.0f)), kMinAlpha);
    const float medium = clampPerceptualRoughnessMedium(0.0f);
    EXPECT_GE(medium * medium * medium * medium, 6.1e-5f) << "2^-14, the smallest normal half";
}

TEST(Brdf, NoArgumentOfTheEdgeGridYieldsNanOrInfinity) {
    for (const float roughness : kEdges) {
        const float alpha = alphaFromPerceptual(clampPerceptualRoughness(roughness));
        for (const float a : kEdges) {
            EXPECT_TRUE(std::isfinite(ndfGgx(a, alpha)));
            EXPECT_TRUE(isFinite(fresnelSchlick(vec3(a), 1.0f, roughness)));
            EXPECT_TRUE(std::isfinite(ndfGgxFromVectors(vec3(0, 0, 1), viewAt(a), alpha)));
            for (const float b : kEdges) {
                const float v = visibilitySmithGgxCorrelated(a, b, alpha),
                            fast = visibilitySmithGgxCorrelatedFast(a, b, alpha);
                EXPECT_TRUE(std::isfinite(v * ndfGgx(1.0f, alpha)) && v >= 0);
                EXPECT_TRUE(std::isfinite(fast * ndfGgx(1.0f, alpha)) && fast >= 0);
                EXPECT_EQ(v * 0.0f, 0.0f) << "times n.l = 0 is black, not NaN";
            }
        }
    }
}

} // namespace
} // namespace filament_core::shader::lib
