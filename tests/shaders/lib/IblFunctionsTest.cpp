// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/tables/DfgTable.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib {
namespace {

TEST(IblFunctions, FiveLevelsHoldTheRoughnessesOfTheTalk) {
    const std::array<float, 5> alphas{ 0.000f, 0.018f, 0.086f, 0.250f, 1.000f };
    for (size_t i = 0; i < alphas.size(); ++i) {
        const float roughness = perceptualRoughnessFromLevel(static_cast<float>(i), 4.0f);
        EXPECT_NEAR(alphaFromPerceptual(roughness), alphas[i], 5e-4f) << "level " << i;
    }
}

TEST(IblFunctions, RoughnessAndLevelAreInverses) {
    for (int i = 0; i <= 100; ++i) {
        const float roughness = static_cast<float>(i) / 100;
        EXPECT_NEAR(perceptualRoughnessFromLevel(levelFromPerceptualRoughness(roughness, 4.0f), 4.0f), roughness,
                    1e-3f);
    }
    EXPECT_EQ(levelFromPerceptualRoughness(1.0f, 7.0f), 7.0f);
}

TEST(IblFunctions, TheDominantDirectionLeavesTheMirrorOnlyForRoughSurfaces) {
    const vec3 n(0, 0, 1), r(0.8f, 0, 0.6f);
    EXPECT_EQ(dominantSpecularDirection(n, r, 0.0f), r);
    EXPECT_EQ(dominantSpecularDirection(n, r, 1.0f), n);
    EXPECT_NEAR(dominantSpecularDirection(n, r, 0.1f).x, 0.8f, 0.05f);
    EXPECT_EQ(quadraticSpecularDirection(n, r, 0.0f), r);
    EXPECT_EQ(quadraticSpecularDirection(n, r, 1.0f), n);
}

// Look-ups at visible half vectors have the mean direction of the lobe, which a single one can only guess.
TEST(IblFunctions, VisibleHalfVectorsHaveTheMeanOfTheLobe) {
    constexpr int kCount = 256;
    for (const float alpha : { 0.1f, 0.4f, 0.9f }) {
        for (const float nov : { 0.2f, 0.6f, 0.95f }) {
            const vec3 v(std::sqrt(1 - nov * nov), 0, nov);
            glm::dvec3 sum(0), exact(0);
            double weights = 0, total = 0;
            for (int i = 0; i < kCount; ++i) {
                const float radius = std::sqrt((static_cast<float>(i) + 0.5f) / kCount),
                            phi = 2.3999632f * static_cast<float>(i);
                const vec3 h = visibleHalfVector(nov, alpha, vec2(radius * std::cos(phi), radius * std::sin(phi)));
                const vec3 l = h * (2 * dot(v, h)) - v;
                if (l.z <= 0) continue;
                const double weight = visibleLookUpWeight(nov, l.z, alpha);
                sum += glm::dvec3(l) * weight, weights += weight;
            }
            total = integrateSphere([&](vec3 l) {
                const vec3 h = (v + l) / std::max(glm::length(v + l), 1e-6f);
                if (l.z <= 0) return 0.0;
                const double value = double(ndfGgx(h.z, alpha) * visibilitySmithGgxCorrelated(nov, l.z, alpha) * l.z);
                return value;
            });
            for (int c = 0; c < 3; ++c) {
                exact[c] = integrateSphere([&](vec3 l) {
                    const vec3 h = (v + l) / std::max(glm::length(v + l), 1e-6f);
                    if (l.z <= 0) return 0.0;
                    return double(l[c]) *
                           double(ndfGgx(h.z, alpha) * visibilitySmithGgxCorrelated(nov, l.z, alpha) * l.z);
                });
            }
            EXPECT_LT(glm::length(sum / weights - exact / total), 0.03) << alpha << ' ' << nov;
        }
    }
}

// Coefficients of an environment L(d), by the definition in ibl.glsl: projection on the basis, cosine lobe, 1/pi.
template <class F>
std::array<vec4, 9> projectSh(F&& radiance) {
    const auto polynomial = [](int i, vec3 d) {
        const double x = d.x, y = d.y, z = d.z;
        const double values[9] = { 1, y, z, x, x * y, y * z, 3 * z * z - 1, z * x, x * x - y * y };
        return values[i];
    };
    // squared normalisation constants of real spherical harmonics
    const double k[9] = { 1 / (4 * kPiExact),  3 / (4 * kPiExact),  3 / (4 * kPiExact),
                          3 / (4 * kPiExact),  15 / (4 * kPiExact), 15 / (4 * kPiExact),
                          5 / (16 * kPiExact), 15 / (4 * kPiExact), 15 / (16 * kPiExact) };
    const double band[9] = { 1, 2. / 3, 2. / 3, 2. / 3, 0.25, 0.25, 0.25, 0.25, 0.25 };
    std::array<vec4, 9> sh;
    for (int i = 0; i < 9; ++i) {
        const double projected = integrateSphere([&](vec3 d) { return radiance(d) * polynomial(i, d); });
        sh[static_cast<size_t>(i)] = vec4(static_cast<float>(projected * k[i] * band[i]));
    }
    return sh;
}

template <class F>
double irradianceOverPi(F&& radiance, vec3 n) {
    return integrateSphere([&](vec3 d) { return radiance(d) * std::max(0.0f, dot(d, n)); }) / kPiExact;
}

const std::array<vec3, 7> kNormals{ vec3(1, 0, 0),       vec3(-1, 0, 0), vec3(0, 1, 0),
                                    vec3(0, 0, 1),       vec3(0, 0, -1), vec3(0.57735f, 0.57735f, 0.57735f),
                                    vec3(0.6f, -0.8f, 0) };

TEST(IblFunctions, ThreeBandsAreExactForPolynomialsOfTheSecondDegree) {
    const auto constant = [](vec3) { return 2.5f; };
    const auto linear = [](vec3 d) { return 1.0f + 0.5f * d.x - 0.3f * d.y + 0.2f * d.z; };
    const auto quadratic = [](vec3 d) { return 1.0f + 0.4f * d.x * d.y - 0.3f * d.z * d.z + 0.2f * d.y * d.z; };
    const auto check = [&](auto radiance, const char* name) {
        const std::array<vec4, 9> sh = projectSh(radiance);
        for (const vec3 n : kNormals)
            EXPECT_NEAR(irradianceSh(sh.data(), n, 3).x, irradianceOverPi(radiance, n), 2e-3) << name;
    };
    check(constant, "constant");
    check(linear, "linear");
    check(quadratic, "quadratic");
}

// A sky that falls off with the cosine from +y: compared with the closed form at the pole and the integral elsewhere.
TEST(IblFunctions, ThreeBandsAreWithinThreePercentOfACosineLobe) {
    const auto lobe = [](vec3 d) { return std::max(0.0f, d.y); };
    const std::array<vec4, 9> sh = projectSh(lobe);
    EXPECT_NEAR(irradianceOverPi(lobe, vec3(0, 1, 0)), 2.0 / 3, 1e-3) << "integral of cos^2 over the hemisphere / pi";
    for (const vec3 n : kNormals) EXPECT_NEAR(irradianceSh(sh.data(), n, 3).x, irradianceOverPi(lobe, n), 0.03 * 2 / 3);
}

TEST(IblFunctions, FewerBandsUseFewerCoefficients) {
    std::array<vec4, 9> sh;
    for (size_t i = 0; i < 9; ++i) sh[i] = vec4(static_cast<float>(i + 1));
    const vec3 n(0.6f, 0.0f, 0.8f);
    EXPECT_FLOAT_EQ(irradianceSh(sh.data(), n, 1).x, 1.0f);
    EXPECT_FLOAT_EQ(irradianceSh(sh.data(), n, 2).x, 1.0f + 3.0f * 0.8f + 4.0f * 0.6f);
    EXPECT_GT(irradianceSh(sh.data(), n, 3).x, irradianceSh(sh.data(), n, 2).x);
}

TEST(IblFunctions, IrradianceIsNeverNegative) {
    const std::array<vec4, 9> sh{ vec4(0.1f), vec4(5.0f) };
    EXPECT_EQ(irradianceSh(sh.data(), vec3(0, -1, 0), 3), vec3(0.0f));
}

// The furnace: under a white sky a white metal must be invisible. The lobe is integrated over light directions without
// the table; the table only compensates. A single bounce loses up to more than half.
TEST(IblFunctions, AWhiteMetalPassesTheFurnaceOnlyWithEnergyCompensation) {
    for (const float roughness : { 0.5f, 0.75f, 1.0f }) {
        const float alpha = alphaFromPerceptual(roughness);
        for (const float nov : { 0.1f, 0.4f, 0.9f }) {
            const vec3 v(std::sqrt(1 - nov * nov), 0, nov), white(1.0f);
            const double oneBounce = integrateHemisphere(
                    [&](vec3 l) {
                        const vec3 h = glm::normalize(v + l);
                        return ndfGgx(min(h.z, 1.0f), alpha) * visibilitySmithGgxCorrelated(nov, l.z, alpha) * l.z *
                               fresnelSchlick(white, 1.0f, dot(v, h)).x;
                    },
                    600, 200, 1);
            const float2 dfg = assets::integrateDfg(nov, alpha);
            EXPECT_NEAR(oneBounce * energyCompensation(white, dfg).x, 1.0, 0.01)
                    << "roughness " << roughness << " nov " << nov;
            EXPECT_LT(oneBounce, roughness == 1.0f ? 0.8 : 1.003);
        }
    }
}

// Image-based light multiplies the albedo of specularDfg() by energyCompensation() just like other lights.
TEST(IblFunctions, TheSplitSumOfAWhiteMetalIsTheTablesGreenAndCompensatedOne) {
    const float2 dfg = assets::integrateDfg(0.5f, 0.6f);
    EXPECT_FLOAT_EQ(specularDfg(vec3(1.0f), 1.0f, dfg).x, dfg.y);
    EXPECT_FLOAT_EQ(specularDfg(vec3(0.0f), 1.0f, dfg).x, dfg.x);
    EXPECT_NEAR((specularDfg(vec3(1.0f), 1.0f, dfg) * energyCompensation(vec3(1.0f), dfg)).x, 1.0f, 1e-6f);
}

} // namespace
} // namespace filament_core::shader::lib
