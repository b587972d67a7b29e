// SPDX-License-Identifier: Apache-2.0
// The path tracer's fog, which sums up the density, against the engine's closed form.
#include "tools/reference/FogMedium.h"
#include "shaders/lib/LibCppDouble.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

TEST(FogMedium, IsAsOpaqueAsTheClosedForm) {
    for (const float falloff : { 0.0f, 0.3f, 20.0f }) {
        const Fog fog{ .enabled = true,
                       .density = 0.4f,
                       .startMeters = 0.5f,
                       .heightMeters = -1,
                       .heightFalloff = falloff,
                       .color = float3(1, 0, 0) };
        const FogMedium medium(fog, 0.25, { .ambient = 2 });
        for (const double rise : { -0.9, -0.01, 0.0, 0.2, 1.0 }) {
            for (const double distance : { 0.1, 3.0, 1e4, std::numeric_limits<double>::infinity() }) {
                const double3 direction(std::sqrt(1 - rise * rise), rise, 0);
                const double logDensity = std::log(double(fog.density)) - double(falloff) * 1.25;
                const double depth = lib::fogOpticalDepth(logDensity, double(falloff), rise, 0.5,
                                                          std::min(distance, lib::kFogInfinity));
                const double3 seen = medium.inFront(double3(0, 1, 0), double3(1), direction, distance);
                EXPECT_NEAR(seen.x, 2 * lib::fogOpacity(depth, 1.0), 5e-4) << falloff << ' ' << rise << ' ' << distance;
                EXPECT_NEAR(seen.y, 1 - lib::fogOpacity(depth, 1.0), 3e-4) << falloff << ' ' << rise << ' ' << distance;
            }
        }
    }
}

TEST(FogMedium, GlowsAroundTheBrightestSunOnly) {
    const Fog fog{ .enabled = true, .density = 1, .color = float3(0), .inScatteringSize = 3 };
    const std::array suns{ SunLight{ .directionWorld = { 0, 0, 1 }, .illuminance = Lux{ 10 } },
                           SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 20 } } };
    const FogMedium medium(fog, 0, { .suns = suns });
    const double everything = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(medium.inFront(double3(1), double3(1), { 0, 0, 1 }, everything).x, 20 * 4 / (2 * 3.14159265), 1e-6);
    EXPECT_EQ(medium.inFront(double3(1), double3(1), { 0, 0, -1 }, everything), double3(0.0));
    EXPECT_EQ(medium.inFront(double3(1), double3(0), { 0, 0, 1 }, everything), double3(0.0)) << "a share of nothing";
    EXPECT_EQ(FogMedium().inFront(double3(0.5), double3(1), { 0, 0, 1 }, 10), double3(0.5)) << "off";
}

/// Red from above, green from below.
std::shared_ptr<const assets::HdrImage> twoHalves() {
    auto image = std::make_shared<assets::HdrImage>(assets::HdrImage{ .width = 64, .height = 32, .pixels = {} });
    for (uint32_t i = 0; i < 64 * 32; ++i) image->pixels.push_back(i < 64 * 16 ? float3(1, 0, 0) : float3(0, 1, 0));
    return image;
}

TEST(FogMedium, TakesItsColourFromTheEnvironmentOfItsDirection) {
    const EnvironmentLight sky(twoHalves(), 100, 0);
    const Fog fog{ .enabled = true, .density = 1, .color = float3(0.5f), .colorFromEnvironment = true };
    const FogMedium medium(fog, 0, { .ambient = 7, .exposure = 0.02, .environment = &sky });
    const double everything = std::numeric_limits<double>::infinity();
    const auto colorTowards = [&](double3 direction) {
        return medium.inFront(double3(0.0), double3(1), direction, everything);
    };
    EXPECT_NEAR(colorTowards({ 0, 1, 0 }).x, 100 * 0.02 * 0.5, 0.03) << "irradiance / pi of a half is its radiance";
    EXPECT_NEAR(colorTowards({ 0, 1, 0 }).y, 0, 0.03);
    EXPECT_NEAR(colorTowards({ 0, -1, 0 }).y, 1, 0.03);
    EXPECT_NEAR(colorTowards({ 1, 0, 0 }).x, 0.5, 0.03) << "half of either";
    const FogMedium without(fog, 0, { .ambient = 7 });
    EXPECT_NEAR(without.inFront(double3(0.0), double3(1), { 0, 1, 0 }, everything).x, 3.5, 1e-9) << "there is none";
}

