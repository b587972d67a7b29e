// SPDX-License-Identifier: Apache-2.0
// sheen.glsl: lobes of fibres, their energy, and the light that they leave to the layer below.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

constexpr double kAlphas[] = { 0.04, 0.16, 0.49, 1.0 };

template <class Visibility>
double albedo(double nov, double alpha, Visibility&& visibility) {
    const vec3 v = viewAt(nov);
    return integrateUpper(
            [&](vec3 l) { return ndfCharlie(glm::normalize(v + l).z, alpha) * visibility(nov, l.z, alpha) * l.z; });
}

double neubeltAlbedo(double nov, double alpha) {
    return albedo(nov, alpha, [](double v, double l, double) { return visibilityNeubelt(v, l); });
}

TEST(Sheen, CharlieAndAshikhminCoverTheSurfaceExactlyOnce) {
    for (const double alpha : kAlphas) {
        EXPECT_NEAR(integrateUpper([&](vec3 h) { return ndfCharlie(h.z, alpha) * h.z; }), 1, 1e-3) << alpha;
        EXPECT_NEAR(integrateUpper([&](vec3 h) { return ndfAshikhmin(h.z, alpha) * h.z; }), 1, 1e-3) << alpha;
    }
}

TEST(Sheen, CharlieIsHighestWhereTheNormalIsPerpendicularAndAshikhminsUniformPartRemainsAtThePole) {
    for (const double alpha : kAlphas) {
        EXPECT_NEAR(ndfCharlie(0.0, alpha), (2 + 1 / alpha) / (2 * kPiOfTests), 1e-12);
        EXPECT_LT(ndfCharlie(1.0, alpha), 0.05);
    }
    EXPECT_NEAR(ndfAshikhmin(1.0, 0.5), 1 / (2 * kPiOfTests), 1e-9);
}

TEST(Sheen, TheMeanDirectionIsThatOfTheLobe) {
    for (const double roughness : { 0.25, 0.3, 0.5, 0.7, 0.85, 1.0 }) {
        for (const double nov : { 0.05, 0.3, 0.6, 0.9, 0.99 }) {
            const vec3 v = viewAt(nov);
            const auto lobe = [&](vec3 l) {
                return ndfCharlie(glm::normalize(v + l).z, alphaFromPerceptual(roughness)) *
                       visibilityNeubelt(nov, l.z) * l.z;
            };
            const vec3 mean = integrateUpper([&](vec3 l) { return l * lobe(l); }) / integrateUpper(lobe);
            const vec2 fit = sheenMeanDirection(nov, roughness);
            const double limit = nov > 0.9 ? 0.13 : 0.03; // in front of smooth fibres the ring hardly has a side
            EXPECT_NEAR(fit.x * v.x, mean.x, limit) << roughness << ' ' << nov;
            EXPECT_NEAR(fit.y, mean.z, 0.03) << roughness << ' ' << nov;
        }
    }
}

TEST(Sheen, ALookUpIsAsWideAsALobeWithThatMean) {
    for (const double alpha : { 0.05, 0.2, 0.5, 0.9 }) {
        const auto lobe = [&](vec3 l) { // pre-filtered: seen along its axis
            return 0.25 * ndfGgx(std::sqrt(0.5 * (1 + l.z)), alpha) * l.z;
        };
        const Quadrature fine{ .polePower = 3 };
        const double mean = integrateUpper([&](vec3 l) { return l.z * lobe(l); }, fine) / integrateUpper(lobe, fine);
        EXPECT_NEAR(sq(sheenLookUpRoughness(vec2(0, mean), 1.0)), alpha, 0.03);
    }
    EXPECT_EQ(sheenLookUpRoughness(vec2(0, 0.5), 1.0), 1) << "wider than the cosine's lobe";
    EXPECT_EQ(sheenLookUpRoughness(vec2(0, 1), 1.0), 0);
}

TEST(Sheen, VisibilitiesAreReciprocal) {
    EXPECT_EQ(visibilityNeubelt(0.2, 0.9), visibilityNeubelt(0.9, 0.2));
    EXPECT_NEAR(visibilityCharlie(0.2, 0.9, 0.3) / visibilityCharlie(0.9, 0.2, 0.3), 1, 1e-14);
    EXPECT_EQ(visibilityNeubelt(1.0, 1.0), 0.25);
}

