// SPDX-License-Identifier: Apache-2.0
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace filament_core::shader::lib {
namespace {

TEST(Sampling, TheRadicalInverseMirrorsTheBits) {
    EXPECT_EQ(radicalInverse(0), 0.0f);
    EXPECT_EQ(radicalInverse(1), 0.5f);
    EXPECT_EQ(radicalInverse(2), 0.25f);
    EXPECT_EQ(radicalInverse(3), 0.75f);
    EXPECT_EQ(radicalInverse(0x80000000u), 0.0f) << "2^-32 is cut";
    EXPECT_LT(radicalInverse(0xFFFFFFFFu), 1.0f);
}

// Discrepancy: every one of 16 x 16 cells holds exactly one of 256 Hammersley points.
TEST(Sampling, HammersleyPointsFillTheSquareEvenly) {
    std::vector<int> cells(256);
    for (uint i = 0; i < 256; ++i) {
        const vec2 u = hammersley(i, 1.0f / 256);
        ++cells[static_cast<size_t>(u.x * 16) * 16 + static_cast<size_t>(u.y * 16)];
    }
    EXPECT_EQ(std::ranges::count(cells, 1), 256);
}

template <class Sample>
double meanCosine(Sample&& sample) {
    constexpr uint kCount = 4096;
    double sum = 0;
    for (uint i = 0; i < kCount; ++i) {
        const vec3 d = sample(hammersley(i, 1.0f / kCount));
        EXPECT_NEAR(dot(d, d), 1.0f, 1e-5f);
        EXPECT_GE(d.z, 0.0f);
        sum += d.z;
    }
    return sum / kCount;
}

TEST(Sampling, DirectionsHaveTheMeanCosineOfTheirDensity) {
    EXPECT_NEAR(meanCosine(hemisphereUniformSample), 0.5, 1e-3);
    EXPECT_NEAR(meanCosine(hemisphereCosineSample), 2.0 / 3, 1e-3);
    EXPECT_NEAR(meanCosine([](vec2 u) { return importanceSampleGgx(u, 1.0f); }), 2.0 / 3, 1e-3)
            << "alpha 1 is the cosine lobe";
}

// Chi-square: 32 bins of equal probability by the distribution's closed form, P(cos > c) = alpha^2 (1 - c^2) /
// (c^2 (alpha^2 - 1) + 1) / alpha^2, rewritten for the fraction. 0.999 quantile with 31 degrees of freedom: 61.1.
TEST(Sampling, GgxSamplesFollowTheDistribution) {
    for (const float alpha : { 0.05f, 0.3f, 0.8f }) {
        constexpr uint kCount = 8192;
        std::array<int, 32> bins{};
        for (uint i = 0; i < kCount; ++i) {
            const double c = importanceSampleGgx(hammersley(i, 1.0f / kCount), alpha).z;
            const double tan2 = (1 - c * c) / (c * c);
            const double below = tan2 / (double(alpha) * alpha + tan2); // probability of a smaller angle
            ++bins[std::min<size_t>(31, static_cast<size_t>(below * 32))];
        }
        double chi = 0;
        for (const int count : bins) chi += (count - kCount / 32.0) * (count - kCount / 32.0) / (kCount / 32.0);
        EXPECT_LT(chi, 61.1) << "alpha " << alpha;
    }
}

TEST(Sampling, EdgesOfTheUnitSquareGiveFiniteDirections) {
    for (const float u : kEdges) {
        for (const float alpha : { kMinAlpha, 0.5f, 1.0f }) {
            EXPECT_TRUE(isFinite(importanceSampleGgx(vec2(u, min(u, 0.99999994f)), alpha)));
        }
        EXPECT_TRUE(isFinite(hemisphereCosineSample(vec2(u))));
        EXPECT_TRUE(isFinite(hemisphereUniformSample(vec2(u))));
    }
}

} // namespace
} // namespace filament_core::shader::lib
