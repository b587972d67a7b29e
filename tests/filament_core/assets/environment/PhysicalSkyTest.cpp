// SPDX-License-Identifier: Apache-2.0
// The sky of SkyDesc: photometry and colours of daylight, limits of its options, equal bits.
#include "filament_core/assets/environment/PhysicalSky.h"
#include "filament_core/assets/environment/Atmosphere.h"
#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/environment/SkyGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::assets {
namespace {

using std::numbers::pi;
constexpr double kRadiansOfDegree = pi / 180;

float3 towardsSun(double degrees) {
    return float3(0.6 * std::cos(degrees * kRadiansOfDegree), std::sin(degrees * kRadiansOfDegree),
                  0.8 * std::cos(degrees * kRadiansOfDegree));
}

class PhysicalSkyTest : public ::testing::Test {
protected:
    PhysicalSky sky(SkyDesc const& desc) { return makePhysicalSky(desc, mJobs).value(); }
    jobs::JobSystem mJobs{ { .workers = 1 } };
};

/// Of a level surface, in klx.
double skyIlluminance(HdrImage& panorama) {
    const SkyGrid grid(panorama, SkyLayout::Panorama);
    double sum = 0;
    for (size_t i = 0; i < panorama.pixels.size() / 2; ++i)
        sum += skyLuminance(panorama.pixels[i]) * grid.solidAngle(i) * grid.direction(i).y;
    return sum;
}

/// McCamy 1992, from linear Rec. 709.
double temperature(float3 rgb) {
    const double r = rgb.x, g = rgb.y, b = rgb.z;
    const double X = 0.4124 * r + 0.3576 * g + 0.1805 * b, Y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const double Z = 0.0193 * r + 0.1192 * g + 0.9505 * b, x = X / (X + Y + Z), y = Y / (X + Y + Z);
    const double n = (x - 0.3320) / (0.1858 - y);
    return 449 * n * n * n + 3525 * n * n + 6823.3 * n + 5520.33;
}

// Illuminances of clear days: 90 to 110 klx of sun; IES's clear sky has 15 klx around a high sun, and haze adds to it
// what it takes from the sun.
TEST_F(PhysicalSkyTest, SunAndSkyHaveTheIlluminanceOfClearDays) {
    for (const float turbidity : { 2.0f, 3.0f }) {
        for (const double degrees : { 60.0, 90.0 }) {
            PhysicalSky made = sky({ .directionToSun = towardsSun(degrees), .turbidity = turbidity, .height = 64 });
            ASSERT_EQ(made.lights.count, 1u);
            const double sun = skyLuminance(made.lights.lights[0].illuminance), around = skyIlluminance(made.panorama);
            EXPECT_NEAR(sun, turbidity < 2.5f ? 102 : 91, 4) << degrees;
            EXPECT_NEAR(around, turbidity < 2.5f ? 18 : 26, 2) << degrees;
            const double kelvin = temperature(made.lights.lights[0].illuminance);
            EXPECT_TRUE(kelvin > 5000 && kelvin < 5500) << kelvin << " K, the sun of CIE's daylight";
        }
    }
}

// Clear skies have 9000 to 30'000 K around the zenith, the low sun has 2000 to 3000 K, the sky opposite of it 4000 to
// 7000 K. Civil twilight begins with a few hundred lux and ends with about 3; nautical twilight ends near 0.01.
TEST_F(PhysicalSkyTest, ColoursAreThoseOfDaylightAndTwilight) {
    for (const double degrees : { 60.0, 20.0 }) {
        const PhysicalSky made = sky({ .directionToSun = towardsSun(degrees), .height = 64 });
        const double kelvin = temperature(made.panorama.at(0, 0));
        EXPECT_TRUE(kelvin > 9000 && kelvin < 30'000) << degrees << ": " << kelvin;
    }
    const PhysicalSky low = sky({ .directionToSun = towardsSun(5), .height = 64 });
    const double sun = temperature(low.lights.lights[0].illuminance), opposite = temperature(low.panorama.at(100, 29));
    EXPECT_TRUE(sun > 1600 && sun < 3000) << sun;
    EXPECT_TRUE(opposite > 4000 && opposite < 7000) << opposite;
    double before = 1e9;
    constexpr double kTwilight[][3] = { { 0, 400, 1500 }, { -6, 1, 15 }, { -10, 0.01, 1 }, { -18, 0, 1e-3 } };
    for (auto const& [degrees, least, most] : kTwilight) {
        PhysicalSky made = sky({ .directionToSun = towardsSun(degrees), .height = 64 });
        const double lux = 1000 * skyIlluminance(made.panorama);
        EXPECT_TRUE(lux >= least && lux <= most && lux < before) << degrees << ": " << lux;
        before = lux;
    }
}

TEST_F(PhysicalSkyTest, AnyNumberOfWorkersGivesTheSameBits) {
    const SkyDesc desc{ .directionToSun = towardsSun(7), .turbidity = 4, .altitudeMeters = 800, .height = 32 };
    const PhysicalSky one = sky(desc);
    for (const int workers : { 2, 7 }) {
        jobs::JobSystem jobs{ { .workers = workers } };
        const PhysicalSky other = makePhysicalSky(desc, jobs).value();
        EXPECT_EQ(one.panorama.pixels, other.panorama.pixels);
        EXPECT_EQ(one.lights.lights[0].illuminance, other.lights.lights[0].illuminance);
        EXPECT_EQ(physicalFog(desc, mJobs).value(), physicalFog(desc, jobs).value());
    }
}

TEST_F(PhysicalSkyTest, IsFiniteAtTheLimitsOfItsOptions) {
    for (const float altitude : { 0.0f, 50'000.0f }) {
        for (const float edge : { 0.0f, 1.0f }) {
            for (const double degrees : { -18.0, 0.0, 90.0 }) {
                const SkyDesc desc{ .directionToSun = 1e-3f * towardsSun(degrees),
                                    .turbidity = 1 + 9 * edge,
                                    .groundAlbedo = float3(edge),
                                    .altitudeMeters = altitude,
                                    .height = 16 };
                const PhysicalSky made = sky(desc);
                for (const float3 pixel : made.panorama.pixels)
                    for (int i = 0; i < 3; ++i) ASSERT_TRUE(pixel[i] >= 0 && pixel[i] < 1e4f) << degrees << pixel[i];
                const Fog fog = physicalFog(desc, mJobs).value();
                EXPECT_TRUE(fog.density >= 0 && fog.density < 1 && fog.heightFalloff > 0 && fog.heightFalloff < 1);
                EXPECT_TRUE(fog.color.x >= 0 && fog.color.x < 1e3f);
            }
        }
    }
}

TEST_F(PhysicalSkyTest, TheSunSetsOverItsDiameterAndIsThenNoLight) {
    float before = 1e9f;
    for (const double degrees : { 0.5, 0.2, 0.0, -0.2 }) {
        const EnvironmentLights lights = sky({ .directionToSun = towardsSun(degrees), .height = 16 }).lights;
        ASSERT_EQ(lights.count, 1u);
        EXPECT_LT(lights.lights[0].illuminance.x, before);
        EXPECT_TRUE(lights.lights[0].showsDisc);
        before = lights.lights[0].illuminance.x;
    }
    EXPECT_EQ(sky({ .directionToSun = towardsSun(-0.3), .height = 16 }).lights.count, 0u);
    // From 50 km up the horizon is 7.2 degrees lower.
    EXPECT_EQ(sky({ .directionToSun = towardsSun(-6), .altitudeMeters = 50'000, .height = 16 }).lights.count, 1u);
}

TEST_F(PhysicalSkyTest, ErrorsNameTheOptionAndItsRange) {
    const auto error = [&](SkyDesc const& desc) {
        const Result<PhysicalSky> made = makePhysicalSky(desc, mJobs);
        EXPECT_FALSE(made);
        return made ? std::string() : made.error().message;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error({ .directionToSun = float3(0) }), "the directionToSun (0, 0, 0) of a sky has no direction");
    EXPECT_EQ(error({ .directionToSun = float3(1, -1, 0) }),
              "the directionToSun of a sky is at -45.00 degrees, not in [-18, 90]");
    EXPECT_EQ(error({ .turbidity = 0.5f }), "the turbidity 0.5 of a sky is not in [1, 10]");
    EXPECT_EQ(error({ .turbidity = nan }), "the turbidity nan of a sky is not in [1, 10]");
    EXPECT_EQ(error({ .groundAlbedo = float3(0, 2, 0) }), "the groundAlbedo 2 of a sky is not in [0, 1]");
    EXPECT_EQ(error({ .altitudeMeters = -1 }), "the altitudeMeters -1 of a sky is not in [0, 50000]");
    EXPECT_EQ(error({ .height = 17 }), "the height 17 of a sky is not an even number in [16, 2048]");
}

/// Luminances of a level ray, the mean over all azimuths.
struct LevelRay {
    double kept = 0, scattered = 0;
};

LevelRay levelRay(Atmosphere const& air, double3 sun, double meters) {
    LevelRay ray;
    constexpr int kAround = 24;
    for (int i = 0; i < kAround; ++i) {
        const double azimuth = pi * (i + 0.5) / kAround;
        const double3 d(std::cos(azimuth), 0, std::sin(azimuth));
        const ScatteredLight light = scatteredLight(air, kGroundRadius, d, sun, meters);
        const double between = glm::dot(d, sun);
        Spectrum sum, one;
        for (size_t k = 0; k < kBands; ++k)
            sum[k] = light.rayleigh[k] * rayleighPhase(between) + light.mie[k] * miePhase(between) + light.further[k];
        one.fill(1);
        ray.scattered += skyLuminance(float3(rgbOf(sum))) / kAround;
        ray.kept += skyLuminance(float3(rgbOf(light.transmittance))) / skyLuminance(float3(rgbOf(one))) / kAround;
    }
    return ray;
}

// Fog keeps what the air keeps. Its light is right in the middle of the range: near the camera it has up to 36 % too
// much under a high sun and 8 % under a low one, at 20 km 41 % and 15 % too little.
TEST_F(PhysicalSkyTest, FogIsTheAirAlongLevelRays) {
    for (const float turbidity : { 2.0f, 3.0f }) {
        const Atmosphere air = makeAtmosphere({ .turbidity = turbidity }, mJobs);
        for (const double degrees : { 60.0, 10.0 }) {
            const Fog fog =
                    physicalFog({ .directionToSun = towardsSun(degrees), .turbidity = turbidity }, mJobs).value();
            const double3 sun(std::cos(degrees * kRadiansOfDegree), std::sin(degrees * kRadiansOfDegree), 0);
            for (const double meters : { 100.0, 1e3, 5e3, 20e3 }) {
                const LevelRay ray = levelRay(air, sun, meters);
                const double kept = std::exp(-double(fog.density) * meters);
                EXPECT_NEAR(kept, ray.kept, 0.01) << turbidity << ", " << degrees << ", " << meters;
                const double light = skyLuminance(fog.color) * (1 - kept), bound = degrees > 30 ? 0.41 : 0.15;
                EXPECT_NEAR(light, ray.scattered, bound * ray.scattered)
                        << turbidity << ", " << degrees << ", " << meters;
            }
        }
    }
}

// The density falls off with height as the optical depth of the air along a vertical ray does, near the ground.
TEST_F(PhysicalSkyTest, FogThinsOutWithHeight) {
    const SkyDesc desc{ .turbidity = 3 };
    const Fog ground = physicalFog(desc, mJobs).value();
    SkyDesc above = desc;
    above.altitudeMeters = 300;
    const Fog higher = physicalFog(above, mJobs).value();
    EXPECT_NEAR(double(higher.density), double(ground.density) * std::exp(-300 * double(ground.heightFalloff)),
                0.01 * double(ground.density));
}

} // namespace
} // namespace filament_core::assets
