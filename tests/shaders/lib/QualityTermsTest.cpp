// SPDX-License-Identifier: Apache-2.0
// The terms that <filament_core/Quality.h> offers besides the defaults, compared with closed forms and second formulas.
#include "filament_core/assets/tables/DfgTable.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

#include <complex>

namespace filament_core::shader::lib {
namespace {

// Smith's G1 with lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2: Heitz 2014, eq. 72.
double smithG1(double cosine, double alpha) {
    const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * tangent2));
}

TEST(SpecularVisibility, TheUncorrelatedOneIsTheProductOfTwoMaskings) {
    for (const float alpha : { 0.002025f, 0.1f, 0.5f, 1.0f }) {
        for (const float nov : { 0.01f, 0.3f, 0.9f, 1.0f }) {
            for (const float nol : { 0.02f, 0.5f, 1.0f }) {
                const double expected = smithG1(nov, alpha) * smithG1(nol, alpha) / (4.0 * nov * nol);
                EXPECT_NEAR(visibilitySmithGgxUncorrelated(nov, nol, alpha), expected, 1e-4 * expected);
            }
        }
    }
}

TEST(SpecularVisibility, TheUncorrelatedOneIsNeverBrighterAndNeverInfinite) {
    for (const float roughness : kEdges) {
        const float alpha = alphaFromPerceptual(clampPerceptualRoughness(roughness));
        for (const float nov : kEdges) {
            for (const float nol : kEdges) {
                const float separable = visibilitySmithGgxUncorrelated(nov, nol, alpha);
                EXPECT_TRUE(std::isfinite(separable));
                EXPECT_LE(separable, visibilitySmithGgxCorrelated(nov, nol, alpha) * 1.00001f);
            }
        }
    }
}

// With complex arithmetic, which fresnelComplex() avoids. Born and Wolf, section 14.2.
double reflectance(double cosine, std::complex<double> index) {
    const std::complex<double> inside = std::sqrt(index * index - (1 - cosine * cosine));
    const std::complex<double> s = (cosine - inside) / (cosine + inside);
    const std::complex<double> p = (index * index * cosine - inside) / (index * index * cosine + inside);
    return (std::norm(s) + std::norm(p)) / 2;
}

TEST(Fresnel, ADielectricReflectsAsFresnelsEquationsSay) {
    for (const float ior : { 1.1f, 1.5f, 2.4f }) {
        for (float cosine = 0.02f; cosine <= 1; cosine += 0.07f)
            EXPECT_NEAR(fresnelExact(f0FromIor(ior), 0.0f, cosine), reflectance(cosine, ior), 2e-5) << ior << cosine;
    }
}

TEST(Fresnel, AMetalReflectsAsItsComplexIndexSays) {
    const std::pair<float, float> metals[] = { { 0.2f, 3.9f }, { 1.5f, 7.6f }, { 2.9f, 3.1f } }; // n, k
    for (auto const& [n, k] : metals) {
        for (float cosine = 0.02f; cosine <= 1; cosine += 0.07f)
            EXPECT_NEAR(fresnelComplex(cosine, n, k * k), reflectance(cosine, { n, k }), 2e-5) << n << cosine;
    }
}

// Gulbrandsen's parameters have this purpose: r is the reflectance at normal incidence for any tint.
TEST(Fresnel, AtNormalIncidenceTheExactTermIsF0AndAtGrazingItIsOne) {
    for (const float f0 : { 0.02f, 0.04f, 0.3f, 0.7f, 0.95f }) {
        for (const float tint : { 0.0f, 0.25f, 1.0f }) {
            EXPECT_NEAR(fresnelExact(f0, tint, 1.0f), f0, 1e-4f) << tint;
            EXPECT_NEAR(fresnelExact(f0, tint, 0.0f), 1.0f, 1e-5f) << tint;
        }
    }
}

TEST(Fresnel, TheExactTermStaysAReflectanceAtAllEdges) {
    for (const float f0 : kEdges) {
        for (const float tint : kEdges) {
            for (const float voh : kEdges) {
                const float f = fresnelExact(f0, tint, voh);
                EXPECT_TRUE(f >= 0 && f <= 1) << f0 << ' ' << tint << ' ' << voh << ": " << f;
            }
        }
    }
}

// Lagarde and de Rousiers normalised it for this.
TEST(Diffuse, DisneysLobeReflectsAtMostWhatItReceives) {
    for (const float roughness : { 0.0f, 0.25f, 0.5f, 0.75f, 1.0f }) {
        for (const float nov : { 0.05f, 0.3f, 0.7f, 1.0f }) {
            const vec3 v(std::sqrt(1 - nov * nov), 0, nov);
            const double albedo = integrateHemisphere([&](vec3 l) {
                const float voh = saturate(dot(v, glm::normalize(v + l)));
                return diffuseDisney(nov, l.z, voh, roughness) * l.z;
            });
            EXPECT_LE(albedo, 1.02) << roughness << ' ' << nov;
            EXPECT_GE(albedo, nov < 0.3f ? 0.2 : 0.6) << roughness << ' ' << nov;
        }
    }
}

TEST(Diffuse, DisneysLobeIsReciprocalAndRetroReflectsWhereItIsRough) {
    EXPECT_EQ(diffuseDisney(0.2f, 0.7f, 0.4f, 0.6f), diffuseDisney(0.7f, 0.2f, 0.4f, 0.6f));
    EXPECT_GT(diffuseDisney(0.1f, 0.1f, 1.0f, 1.0f), diffuseLambert());
    EXPECT_LT(diffuseDisney(0.1f, 0.1f, 0.1f, 0.0f), diffuseLambert());
}

TEST(SplitSum, TheAnalyticFitIsAsNearToTheIntegralAsItsCommentSaysAndOrderedAsATableEntry) {
    // By hand: r = (0.7, 0.03425, 0.8684, -0.0334), a = 0.49 limited to 2^-8.816, times 0.7, plus 0.03425.
    EXPECT_NEAR(dfgAnalytic(0.95f, 0.3f).x, 0.0038f, 1e-3f);
    EXPECT_NEAR(dfgAnalytic(0.95f, 0.3f).y, 0.8350f, 1e-3f);
    for (const float roughness : { 0.1f, 0.3f, 0.5f, 0.7f, 1.0f }) {
        for (const float nov : { 0.1f, 0.3f, 0.6f, 0.95f }) {
            const vec2 fit = dfgAnalytic(nov, roughness);
            const float2 integral = assets::integrateDfg(nov, alphaFromPerceptual(roughness));
            EXPECT_NEAR(fit.x, integral.x, 0.09f) << roughness << ' ' << nov;
            EXPECT_NEAR(fit.y, integral.y, 0.31f) << roughness << ' ' << nov;
        }
    }
    for (const float nov : kEdges) {
        for (const float roughness : kEdges) {
            const vec2 fit = dfgAnalytic(nov, roughness);
            EXPECT_TRUE(fit.x >= 0 && fit.x <= fit.y && fit.y > 0.3f && fit.y <= 1.0f) << nov << ' ' << roughness;
        }
    }
}

} // namespace
} // namespace filament_core::shader::lib
