// SPDX-License-Identifier: Apache-2.0
// The table's four integrals, compared with closed forms and with slower ways to integrate.
#include "filament_core/assets/tables/DfgTable.h"
#include "base/math/Half.h"
#include "shaders/lib/LibCppDouble.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

#include <cstring>

namespace filament_core::shader::lib {
namespace {

constexpr std::array kRoughnesses{ 0.045, 0.1, 0.2, 0.4, 0.7, 1.0 };
constexpr std::array kCosines{ 0.002, 0.01, 0.05, 0.2, 0.5, 0.8, 1.0 };

double2 dfg(double nov, double roughness) {
    return double2(assets::integrateDfg(static_cast<float>(nov), static_cast<float>(roughness * roughness)));
}

// Where alpha is 1, D is 1 / pi and V is 1 / (2 (nov + nol)): the integral is that of nol / (nov + nol) over nol.
TEST(DfgTable, TheRoughestSurfaceHasAClosedForm) {
    for (int i = 1; i <= 1000; ++i) {
        const double nov = i / 1000.0;
        EXPECT_NEAR(dfg(nov, 1).y, 1 - nov * std::log(1 + 1 / nov), 1e-4) << nov;
    }
}

// A mirror reflects everything, and by Schlick f90 contributes (1 - nov)^5.
TEST(DfgTable, TheSmoothestSurfaceIsFresnelAlone) {
    for (const double nov : { 0.1, 0.5, 1.0 }) {
        EXPECT_NEAR(dfg(nov, kMinPerceptualRoughness).y, 1, 1e-3);
        EXPECT_NEAR(dfg(nov, kMinPerceptualRoughness).x, lib64::pow5(1 - nov), 1e-3);
    }
}

// Points of a square as half vectors, all equally likely to be seen. Dupuy and Benyoub 2023, "Sampling Visible GGX
// Normals with Spherical Caps". Uses neither the coordinates nor the nodes of the table, and does not treat the horizon
// specially.
double2 albedoByVisibleNormals(double nov, double alpha, int steps) {
    const double3 v(std::sqrt(1 - nov * nov), 0, nov), stretched = glm::normalize(double3(alpha, 1, 1) * v);
    const double masking = 2 * nov / (nov + std::sqrt(alpha * alpha + (1 - alpha * alpha) * nov * nov));
    double2 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double z = 1 - (i + 0.5) / steps * (1 + stretched.z), sine = std::sqrt(1 - z * z);
        for (int j = 0; j < steps; ++j) {
            const double phi = kPiExact * (j + 0.5) / steps; // the other half is its mirror image
            const double3 facet = stretched + double3(sine * std::cos(phi), sine * std::sin(phi), z);
            const double3 h = glm::normalize(double3(alpha, alpha, 1) * facet);
            const double voh = glm::dot(v, h), nol = 2 * voh * h.z - nov;
            if (nol <= 0) continue;
            const double lit = lib64::visibilitySmithGgxCorrelated(nov, nol, alpha) * 4 * nol * nov / masking;
            sum += double2(lit * lib64::pow5(1 - std::min(voh, 1.0)), lit);
        }
    }
    return sum / (double(steps) * steps);
}

TEST(DfgTable, EveryCornerIsWithinAThousandthOfAConvergedIntegral) {
    for (const double roughness : kRoughnesses) {
        for (const double nov : kCosines) {
            const double2 expected = albedoByVisibleNormals(nov, roughness * roughness, 600);
            EXPECT_NEAR(dfg(nov, roughness).x, expected.x, 1e-3) << roughness << ' ' << nov;
            EXPECT_NEAR(dfg(nov, roughness).y, expected.y, 1e-3) << roughness << ' ' << nov;
        }
    }
}

// Against the BRDF integrated over light directions, without half vectors.
TEST(DfgTable, ItIsTheAlbedoThatBruteForceFinds) {
    for (const float roughness : { 0.35f, 0.6f, 1.0f }) {
        const float alpha = alphaFromPerceptual(roughness);
        for (const float nov : { 0.2f, 0.5f, 0.95f }) {
            const vec3 v(std::sqrt(1 - nov * nov), 0, nov);
            const auto lobe = [&](vec3 l, bool schlick) {
                const vec3 h = glm::normalize(v + l);
                const float voh = dot(v, h);
                const float value = ndfGgx(min(h.z, 1.0f), alpha) * visibilitySmithGgxCorrelated(nov, l.z, alpha) * l.z;
                return schlick ? value * pow5(1 - voh) : value;
            };
            const float2 table = assets::integrateDfg(nov, alpha);
            EXPECT_NEAR(table.y, integrateHemisphere([&](vec3 l) { return lobe(l, false); }, 600, 200, 1), 1e-3);
            EXPECT_NEAR(table.x, integrateHemisphere([&](vec3 l) { return lobe(l, true); }, 600, 200, 1), 1e-3);
        }
    }
}

/// Integral of the lobe of fibres ndf(noh) Neubelt's V nol: midpoints of the azimuth and of the cube root of nol.
template <class Ndf>
double fibreAlbedo(double nov, Ndf const& ndf, int steps = 400) {
    const double sine = std::sqrt(1 - nov * nov);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, nol = t * t * t, across = sine * std::sqrt(1 - nol * nol);
        for (int j = 0; j < steps; ++j) {
            const double vol = nov * nol + across * std::cos(kPiExact * (j + 0.5) / steps);
            const double noh = std::min((nov + nol) / std::sqrt(2 + 2 * vol), 1.0);
            sum += ndf(noh) * lib64::visibilityNeubelt(nov, nol) * nol * 3 * t * t;
        }
    }
    return sum * 2 * kPiExact / (double(steps) * steps);
}

