// SPDX-License-Identifier: Apache-2.0
// The stored table against the lobe that it stands for, between its nodes as well as at them.
#include "tools/ltcfit/LtcFit.h"

#include "filament_core/assets/tables/DfgTable.h"
#include "shaders/interface/LtcTable.h"
#include "shaders/lib/LibCppDouble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace filament_core::tools {
namespace {

namespace lib = shader::lib64;

static_assert(lib::kLtcTableSize == shader::kLtcTableSize);

// None of them is a node.
constexpr std::array kRoughnesses{ 0.045, 0.08, 0.13, 0.21, 0.3, 0.44, 0.6, 0.77, 0.93, 1.0 };
constexpr std::array kCosines{ 1.0, 0.97, 0.85, 0.65, 0.45, 0.3, 0.2, 0.1, 0.04 };

LtcTerms stored(double nov, double roughness) { return lookUpLtc(shader::kLtcTable.data(), nov, roughness); }

/// f(direction), over the hemisphere, with t^2 points near the mirrored view.
template <class F>
auto integrate(GgxLobe const& lobe, F&& f) {
    constexpr int kPolar = 400, kAround = 200;
    const double3 axis = glm::normalize(double3(-lobe.view().x, 0, lobe.view().z));
    const double3 x = glm::normalize(glm::cross(double3(0, 1, 0), axis)), y = glm::cross(axis, x);
    decltype(f(axis)) sum{};
    for (int i = 0; i < kPolar; ++i) {
        const double t = (i + 0.5) / kPolar, angle = lib::kPi * t * t * t, measure = 3 * lib::kPi * t * t / kPolar;
        for (int j = 0; j < kAround; ++j) {
            const double turn = lib::kTwoPi * (j + 0.5) / kAround;
            const double3 d = std::sin(angle) * (std::cos(turn) * x + std::sin(turn) * y) + std::cos(angle) * axis;
            if (d.z > 0) sum += f(d) * (std::sin(angle) * measure * lib::kTwoPi / kAround);
        }
    }
    return sum;
}

double lobeOf(LtcTerms const& terms, double3 d) { return lib::ltcLobe({ terms.a, terms.b, terms.d }, d); }

TEST(LtcFit, TheLobeHasTheNormOfTheDfgTable) {
    for (const double roughness : kRoughnesses) {
        for (const double nov : kCosines) {
            const auto alpha = static_cast<float>(roughness * roughness);
            EXPECT_NEAR(GgxLobe(nov, roughness).norm(), assets::integrateDfg(static_cast<float>(nov), alpha).y, 2e-3)
                    << roughness << ' ' << nov;
        }
    }
}

TEST(LtcFit, SamplingAndIntegratingFindTheSameNorm) {
    for (const double roughness : { 0.21, 0.44, 0.93 }) {
        for (const double nov : { 1.0, 0.65, 0.3 }) {
            const GgxLobe lobe(nov, roughness);
            EXPECT_NEAR(integrate(lobe, [&](double3 d) { return lobe.value(d); }), lobe.norm(), 3e-3);
        }
    }
}

// A linear transformation keeps the integral, and this one keeps the horizon: so it holds for every lobe of the table.
TEST(LtcFit, EveryStoredLobeHasNormOne) {
    double worst = 0;
    for (const double roughness : kRoughnesses) {
        for (const double nov : kCosines) {
            const LtcTerms terms = stored(nov, roughness);
            const double norm = integrate(GgxLobe(nov, roughness), [&](double3 d) { return lobeOf(terms, d); });
            EXPECT_NEAR(norm, 1, 2e-3) << roughness << ' ' << nov;
            worst = std::max(worst, std::abs(norm - 1));
        }
    }
    std::printf("largest error of a norm: %.5f\n", worst);
}

TEST(LtcFit, MeanDirectionsAreThoseOfTheBrdf) {
    double worst = 0;
    for (const double roughness : kRoughnesses) {
        for (const double nov : kCosines) {
            const GgxLobe lobe(nov, roughness);
            const LtcTerms terms = stored(nov, roughness);
            const double3 expected = glm::normalize(integrate(lobe, [&](double3 d) { return d * lobe.value(d); }));
            const double3 found = glm::normalize(integrate(lobe, [&](double3 d) { return d * lobeOf(terms, d); }));
            const double degrees = glm::degrees(std::acos(std::min(glm::dot(expected, found), 1.0)));
            EXPECT_LT(degrees, nov < 0.25 ? 7.0 : 4.0) << roughness << ' ' << nov;
            worst = std::max(worst, degrees);
        }
    }
    std::printf("largest error of a mean direction: %.2f degrees\n", worst);
}

// No light, whatever its shape, gains or loses more than this part of the lobe.
TEST(LtcFit, TheTableIsCloseToTheLobeBetweenItsNodes) {
    std::vector<double> all;
    for (const double roughness : kRoughnesses) {
        std::printf("roughness %.3f:", roughness);
        for (const double nov : kCosines) {
            const GgxLobe lobe(nov, roughness);
            const double error = totalVariation(lobe, stored(nov, roughness));
            std::printf(" %.4f", error);
            EXPECT_LT(error, nov < 0.25 ? 0.3 : 0.15) << roughness << ' ' << nov;
            all.push_back(error);
        }
        std::printf("\n");
    }
    std::ranges::sort(all);
    std::printf("median %.4f, largest %.4f\n", all[all.size() / 2], all.back());
    EXPECT_LT(all[all.size() / 2], 0.05);
}

TEST(LtcFit, InterpolatingCostsLittleBesideTheFit) {
    for (const double roughness : { 0.13, 0.3, 0.6, 0.93 }) {
        for (const double nov : { 0.97, 0.65, 0.3, 0.15 }) {
            const GgxLobe lobe(nov, roughness);
            const LtcTerms between = stored(nov, roughness), best = fitLtc(lobe, between);
            EXPECT_LT(totalVariation(lobe, between), totalVariation(lobe, best) + 0.01) << roughness << ' ' << nov;
        }
    }
}

TEST(LtcFit, TheStoredTableIsThatOfTheTool) {
    constexpr int kLast = shader::kLtcTableSize - 1;
    for (auto const& [column, row] : { std::pair{ 0, 7 }, { 5, 20 }, { 13, 3 }, { 20, 12 }, { 27, 30 } }) {
        const double nov = 1 - lib::sq(static_cast<double>(column) / kLast);
        const double roughness = lib::kLtcMinRoughness + (1 - lib::kLtcMinRoughness) * row / kLast;
        const GgxLobe lobe(nov, roughness);
        const LtcTerms expected = fitLtc(lobe, mirrorTerms(nov, lobe.alpha())), found = stored(nov, roughness);
        EXPECT_NEAR(found.a, expected.a, 1e-3) << column << ' ' << row;
        EXPECT_NEAR(found.b, expected.b, 1e-3) << column << ' ' << row;
        EXPECT_NEAR(found.d, expected.d, 1e-3) << column << ' ' << row;
    }
}

TEST(LtcFit, FittingImprovesOnTheTermsOfAMirror) {
    for (const double roughness : { 0.3, 0.6, 1.0 }) {
        const GgxLobe lobe(0.3, roughness);
        EXPECT_LT(totalVariation(lobe, stored(0.3, roughness)),
                  0.8 * totalVariation(lobe, mirrorTerms(0.3, lobe.alpha())))
                << roughness;
    }
}

TEST(LtcFit, ASmallTableHasAMirrorFirstAndLambertsLobeNowhere) {
    const std::vector<float3> table = fitLtcTable(2);
    ASSERT_EQ(table.size(), 4u);
    EXPECT_NEAR(table[0].x, 0, 1e-3);
    EXPECT_NEAR(table[0].y, 0, 1e-3);
    EXPECT_NEAR(table[0].z, 1, 1e-3);
    EXPECT_NEAR(table[2].z * 2, 1.14, 0.01) << "n.l / (1 + n.l) is a little wider than a cosine";
}

} // namespace
} // namespace filament_core::tools