/// By a fine sum of the density along a ray.
double summedTransmittance(Fog const& fog, double3 origin, double3 direction, double meters) {
    constexpr int kSteps = 4000;
    double depth = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double3 point = origin + direction * (meters * (i + 0.5) / kSteps);
        const double noise = lib::fogNoise(point / double(fog.noiseMeters) + 256.0, double(fog.noiseOctaves), 0.0);
        depth += double(fog.density) * std::exp(-double(fog.heightFalloff) * point.y) *
                 (1 + double(fog.noiseAmplitude) * noise);
    }
    return std::exp(-depth * meters / kSteps);
}

Fog varyingFog(float falloff) {
    return { .enabled = true,
             .density = 0.5f,
             .heightFalloff = falloff,
             .color = float3(0),
             .volumetric = true,
             .attenuatesLight = true,
             .noiseAmplitude = 1,
             .noiseMeters = 0.7f,
             .noiseOctaves = 2 };
}

/// measure(numbers) of independent paths.
template <class Measure>
double meanOf(int count, Measure const& measure) {
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const SampleStream stream(hashOf(7, static_cast<uint64_t>(i)), 0);
        sum += measure(FogNumbers{ &stream, 1 });
    }
    return sum / count;
}

TEST(FogMedium, EstimatesOfVaryingFogHaveTheMeanOfTheSum) {
    constexpr int kPaths = 10'000;
    for (const float falloff : { 0.0f, 0.8f }) {
        const Fog fog = varyingFog(falloff);
        const FogMedium medium(fog, 0, {});
        for (const double rise : { -0.4, 0.0, 0.6 }) {
            const double3 direction(std::sqrt(1 - rise * rise), rise, 0), point(0.3, 0.2, -0.4);
            for (const double distance : { 0.4, 3.0 }) {
                const double left = summedTransmittance(fog, double3(0), direction, distance);
                const double seen = meanOf(kPaths, [&](FogNumbers numbers) {
                    return medium.inFront(double3(1), double3(1), direction, distance, numbers).x;
                });
                EXPECT_NEAR(seen, left, 0.02) << falloff << ' ' << rise << ' ' << distance;
                const double arrives = meanOf(kPaths, [&](FogNumbers numbers) {
                    return medium.shareOnTheWay(point, direction, distance, numbers);
                });
                EXPECT_NEAR(arrives, summedTransmittance(fog, point, direction, distance), 0.02) << falloff;
                const double scattered = meanOf(kPaths, [&](FogNumbers numbers) {
                    const double u = numbers.next();
                    return medium.sample(direction, distance, u, numbers).opacity;
                });
                EXPECT_NEAR(scattered, 1 - left, 0.02) << "all events together";
            }
        }
    }
}

TEST(FogMedium, WeakensLightByTheClosedForm) {
    Fog fog{ .enabled = true, .density = 0.4f, .heightFalloff = 0.5f, .volumetric = true };
    EXPECT_EQ(FogMedium(fog, 2, {}).shareOnTheWay({ 0, 1, 0 }, { 0, 1, 0 }, 5, {}), 1);
    fog.attenuatesLight = true;
    const double density = double(0.4f) * std::exp(-0.5 * 3), all = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(FogMedium(fog, 2, {}).shareOnTheWay({ 0, 1, 0 }, { 0, 1, 0 }, all, {}), std::exp(-density / 0.5), 1e-9);
    EXPECT_NEAR(FogMedium(fog, 2, {}).shareOnTheWay({ 0, 1, 0 }, { 1, 0, 0 }, 5, {}), std::exp(-density * 5), 1e-9);
    EXPECT_EQ(FogMedium(fog, 2, {}).shareOnTheWay({ 0, 1, 0 }, { 1, 0, 0 }, all, {}), 0);
}

} // namespace
} // namespace filament_core::reference