// Estevez and Kulla 2017, with lambda itself instead of its logarithm.
TEST(Sheen, CharliesVisibilityIsSmithsWithTheFittedLambda) {
    const auto lambda = [](double cosine) { // table 1, roughness 1
        const auto fit = [](double x) { return 21.5473 / (1 + 3.82987 * std::pow(x, 0.19823)) - 1.9776 * x - 4.32054; };
        return std::exp(cosine < 0.5 ? fit(cosine) : 2 * fit(0.5) - fit(1 - cosine));
    };
    for (const double nov : { 0.05, 0.5, 0.9 }) {
        for (const double nol : { 0.02, 0.4, 1.0 }) {
            const double expected = 1 / ((1 + lambda(nov) + lambda(nol)) * 4 * nov * nol);
            EXPECT_NEAR(visibilityCharlie(nov, nol, 1.0) / expected, 1, 1e-9) << nov << ' ' << nol;
        }
    }
}

TEST(Sheen, TheTwoPiecesOfLambdaMeetWithTheSameSlope) {
    for (const double alpha : kAlphas) {
        const double step = 1e-4;
        const double below = charlieLogLambda(0.5 - step, alpha), at = charlieLogLambda(0.5, alpha),
                     above = charlieLogLambda(0.5 + step, alpha);
        EXPECT_NEAR(below - at, at - above, 1e-6) << alpha;
        EXPECT_NEAR(below, above, 1e-2);
    }
}

TEST(Sheen, SamplesFollowCharlie) {
    for (const double alpha : kAlphas) {
        const auto sampler = [&](vec2 u) { return importanceSampleCharlie(u, alpha); };
        const auto moment = [](vec3 h) { return h.z * h.z + 0.3 * h.x; };
        const double expected = integrateUpper([&](vec3 h) { return ndfCharlie(h.z, alpha) * h.z * moment(h); });
        EXPECT_NEAR(meanOverSamples(sampler, moment), expected, 2e-3) << alpha;
    }
}

TEST(Sheen, TheSeriesOfOneMinusExpMeetsTheExponential) {
    for (double x = 1e-9; x < 3; x *= 1.01) EXPECT_NEAR(oneMinusExp(x) / -std::expm1(-x), 1, 5e-8) << x;
    EXPECT_EQ(oneMinusExp(0.0), 0);
    EXPECT_NEAR(oneMinusExp(0.125), oneMinusExp(std::nextafter(0.125, 0.0)), 1e-8) << "where both pieces meet";
}

// The reason for sheenLimit().
TEST(Sheen, NeubeltsVisibilityReflectsMoreThanArrivesFromSmoothFibresUnlessItIsLimited) {
    EXPECT_GT(neubeltAlbedo(0.05, 0.04), 1.2);
    for (const double alpha : kAlphas) {
        for (const double nov : { 0.02, 0.1, 0.4, 1.0 }) {
            const double reflected = neubeltAlbedo(nov, alpha);
            EXPECT_LE(reflected * sheenLimit(reflected), 1 + 1e-12);
            EXPECT_EQ(sheenLimit(reflected), reflected <= 1 ? 1 : 1 / reflected);
        }
    }
}

TEST(Sheen, CharliesOwnVisibilityReflectsAtMostWhatArrivesFromRoughFibres) {
    for (const double alpha : { 0.16, 0.49, 1.0 }) {
        for (const double nov : { 0.02, 0.1, 0.4, 1.0 }) {
            EXPECT_LT(albedo(nov, alpha, [](double v, double l, double a) { return visibilityCharlie(v, l, a); }),
                      kNoGain);
        }
    }
}

TEST(Sheen, NoSheenLeavesTheBaseAsItIs) {
    EXPECT_EQ(sheenAlbedoScaling(vec3(0.0), 0.9), 1);
    EXPECT_EQ(sheenAlbedoScaling(vec3(1.0, 0.5, 0.2), 0.0), 1);
}

// Lights: each direction has an albedo, and the smaller result of both counts, which is reciprocal.
TEST(Sheen, TheFurnaceOfAWhiteBaseBelowASheenHasNoGain) {
    for (const double alpha : kAlphas) {
        for (const vec3 color : { vec3(1.0), vec3(0.5), vec3(1.0, 0.3, 0.0) }) {
            for (const double nov : { 0.05, 0.3, 0.9 }) {
                const double above = neubeltAlbedo(nov, alpha);
                const vec3 sheen = color * above * sheenLimit(above);
                const vec3 total = sheen + vec3(sheenAlbedoScaling(color, above));
                EXPECT_LT(std::max({ total.x, total.y, total.z }), kNoGain);
                EXPECT_NEAR(std::max({ total.x, total.y, total.z }), 1, 1e-9)
                        << "nor a loss, in the brightest component";
            }
        }
    }
}

} // namespace
} // namespace filament_core::shader::lib64