TEST(DfgTable, FibresAreWithinThreeTenThousandthsOfAConvergedIntegral) {
    for (const double roughness : kRoughnesses) {
        for (const double nov : kCosines) {
            const double alpha = roughness * roughness;
            const auto n = static_cast<float>(nov), a = static_cast<float>(alpha);
            const double sheen = fibreAlbedo(nov, [&](double noh) { return lib64::ndfCharlie(noh, alpha); });
            const double velvet = fibreAlbedo(nov, [&](double noh) { return lib64::ndfAshikhmin(noh, alpha); });
            EXPECT_NEAR(assets::integrateSheen(n, a), sheen, 3e-4 * std::max(sheen, 1.0)) << roughness << ' ' << nov;
            EXPECT_NEAR(assets::integrateVelvet(n, a), velvet, 3e-4) << roughness << ' ' << nov;
            EXPECT_LT(velvet, 1.0);
        }
    }
}

TEST(DfgTable, EntriesAreWhereTheHeaderSaysAndReflectNoMoreThanArrives) {
    jobs::JobSystem jobs({ .workers = 0 });
    const assets::Image table = assets::bakeDfgTable(jobs, 16);
    ASSERT_EQ(table.data.size(), 16u * 16 * 8);
    for (size_t i = 0; i < 256; ++i) {
        uint16_t halves[4];
        std::memcpy(halves, table.data.data() + 8 * i, 8);
        const float nov = (static_cast<float>(i % 16) + 0.5f) / 16,
                    roughness = (static_cast<float>(i / 16) + 0.5f) / 16;
        const float alpha = alphaFromPerceptual(clampPerceptualRoughness(roughness));
        const float2 expected = assets::integrateDfg(nov, alpha);
        const float sheen = assets::integrateSheen(nov, alpha);
        EXPECT_NEAR(floatFromHalf(halves[0]), expected.x, 5e-4f);
        EXPECT_NEAR(floatFromHalf(halves[1]), expected.y, 5e-4f);
        EXPECT_NEAR(floatFromHalf(halves[2]), sheen, 5e-4f * std::max(sheen, 1.0f));
        EXPECT_NEAR(floatFromHalf(halves[3]), assets::integrateVelvet(nov, alpha), 5e-4f);
        EXPECT_LE(floatFromHalf(halves[0]), floatFromHalf(halves[1]));
        EXPECT_LE(floatFromHalf(halves[1]), 1.0f);
    }
}

} // namespace
} // namespace filament_core::shader::lib
