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

} // namespace
} // namespace filament_core::reference
