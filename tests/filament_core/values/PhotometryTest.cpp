// SPDX-License-Identifier: Apache-2.0
// Lamps and colour temperatures against integrals: flux over the sphere, Planck's law, and published chromaticities.
#include <filament_core/Color.h>
#include <filament_core/Math.h>
#include <filament_core/Photometry.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core {
namespace {

using std::numbers::pi;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

/// The fall-off of KHR_lights_punctual as the engine sets it up, with a difference of the cosines of 1e-3 at least.
double fallOff(double cosine, double inner, double outer) {
    const double scale = 1 / std::max(1e-3, std::cos(inner) - std::cos(outer));
    const double linear = std::clamp((cosine - std::cos(outer)) * scale, 0.0, 1.0);
    return linear * linear;
}

/// Lumens of a spot: the integral over the sphere, by the midpoint rule in the angle.
double fluxOfSpot(double candela, double inner, double outer) {
    constexpr int kSteps = 200'000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = (i + 0.5) * outer / kSteps;
        sum += fallOff(std::cos(angle), inner, outer) * std::sin(angle);
    }
    return candela * 2 * pi * sum * outer / kSteps;
}

TEST(Photometry, APointSendsItsLumensThroughTheSphere) {
    EXPECT_NEAR(static_cast<double>(pointIntensity(Lumen{ 806 }).value) * 4 * pi, 806, 1e-3);
    EXPECT_FLOAT_EQ(pointPower(pointIntensity(Lumen{ 806 })).value, 806);
    EXPECT_EQ(pointIntensity(Lumen{ 0 }).value, 0);
}

TEST(Photometry, AFocusedSpotSendsItsLumensThroughItsConeWhateverTheCone) {
    for (const float outer : { 0.0002f, 0.01f, 0.04472f, 0.0448f, 0.1f, 0.7f, 1.2f, 1.5707963f }) {
        for (const float share : { 0.0f, 0.3f, 0.9f, 0.999f }) {
            const float inner = outer * share;
            const Candela intensity = focusedSpotIntensity(Lumen{ 1000 }, inner, outer);
            const auto candela = static_cast<double>(intensity.value);
            EXPECT_NEAR(fluxOfSpot(candela, static_cast<double>(inner), static_cast<double>(outer)), 1000, 0.2)
                    << inner << ' ' << outer;
            EXPECT_NEAR(spotPower(intensity, inner, outer).value, 1000, 1e-2f);
        }
    }
}

TEST(Photometry, ANarrowerConeMakesAFocusedSpotBrighterAndLeavesAShadedOneAsItIs) {
    EXPECT_GT(focusedSpotIntensity(Lumen{ 100 }, 0.1f, 0.2f).value,
              focusedSpotIntensity(Lumen{ 100 }, 0.2f, 0.4f).value);
    const Candela shaded = spotIntensity(Lumen{ 100 });
    EXPECT_FLOAT_EQ(shaded.value, static_cast<float>(100 / pi));
    EXPECT_LT(spotPower(shaded, 0.1f, 0.2f).value, spotPower(shaded, 0.2f, 0.4f).value);
    EXPECT_LT(spotPower(shaded, 1.5f, 1.5707963f).value, 200.001f) << "half a sphere of lm / pi is twice the lumens";
}

TEST(Photometry, WattsTimesEfficacyAreLumens) {
    EXPECT_FLOAT_EQ(luminousPower(Watt{ 9 }, LumensPerWatt{ 90 }).value, 810);
    EXPECT_FLOAT_EQ(luminousPower(Watt{ 1 }, efficacy::kGreatest).value, 683);
}

TEST(Photometry, LuxAtADistanceFollowTheInverseSquareLaw) {
    const Candela lamp = intensityFor(Lux{ 500 }, 2);
    EXPECT_FLOAT_EQ(lamp.value, 2000);
    EXPECT_FLOAT_EQ(intensityFor(Lux{ lamp.value / 9 }, 3).value, lamp.value);
}

