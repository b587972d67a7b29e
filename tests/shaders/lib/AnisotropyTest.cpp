// SPDX-License-Identifier: Apache-2.0
// brdf_anisotropic.glsl: physics of the stretched lobe, and that it equals the round one without stretching.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::shader::lib64 {
namespace {

const vec2 kAnisotropicAlphas[] = { { 0.05, 0.6 }, { 0.3, 0.3 }, { 1.6, 0.4 }, { 2.0, 0.1 } };
constexpr Quadrature kFine{ .polar = 1500, .azimuth = 720, .polePower = 3 };

vec3 localHalf(vec3 v, vec3 l) { return glm::normalize(v + l); }

TEST(Anisotropy, TheRoughnessesAreEqualForZeroAndSwapWithTheSign) {
    EXPECT_EQ(anisotropicAlpha(0.25, 0.0, kMinAlpha), vec2(0.25));
    EXPECT_EQ(anisotropicAlpha(0.25, 0.8, kMinAlpha).x, anisotropicAlpha(0.25, -0.8, kMinAlpha).y);
    EXPECT_NEAR(anisotropicAlpha(0.25, 0.8, kMinAlpha).x, 0.45, 1e-12);
    EXPECT_EQ(anisotropicAlpha(0.25, 1.0, kMinAlpha).y, kMinAlpha);
    EXPECT_EQ(anisotropicAlphaFromStrength(0.25, 0.0, kMinAlpha), vec2(0.25));
    EXPECT_EQ(anisotropicAlphaFromStrength(0.25, 1.0, kMinAlpha), vec2(1.0, 0.25));
}

TEST(Anisotropy, EqualRoughnessesGiveTheIsotropicLobe) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0.01, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const double alpha = uniform(random);
        const vec3 v = glm::normalize(vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random)));
        const vec3 l = glm::normalize(vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random)));
        const vec3 h = localHalf(v, l);
        EXPECT_NEAR(ndfGgxAnisotropic(h, vec2(alpha)) / ndfGgx(h.z, alpha), 1, 1e-9);
        EXPECT_NEAR(visibilitySmithGgxAnisotropic(v, l, vec2(alpha)) / visibilitySmithGgxCorrelated(v.z, l.z, alpha), 1,
                    1e-9);
    }
}

TEST(Anisotropy, TheNormalDistributionCoversTheSurfaceExactlyOnce) {
    for (const vec2 alpha : kAnisotropicAlphas) {
        const double covered = integrateUpper([&](vec3 h) { return ndfGgxAnisotropic(h, alpha) * h.z; }, kFine);
        EXPECT_NEAR(covered, 1, 1e-3) << alpha.x << ' ' << alpha.y;
    }
}

// Heitz 2014, eq. 72 and 86, in tangents.
TEST(Anisotropy, MaskingTowardsTheNormalIsSmithsMaskingFunction) {
    for (const vec2 alpha : kAnisotropicAlphas) {
        for (const double angle : { 0.0, 0.7, 1.5 }) {
            for (const double nov : { 0.05, 0.4, 0.9 }) {
                const double sine = std::sqrt(1 - nov * nov);
                const vec3 v(sine * std::cos(angle), sine * std::sin(angle), nov);
                const double stretched = (sq(alpha.x * v.x) + sq(alpha.y * v.y)) / (nov * nov);
                const double g1 = 2 / (1 + std::sqrt(1 + stretched));
                EXPECT_NEAR(visibilitySmithGgxAnisotropic(v, vec3(0, 0, 1), alpha) * 4 * nov / g1, 1, 1e-12);
            }
        }
    }
}

TEST(Anisotropy, TheLobeIsReciprocal) {
    const vec3 a = glm::normalize(vec3(0.3, -0.8, 0.2)), b = glm::normalize(vec3(-0.9, 0.1, 0.7));
    for (const vec2 alpha : kAnisotropicAlphas) {
        EXPECT_DOUBLE_EQ(visibilitySmithGgxAnisotropic(a, b, alpha), visibilitySmithGgxAnisotropic(b, a, alpha));
    }
}

