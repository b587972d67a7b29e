// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/SkyLights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr double kDegreesOfRadian = 180 / std::numbers::pi;
constexpr float kLeastRadiusDegrees = 0.2665f, kMostRadiusDegrees = 20; // the sun's; SunLight::angularRadiusDegrees

/// Sums rows of the sky, each in order, then the rows.
template <class OfPixel>
double sumOver(SkyGrid const& sky, jobs::JobSystem& jobs, OfPixel const& ofPixel) {
    std::vector<double> rows(sky.rows());
    jobs::parallelFor<"sky sums">(jobs, rows.size(), 8, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            for (uint32_t column = 0; column < sky.columns(); ++column)
                rows[row] += ofPixel(column, static_cast<uint32_t>(row));
        }
    });
    double sum = 0;
    for (const double row : rows) sum += row;
    return sum;
}

} // namespace

double meanLuminance(SkyGrid const& sky, jobs::JobSystem& jobs) {
    const double sum = sumOver(sky, jobs, [&](uint32_t column, uint32_t row) {
        return skyLuminance(sky.pixel(sky.indexOf(column, row))) * sky.solidAngle(column, row);
    });
    return sum / (4 * std::numbers::pi);
}

double facingIlluminance(SkyGrid const& sky, std::span<const ExtractedLight> lights, double3 direction,
                         jobs::JobSystem& jobs) {
    double sum = sumOver(sky, jobs, [&](uint32_t column, uint32_t row) {
        const double cosine = std::max(glm::dot(sky.direction(column, row), direction), 0.0);
        return skyLuminance(sky.pixel(sky.indexOf(column, row))) * sky.solidAngle(column, row) * cosine;
    });
    for (ExtractedLight const& light : lights)
        sum += skyLuminance(light.illuminance) * std::max(glm::dot(double3(light.direction), direction), 0.0);
    return sum;
}

void TakenLight::add(double3 lost, double3 direction) {
    illuminance += lost;
    moment += direction * (0.2126 * lost.x + 0.7152 * lost.y + 0.0722 * lost.z);
}

double TakenLight::luminous() const { return 0.2126 * illuminance.x + 0.7152 * illuminance.y + 0.0722 * illuminance.z; }

// The mean squared distance of points of the unit sphere from their mean direction is 2 (1 - length of the mean). A
// disc of radius r has r^2 / 2. A point between four pixels has up to p^2 / 2.
ExtractedLight lightOf(TakenLight const& taken, double pixelSize, double facing) {
    const double luminous = taken.luminous(), length = glm::length(taken.moment);
    const double squared = luminous > 0 ? 2 * std::max(0.0, 1 - length / luminous) : 0;
    const double radius = std::sqrt(2 * std::max(0.0, squared - pixelSize * pixelSize / 2)) * kDegreesOfRadian;
    return { .direction = length > 0 ? float3(taken.moment / length) : float3(0, 1, 0),
             .illuminance = float3(taken.illuminance),
             .angularRadiusDegrees = std::clamp(static_cast<float>(radius), kLeastRadiusDegrees, kMostRadiusDegrees),
             .share = facing > 0 ? std::clamp(static_cast<float>(luminous / facing), 0.0f, 1.0f) : 0.0f };
}

EnvironmentLights takeLights(HdrImage& sky, SkyLayout layout, EnvironmentSun sun, uint32_t most,
                             jobs::JobSystem& jobs) {
    if (sun == EnvironmentSun::Keep) return {};
    const SkyGrid grid(sky, layout);
    EnvironmentLights lights = takeSun(grid, jobs);
    if (sun == EnvironmentSun::Extract) return lights;
    takeRegions(grid, lights, std::clamp(most, 1u, static_cast<uint32_t>(EnvironmentLights::kMost)), jobs);
    std::stable_sort(lights.lights.begin(), lights.lights.begin() + lights.count, [](auto const& a, auto const& b) {
        return skyLuminance(a.illuminance) > skyLuminance(b.illuminance);
    });
    lights.brightest = {};
    lights.search = lights.count > 0 ? SunSearch::Found : SunSearch::Even;
    return lights;
}

} // namespace filament_core::assets
