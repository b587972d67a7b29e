// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/DirectLights.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>
#include <cmath>

namespace filament::reference {
namespace {

namespace lib = shader::lib64;

double inverseSquare(float range) { return range > 0 ? 1 / (double(range) * range) : 0; }

} // namespace

DirectLights::DirectLights(std::vector<SunLight> const& suns, std::vector<PointLight> const& points,
                           std::vector<SpotLight> const& spots, double factor) {
    const auto scaled = [&](LinearColor color, float value) { return double3(color) * (double(value) * factor); };
    for (SunLight const& sun : suns) {
        mLights.push_back({ .isSun = true,
                            .axis = glm::normalize(double3(sun.directionWorld)),
                            .intensity = scaled(sun.color, sun.illuminance.value) });
    }
    for (PointLight const& point : points) {
        mLights.push_back({ .position = point.positionWorld,
                            .intensity = scaled(point.color, point.intensity.value),
                            .inverseSquaredRange = inverseSquare(point.rangeMeters) });
    }
    for (SpotLight const& spot : spots) {
        // KHR_lights_punctual, with the engine's minimum difference of the cosines.
        const double cosOuter = std::cos(double(spot.outerConeRadians));
        const double cosInner = std::cos(std::min<double>(spot.innerConeRadians, spot.outerConeRadians));
        const double scale = 1 / std::max(1e-3, cosInner - cosOuter);
        mLights.push_back({ .isSpot = true,
                            .position = spot.positionWorld,
                            .axis = glm::normalize(double3(spot.directionWorld)),
                            .intensity = scaled(spot.color, spot.intensity.value),
                            .inverseSquaredRange = inverseSquare(spot.rangeMeters),
                            .spotScale = scale,
                            .spotOffset = -cosOuter * scale });
    }
}

DirectSample DirectLights::arriving(Light const& light, double3 position) {
    if (light.isSun) return { -light.axis, light.intensity };
    const double3 toLight = light.position - position;
    const double distance = glm::length(toLight);
    if (!(distance > 0)) return {};
    const double3 direction = toLight / distance;
    double attenuation = lib::distanceAttenuation(toLight, light.inverseSquaredRange);
    if (light.isSpot) {
        attenuation *= lib::spotAttenuation(direction, light.axis, light.spotScale, light.spotOffset);
    }
    return { direction, light.intensity * attenuation, distance };
}

DirectSample DirectLights::sample(double3 position, double u) const {
    const auto weightOf = [&](Light const& light) { return lib::luminance(arriving(light, position).illuminance); };
    if (mLights.size() == 1) return arriving(mLights.front(), position);
    double total = 0;
    for (Light const& light : mLights) total += weightOf(light);
    double remaining = u * total;
    DirectSample chosen;
    for (Light const& light : mLights) {
        const double weight = weightOf(light);
        if (weight <= 0) continue;
        chosen = arriving(light, position);
        chosen.illuminance *= total / weight;
        remaining -= weight;
        if (remaining < 0) break; // rounding may leave a rest: then the last light that shines
    }
    return chosen;
}

} // namespace filament::reference