TEST(Anisotropy, OneBounceNeverReflectsMoreThanArrives) {
    for (const vec2 alpha : kAnisotropicAlphas) {
        for (const double nov : { 0.1, 0.5, 0.95 }) {
            for (const bool along : { true, false }) {
                const vec3 v = along ? viewAt(nov) : vec3(0, viewAt(nov).x, nov);
                const double albedo = integrateHalf(v,
                                                    [&](vec3 l, vec3 h) {
                                                        return ndfGgxAnisotropic(h, alpha) *
                                                               visibilitySmithGgxAnisotropic(v, l, alpha) * l.z;
                                                    },
                                                    { .polar = 600, .azimuth = 720, .polePower = 3 });
                EXPECT_LT(albedo, kNoGain) << alpha.x << ' ' << alpha.y << " nov " << nov;
                EXPECT_GT(albedo, 0.2);
            }
        }
    }
}

// Moments of the distribution that the samples should follow.
TEST(Anisotropy, SamplesFollowTheDistribution) {
    for (const vec2 alpha : kAnisotropicAlphas) {
        const auto sampler = [&](vec2 u) { return importanceSampleGgxAnisotropic(u, alpha); };
        for (const int component : { 0, 1, 2 }) {
            const auto moment = [&](vec3 h) { return h[component] * h[component]; };
            const double expected =
                    integrateUpper([&](vec3 h) { return ndfGgxAnisotropic(h, alpha) * h.z * moment(h); }, kFine);
            EXPECT_NEAR(meanOverSamples(sampler, moment), expected, 3e-3) << alpha.x << ' ' << alpha.y;
        }
    }
}

// The mean direction of the reflected light, by a few look-ups along the grain against the lobe itself.
TEST(Anisotropy, LookUpsAlongTheGrainHaveTheMeanOfTheLobe) {
    for (const vec2 alpha : { vec2(0.5, 0.1), vec2(1, 0.25), vec2(0.85, 0.15) }) {
        for (const vec3 v : { glm::normalize(vec3(0.7, 0, 0.5)), glm::normalize(vec3(0.3, 0.6, 0.6)), viewAt(0.95) }) {
            const auto lobe = [&](vec3 l, vec3 h) {
                return ndfGgxAnisotropic(h, alpha) * visibilitySmithGgxAnisotropic(v, l, alpha) * l.z;
            };
            const Quadrature fine{ .polar = 600, .azimuth = 360, .polePower = 3 };
            const vec3 mean = integrateHalf(
                                      v, [&](vec3 l, vec3 h) { return l * lobe(l, h); }, fine) /
                              integrateHalf(v, lobe, fine);
            vec3 sum(0);
            double weights = 0;
            for (int i = 0; i < 9; ++i) {
                const vec4 lookUp = grainLookUp(v, alpha, grainHalfVector(v, alpha, (i + 0.5) / 9));
                sum += vec3(lookUp) * lookUp.w;
                weights += lookUp.w;
            }
            EXPECT_LT(glm::length(sum / weights - mean), alpha.y < 0.2 ? 0.1 : 0.15)
                    << "the plane has no width" << alpha.x << ' ' << v.x << ' ' << v.y;
        }
    }
}

TEST(Anisotropy, HalfVectorsAlongTheGrainLieBetweenTheViewAndTheHorizon) {
    for (const vec3 view :
         { vec3(0, 0, 1), vec3(0.8, 0, 0.6), vec3(-0.8, 0.5, std::sqrt(0.11)), vec3(0.9, 0.4, 0.1) }) {
        const vec3 seen = glm::normalize(view);
        const vec2 alpha(0.7, 0.1);
        const vec2 stretched = glm::normalize(vec2(alpha.x * seen.x, seen.z));
        for (const double share : { 0.0, 0.1, 0.5, 0.9, 1.0 }) {
            const vec4 half = grainHalfVector(seen, alpha, share);
            EXPECT_NEAR(half.x * half.x + half.y * half.y, 1, 1e-12);
            EXPECT_NEAR(half.x * stretched.x + half.y * stretched.y, half.z, 1e-12);
            EXPECT_GE(half.z, 0) << "the view sees it";
            EXPECT_GE(half.y, -1e-12) << "it is above the horizon";
        }
        EXPECT_NEAR(grainHalfVector(seen, alpha, 0).z, 0, 1e-12);
        EXPECT_NEAR(grainHalfVector(seen, alpha, 1).y, 0, 1e-12);
    }
}

