// SPDX-License-Identifier: Apache-2.0
#include <filament_core/EnvironmentLights.h>

#include "base/math/Elementary.h"

#include <filament_core/LoadOptions.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core {
namespace {

constexpr double kDegreesOfRadian = 180 / std::numbers::pi;
constexpr double kMostLux = 1e12; // of SunLight::illuminance
constexpr LightChannels kEveryChannel = 0xFF;

double luminousIlluminance(ExtractedLight const& light) {
    const double3 e(light.illuminance);
    return 0.2126 * e.x + 0.7152 * e.y + 0.0722 * e.z;
}

/// The rotation about +Y that shaders apply to the environment.
double3 worldFromEnvironment(double3 d, float rotationRadians) {
    const double angle = static_cast<double>(rotationRadians), c = elementary::cos(angle), s = elementary::sin(angle);
    return { c * d.x + s * d.z, d.y, c * d.z - s * d.x };
}

std::string placeOf(ExtractedLight const& light, EnvironmentSettings const& settings) {
    const double3 d = worldFromEnvironment(double3(light.direction), settings.rotationRadians);
    const double elevation = elementary::asin(std::clamp(d.y, -1.0, 1.0)) * kDegreesOfRadian;
    const double azimuth = elementary::atan2(d.x, d.z) * kDegreesOfRadian;
    return fmt::format(
            "elevation {:.2f} degrees, azimuth {:.2f} degrees from +z to +x, radius {:.2f} degrees, {:.1f} % "
            "of the light of a surface that faces it",
            elevation, azimuth, light.angularRadiusDegrees, 100 * light.share);
}

} // namespace

SunLight sunLightOf(ExtractedLight const& light, EnvironmentSettings const& settings) {
    const double luminous = luminousIlluminance(light);
    const double3 color = luminous > 0 ? double3(light.illuminance) / luminous : double3(1.0);
    const double lux = luminous * static_cast<double>(settings.illuminance.value);
    return { .directionWorld = -float3(worldFromEnvironment(double3(light.direction), settings.rotationRadians)),
             .illuminance = Lux{ static_cast<float>(std::clamp(lux, 0.0, kMostLux)) },
             .color = float3(color),
             .angularRadiusDegrees = light.angularRadiusDegrees,
             .showsDisc = light.showsDisc,
             .haloSize = light.showsDisc ? 1.0f : SunLight{}.haloSize,
             .lightChannels = kEveryChannel };
}

std::string explain(EnvironmentLights const& lights, EnvironmentSettings const& settings) {
    const std::string region = placeOf(lights.brightest, settings);
    std::string text;
    switch (lights.search) {
    case SunSearch::Off:
        return {};
    case SunSearch::Found:
        for (ExtractedLight const& light : lights.found())
            text += fmt::format("light: {:.5g} lx, {}\n", sunLightOf(light, settings).illuminance.value,
                                placeOf(light, settings));
        return text;
    case SunSearch::Wide:
        return fmt::format("no sun: the brightest region is wider than {} degrees: {}\n",
                           2 * EnvironmentLights::kWidestSunDegrees, region);
    case SunSearch::Dim:
        return fmt::format("no sun: the brightest spot gives less than {:.0f} %: {}\n",
                           100 * EnvironmentLights::kLeastSunShare, region);
    case SunSearch::Even:
        return "no light: no region is much brighter than the others\n";
    case SunSearch::Baked:
        break;
    }
    return "no light: the package was baked without; bake it again with cmgen --sun\n";
}

} // namespace filament_core
