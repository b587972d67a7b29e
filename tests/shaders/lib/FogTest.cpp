// SPDX-License-Identifier: Apache-2.0
// fog.glsl: the closed form against an integral that is summed up in steps, from rays of a millimetre to those of a
// million kilometres.
#include "tests/shaders/lib/Furnace.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

namespace filament_core::shader {
namespace {

struct FogCase {
    double logDensity = 0, falloff = 0, rise = 0, from = 0, to = 0;
};

/// By Gauss and Legendre's rule with five points, in steps of a fortieth of an e-folding at most, from the dense end to
/// where nothing is left. Infinite densities count as e^700.
double summedDepth(FogCase const& fog) {
    constexpr double kAt[] = { 0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640 };
    constexpr double kWeight[] = { 0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                   0.2369268850561891 };
    const double length = std::max(fog.to - fog.from, 0.0), rate = fog.falloff * std::abs(fog.rise);
    const double lowest = std::min(fog.rise * fog.from, fog.rise * fog.to);
    const double density = std::exp(std::min(fog.logDensity - fog.falloff * lowest, 700.0));
    const double reach = rate * length > 50 ? 50 / rate : length;
    constexpr int kSteps = 2000;
    double sum = 0;
    for (int step = 0; step < kSteps; ++step) {
        for (int i = 0; i < 5; ++i) {
            const double t = (step + 0.5 + 0.5 * kAt[i]) / kSteps * reach;
            sum += kWeight[i] * std::exp(-rate * t);
        }
    }
    return density * sum * (0.5 / kSteps) * reach;
}

template <class Check>
void forFogs(Check const& check) {
    for (const double density : { 0.0, 1e-6, 1e-3, 0.1, 3.0, 1e4 }) {
        for (const double falloff : { 0.0, 1e-9, 1e-4, 0.05, 1.0, 1e3 }) {
            for (const double rise : { -1.0, -0.6, -1e-3, -1e-9, 0.0, 1e-7, 1e-3, 0.3, 1.0 }) {
                for (const double from : { 0.0, 2.0, 1e4 }) {
                    for (const double length : { -1.0, 0.0, 1e-3, 0.1, 7.0, 1e3, 1e6, 1e9 }) {
                        const double logDensity = density > 0 ? std::log(density) : -1e20;
                        check(FogCase{ logDensity, falloff, rise, from, from + length });
                    }
                }
            }
        }
    }
}

TEST(Fog, TheClosedFormIsTheIntegralOfTheDensity) {
    size_t compared = 0;
    forFogs([&](FogCase const& fog) {
        const double summed = summedDepth(fog);
        const double closed = lib64::fogOpticalDepth(fog.logDensity, fog.falloff, fog.rise, fog.from, fog.to);
        EXPECT_NEAR(lib64::oneMinusExp(closed), -std::expm1(-summed), 5e-8) << fog.logDensity << ' ' << fog.falloff;
        const bool isWithin = summed > 1e-30 && summed < 1e15;
        if (!isWithin) return;
        EXPECT_NEAR(closed / summed, 1, 1e-7) << fog.falloff << ' ' << fog.rise << ' ' << fog.to;
        ++compared;
    });
    EXPECT_GT(compared, 1500u);
}

// Where the exponent is large, its rounding is that of the opacity.
TEST(Fog, SinglePrecisionCostsTheRoundingOfTheExponent) {
    forFogs([&](FogCase const& fog) {
        const FogCase rounded{ static_cast<float>(fog.logDensity), static_cast<float>(fog.falloff),
                               static_cast<float>(fog.rise), static_cast<float>(fog.from), static_cast<float>(fog.to) };
        const double truth =
                lib64::fogOpticalDepth(rounded.logDensity, rounded.falloff, rounded.rise, rounded.from, rounded.to);
        const float single = lib::fogOpticalDepth(static_cast<float>(rounded.logDensity),
                                                  static_cast<float>(rounded.falloff), static_cast<float>(rounded.rise),
                                                  static_cast<float>(rounded.from), static_cast<float>(rounded.to));
        ASSERT_TRUE(std::isfinite(single));
        const double lowest = std::min(rounded.rise * rounded.from, rounded.rise * rounded.to);
        const double exponent = std::abs(rounded.falloff * lowest) + std::min(std::abs(rounded.logDensity), 100.0);
        EXPECT_NEAR(lib::fogOpacity(single, 1), lib64::fogOpacity(truth, 1.0), 3e-7 + 2.4e-7 * exponent)
                << rounded.logDensity << ' ' << rounded.falloff << ' ' << rounded.rise << ' ' << rounded.to;
    });
}

TEST(Fog, ReachesASkyThatIsInfinitelyFarAway) {
    using lib64::fogOpticalDepth;
    const double sky = lib64::kFogInfinity;
    EXPECT_NEAR(fogOpticalDepth(std::log(0.2), 0.5, 1.0, 0.0, sky), 0.2 / 0.5, 1e-9) << "straight up";
    EXPECT_NEAR(fogOpticalDepth(std::log(0.2), 0.5, 0.1, 3.0, sky), 0.2 / 0.05 * std::exp(-0.15), 1e-9);
    EXPECT_EQ(lib64::fogOpacity(fogOpticalDepth(std::log(1e-3), 0.0, 1.0, 0.0, sky), 1.0), 1) << "level fog everywhere";
    EXPECT_EQ(lib64::fogOpacity(fogOpticalDepth(std::log(1e-3), 0.5, -0.1, 0.0, sky), 1.0), 1) << "down";
    EXPECT_TRUE(std::isfinite(lib::fogOpticalDepth(1e20f, 1e3f, -1.0f, 0.0f, lib::kFogInfinity)));
}

TEST(Fog, OpacityEndsAtTheLargest) {
    EXPECT_EQ(lib64::fogOpacity(0.0, 1.0), 0);
    EXPECT_NEAR(lib64::fogOpacity(0.5, 1.0), 1 - std::exp(-0.5), 1e-12);
    EXPECT_EQ(lib64::fogOpacity(50.0, 0.7), 0.7);
    EXPECT_EQ(lib64::fogOpacity(1e30, 1.0), 1);
}

TEST(Fog, TheGlowSumsUpToTheLightOfTheSun) {
    for (const double exponent : { 1.0, 7.0, 60.0 }) {
        const double sum =
                lib64::integrateUpper([&](lib64::vec3 d) { return lib64::fogGlow(d.z, exponent); }, { .polePower = 2 });
        EXPECT_NEAR(sum * (exponent + 1) / (2 * lib::kPiExact), 1, 1e-3) << exponent;
        EXPECT_EQ(lib64::fogGlow(-0.1, exponent), 0) << "behind";
        EXPECT_EQ(lib64::fogGlow(1.0000001, exponent), 1);
    }
}

TEST(Fog, ThePhaseFunctionScattersAllLight) {
    for (const double g : { -0.9, -0.3, 0.0, 0.2, 0.9 }) {
        double sum = 0, mean = 0;
        for (const double side : { 1.0, -1.0 }) {
            const auto phase = [&](lib64::vec3 d) {
                return lib64::henyeyGreenstein(side * d.z, g) / (4 * lib::kPiExact);
            };
            sum += lib64::integrateUpper(phase, { .polePower = 2 });
            mean += lib64::integrateUpper([&](lib64::vec3 d) { return phase(d) * side * d.z; }, { .polePower = 2 });
        }
        EXPECT_NEAR(sum, 1, 2e-3) << g;
        EXPECT_NEAR(mean, g, 2e-3) << "the mean cosine is the asymmetry";
    }
}

TEST(Fog, DepthsAndSlicesAreInverses) {
    for (const double slice : { 0.0, 0.5, 13.0, 64.0 })
        EXPECT_NEAR(lib64::fogSliceAt(lib64::fogDepthOf(slice, 64.0, 30.0), 64.0, 30.0), slice, 1e-12);
    EXPECT_EQ(lib64::fogSliceAt(1e15, 64.0, 30.0), 64) << "beyond the last one";
}

} // namespace
} // namespace filament_core::shader