// By differences: how far the mirrored view turns for a small turn of the half vector, over that of a view along it.
TEST(Anisotropy, ALookUpAlongTheGrainIsAsWideAsItsHalfVectorsTurnTheMirroredView) {
    constexpr double kTurn = 1e-5;
    for (const vec3 view : { vec3(0.6, 0, 0.8), vec3(0, 0.9, std::sqrt(0.19)), glm::normalize(vec3(-0.7, 0.6, 0.2)) }) {
        for (const double x : { -0.8, 0.0, 0.4 }) {
            const vec2 alpha(0.5, 0.1), thin(0.5, 0);
            const vec4 half(x, std::sqrt(1 - x * x), 0.5, 1);
            const vec3 h = glm::normalize(vec3(alpha.x * half.x, 0, half.y));
            const auto mirrored = [&](vec3 of) { return of * (2 * glm::dot(view, of)) - view; };
            const auto turned = [&](vec3 towards) {
                return glm::length(mirrored(glm::normalize(h + towards * kTurn)) - mirrored(h)) / (2 * kTurn);
            };
            const double across = sq(grainLookUpRoughness(view, alpha, half, 1e9));
            EXPECT_NEAR(across / sq(grainLookUpRoughness(h, alpha, half, 1e9)), turned({ 0, 1, 0 }), 1e-4);
            const double gap = sq(grainLookUpRoughness(view, thin, half, 5));
            EXPECT_NEAR(gap / sq(grainLookUpRoughness(h, thin, half, 5)), turned({ h.z, 0, -h.x }), 1e-4);
        }
    }
    EXPECT_NEAR(sq(grainLookUpRoughness({ 0, 0, 1 }, { 0.5, 0.1 }, { 0, 1, 1, 2 }, 1e9)), kGrainWidth * 0.1, 1e-9);
    EXPECT_EQ(grainLookUpRoughness({ 0, 0, 1 }, { 2, 2 }, { 0, 1, 1, 2 }, 1), 1);
}

TEST(Anisotropy, ThePositiveSignStretchesTheHighlightAlongTheTangent) {
    const vec2 alpha = anisotropicAlpha(0.2, 0.8, kMinAlpha);
    EXPECT_GT(ndfGgxAnisotropic(viewAt(0.97), alpha), 10 * ndfGgxAnisotropic(vec3(0, viewAt(0.97).x, 0.97), alpha));
}

TEST(Anisotropy, TheBentNormalLiesInThePlaneAcrossTheGrooves) {
    const vec3 n(0, 0, 1), t(1, 0, 0), b(0, 1, 0), view = glm::normalize(vec3(0.5, 0.6, 0.4));
    EXPECT_EQ(anisotropicNormal(n, t, b, view, 0.0, 0.5), n);
    EXPECT_EQ(anisotropicNormal(n, t, b, view, 1.0, 0.0), n) << "a mirror";
    const vec3 along = anisotropicNormal(n, t, b, view, 1.0, 0.5), across = anisotropicNormal(n, t, b, view, -1.0, 0.5);
    EXPECT_NEAR(along.y, 0, 1e-12);
    EXPECT_GT(along.x, 0.3);
    EXPECT_NEAR(across.x, 0, 1e-12);
    EXPECT_GT(across.y, 0.3);
    EXPECT_NEAR(glm::length(along), 1, 1e-12);
}

TEST(Anisotropy, TheBentNormalIsANumberWhereTheEyeLooksAlongTheGroovesOrFromBehind) {
    const vec3 n(0, 0, 1), t(1, 0, 0), b(0, 1, 0);
    for (const vec3 view : { vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, -1), vec3(1, 0, 0) }) {
        for (const double anisotropy : { -1.0, -0.5, 0.5, 0.96875, 1.0 }) {
            const vec3 bent = anisotropicNormal(n, t, b, view, anisotropy, 1.0);
            EXPECT_TRUE(std::isfinite(bent.x) && std::isfinite(bent.y) && std::isfinite(bent.z));
        }
    }
}

} // namespace
} // namespace filament_core::shader::lib64