TEST(PhotometryDeathTest, WhatIsNoQuantityOfLightIsRefusedByName) {
    for (const float bad : { -1.0f, kNaN, kInfinity }) {
        EXPECT_DEATH(pointIntensity(Lumen{ bad }), "finite and >= 0");
        EXPECT_DEATH(spotIntensity(Lumen{ bad }), "finite and >= 0");
        EXPECT_DEATH(pointPower(Candela{ bad }), "finite and >= 0");
        EXPECT_DEATH(luminousPower(Watt{ bad }, efficacy::kLed), "finite and >= 0");
        EXPECT_DEATH(luminousPower(Watt{ 1 }, LumensPerWatt{ bad }), "683|finite and >= 0");
        EXPECT_DEATH(intensityFor(Lux{ 1 }, bad), "at a distance");
        EXPECT_DEATH(intensityFor(Lux{ bad }, 1), "finite and >= 0");
        EXPECT_DEATH(focusedSpotIntensity(Lumen{ 1 }, 0.1f, bad), "0 <= inner < outer");
        EXPECT_DEATH(color::fromTemperature(bad), "1000 to 15 000 kelvin");
        EXPECT_DEATH(color::fromDaylight(bad), "4000 to 25 000 kelvin");
    }
    EXPECT_DEATH(focusedSpotIntensity(Lumen{ 1 }, 0.2f, 0.2f), "0 <= inner < outer");
    EXPECT_DEATH(spotPower(Candela{ 1 }, 0.3f, 0.2f), "0 <= inner < outer");
    EXPECT_DEATH(luminousPower(Watt{ 1 }, LumensPerWatt{ 700 }), "683");
    EXPECT_DEATH(intensityFor(Lux{ 1 }, 0), "at a distance");
    EXPECT_DEATH(color::fromTemperature(999), "1000 to 15 000 kelvin");
    EXPECT_DEATH(color::fromDaylight(3999), "4000 to 25 000 kelvin");
}

// ---- colour temperatures

struct Chromaticity {
    double x, y;
};

/// CIE 1931 chromaticity of linear Rec. 709; the matrix of IEC 61966-2-1.
Chromaticity chromaticityOf(LinearColor color) {
    const double3 c(color);
    const double x = 0.4124564 * c.x + 0.3575761 * c.y + 0.1804375 * c.z;
    const double y = 0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z;
    const double z = 0.0193339 * c.x + 0.1191920 * c.y + 0.9503041 * c.z;
    return { x / (x + y + z), y / (x + y + z) };
}

double lobe(double wavelength, double mean, double below, double above) {
    const double t = (wavelength - mean) / (wavelength < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

/// Planck's law seen by the CIE 1931 observer, whose functions are the lobes of Wyman, Sloan and Shirley 2013.
Chromaticity planck(double kelvin) {
    double x = 0, y = 0, z = 0;
    for (double nm = 380; nm <= 780; nm += 1) {
        const double radiance = std::pow(nm, -5.0) / std::expm1(1.438776877e7 / (nm * kelvin));
        x += radiance * (1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                         0.065 * lobe(nm, 501.1, 20.4, 26.2));
        y += radiance * (0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1));
        z += radiance * (1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8));
    }
    return { x / (x + y + z), y / (x + y + z) };
}

TEST(ColorTemperature, BlackBodiesHaveTheColourOfPlancksLaw) {
    for (float kelvin = 2000; kelvin <= 15'000; kelvin += 250) {
        const Chromaticity found = chromaticityOf(color::fromTemperature(kelvin));
        const Chromaticity expected = planck(static_cast<double>(kelvin));
        EXPECT_NEAR(found.x, expected.x, 4e-3) << kelvin;
        EXPECT_NEAR(found.y, expected.y, 4e-3) << kelvin;
    }
}

TEST(ColorTemperature, IlluminantsHaveTheirPublishedChromaticities) {
    const auto expectNear = [](LinearColor color, Chromaticity expected, double tolerance = 2e-4) {
        const Chromaticity found = chromaticityOf(color);
        EXPECT_NEAR(found.x, expected.x, tolerance);
        EXPECT_NEAR(found.y, expected.y, tolerance);
    };
    expectNear(color::fromTemperature(2855.5f), { 0.44758, 0.40745 }, 4e-4); // A, of Krystek's fit
    expectNear(color::fromDaylight(5003), { 0.34567, 0.35850 });             // D50
    expectNear(color::fromDaylight(5503), { 0.33242, 0.34743 });             // D55
    expectNear(color::fromDaylight(6504), { 0.31271, 0.32902 });             // D65
    expectNear(color::fromDaylight(7504), { 0.29902, 0.31485 });             // D75
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(color::fromDaylight(6504)[c], 1, 2e-3) << "the white of Rec. 709";
}

TEST(ColorTemperature, EveryTemperatureIsAColourOfLuminanceOne) {
    const auto expectColor = [](LinearColor color, float kelvin) {
        EXPECT_NEAR(color::luminance(color), 1, 1e-5f) << kelvin;
        EXPECT_GE(std::min({ color.x, color.y, color.z }), 0.0f) << kelvin;
    };
    for (float kelvin = 1000; kelvin <= 15'000; kelvin += 50) expectColor(color::fromTemperature(kelvin), kelvin);
    for (float kelvin = 4000; kelvin <= 25'000; kelvin += 50) expectColor(color::fromDaylight(kelvin), kelvin);
    const LinearColor below = color::fromDaylight(7000), above = color::fromDaylight(7000.01f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(below[c], above[c], 2e-3f) << "the two polynomials meet at 7000 kelvin";
}

} // namespace
} // namespace filament_core
