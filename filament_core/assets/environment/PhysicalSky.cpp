// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/PhysicalSky.h"

#include "base/math/Elementary.h"
#include "filament_core/assets/environment/Atmosphere.h"
#include "filament_core/assets/environment/SkyLights.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace filament_core::assets {
namespace {

using std::numbers::pi;
constexpr double kLowestSunDegrees = -18;
constexpr size_t kAzimuths = 17; // from the sun to opposite of it
constexpr uint32_t kSkyRowsPerJob = 4;
constexpr double kFogDepth = 1, kFogMeters = 20e3; // fog has the colour of the air at that optical depth, or nearer

Result<void> checkSun(float3 sun) {
    const double length = glm::length(double3(sun));
    if (!(length > 0 && std::isfinite(length)))
        return fail(ErrorCode::InvalidArgument, "the directionToSun ({}, {}, {}) of a sky has no direction", sun.x,
                    sun.y, sun.z);
    const double degrees = elementary::asin(std::clamp(sun.y / length, -1.0, 1.0)) * 180 / pi;
    // A direction in single precision is a little off.
    if (degrees < kLowestSunDegrees - 1e-4)
        return fail(ErrorCode::InvalidArgument, "the directionToSun of a sky is at {:.2f} degrees, not in [-18, 90]",
                    degrees);
    return {};
}

Result<void> checkSky(SkyDesc const& desc) {
    if (Result<void> sun = checkSun(desc.directionToSun); !sun) return sun;
    if (!(desc.turbidity >= 1 && desc.turbidity <= 10))
        return fail(ErrorCode::InvalidArgument, "the turbidity {} of a sky is not in [1, 10]", desc.turbidity);
    for (int i = 0; i < 3; ++i)
        if (!(desc.groundAlbedo[i] >= 0 && desc.groundAlbedo[i] <= 1))
            return fail(ErrorCode::InvalidArgument, "the groundAlbedo {} of a sky is not in [0, 1]",
                        desc.groundAlbedo[i]);
    if (!(desc.altitudeMeters >= 0 && desc.altitudeMeters <= 50'000))
        return fail(ErrorCode::InvalidArgument, "the altitudeMeters {} of a sky is not in [0, 50000]",
                    desc.altitudeMeters);
    if (desc.height < 16 || desc.height > 2048 || desc.height % 2 != 0)
        return fail(ErrorCode::InvalidArgument, "the height {} of a sky is not an even number in [16, 2048]",
                    desc.height);
    return {};
}

double radiusOf(SkyDesc const& desc) { return kGroundRadius + double(desc.altitudeMeters); }

Atmosphere atmosphereOf(SkyDesc const& desc, jobs::JobSystem& jobs) {
    return makeAtmosphere({ .turbidity = desc.turbidity, .groundAlbedo = desc.groundAlbedo }, jobs);
}

/// What pixels of a row share, as colours.
struct Column {
    double3 rayleigh{ 0.0 }, mie{ 0.0 }, further{ 0.0 };
};
using Row = std::array<Column, kAzimuths>;

Column mixed(Row const& row, std::array<size_t, 4> at, std::array<double, 4> weights) {
    Column sum;
    for (size_t i = 0; i < 4; ++i) {
        sum.rayleigh += row[at[i]].rayleigh * weights[i];
        sum.mie += row[at[i]].mie * weights[i];
        sum.further += row[at[i]].further * weights[i];
    }
    return sum;
}

/// `azimuth` away from the sun, [0, pi]. Catmull and Rom's spline; both ends are mirrors.
Column columnAt(Row const& row, double azimuth) {
    constexpr size_t kLast = kAzimuths - 1;
    const double at = azimuth / pi * kLast;
    const size_t i = std::min(static_cast<size_t>(at), kLast - 1);
    const double t = at - static_cast<double>(i), t2 = t * t, t3 = t2 * t;
    return mixed(row, { i == 0 ? 1 : i - 1, i, i + 1, i + 1 == kLast ? kLast - 1 : i + 2 },
                 { (-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2 });
}

struct View {
    Atmosphere const& air;
    double radius;
    double3 sun; // unit
};

Row rowAt(View const& view, double polar) {
    const double sine = elementary::sin(polar), cosine = elementary::cos(polar);
    const double3 sun(std::sqrt(std::max(0.0, 1 - view.sun.y * view.sun.y)), view.sun.y, 0);
    Row row;
    for (size_t i = 0; i < kAzimuths; ++i) {
        const double azimuth = pi * static_cast<double>(i) / (kAzimuths - 1);
        const double3 direction(sine * elementary::cos(azimuth), cosine, sine * elementary::sin(azimuth));
        const ScatteredLight light = scatteredLight(view.air, view.radius, direction, sun);
        row[i] = { rgbOf(light.rayleigh), rgbOf(light.mie), rgbOf(light.further) };
    }
    return row;
}

HdrImage panoramaOf(View const& view, uint32_t height, jobs::JobSystem& jobs) {
    HdrImage image{ .width = height * 2, .height = height, .pixels = {}, .repairs = {} };
    image.pixels.resize(size_t(image.width) * image.height);
    const double sunAzimuth = elementary::atan2(view.sun.x, view.sun.z);
    std::vector<double> away(image.width), cosines(image.width); // in azimuth
    for (uint32_t x = 0; x < image.width; ++x) {
        const double azimuth = (0.5 - (x + 0.5) / image.width) * 2 * pi, turn = std::fabs(azimuth - sunAzimuth);
        away[x] = std::clamp(std::min(turn, 2 * pi - turn), 0.0, pi);
        cosines[x] = elementary::cos(away[x]);
    }
    const double sunSine = std::sqrt(std::max(0.0, 1 - view.sun.y * view.sun.y));
    jobs::parallelFor<"sky">(jobs, height, kSkyRowsPerJob, [&](size_t begin, size_t end) {
        for (auto y = static_cast<uint32_t>(begin); y < end; ++y) {
            const double polar = (y + 0.5) / height * pi;
            const double sine = elementary::sin(polar), cosine = elementary::cos(polar);
            const Row row = rowAt(view, polar);
            for (uint32_t x = 0; x < image.width; ++x) {
                const Column at = columnAt(row, away[x]);
                const double between = std::clamp(sine * sunSine * cosines[x] + cosine * view.sun.y, -1.0, 1.0);
                const double3 sum = at.rayleigh * rayleighPhase(between) + at.mie * miePhase(between) + at.further;
                image.at(x, y) = float3(glm::max(sum, double3(0.0)));
            }
        }
    });
    return image;
}

/// klx.
double3 sunIlluminance(View const& view) {
    return glm::max(rgbOf(sunlight(view.air, view.radius, view.sun.y)), double3(0.0));
}

EnvironmentLights lightsOf(View const& view, HdrImage& panorama, bool showsDisc, jobs::JobSystem& jobs) {
    EnvironmentLights lights;
    lights.search = SunSearch::Even;
    const double3 illuminance = sunIlluminance(view);
    const double own = glm::dot(illuminance, double3(0.2126, 0.7152, 0.0722));
    if (!(own > 0)) return lights;
    ExtractedLight& sun = lights.lights[0];
    sun.direction = float3(view.sun);
    sun.illuminance = float3(illuminance);
    sun.showsDisc = showsDisc;
    const SkyGrid grid(panorama, SkyLayout::Panorama);
    const double sky = facingIlluminance(grid, {}, view.sun, jobs);
    sun.share = static_cast<float>(own / (own + sky));
    lights.count = 1;
    lights.search = SunSearch::Found;
    return lights;
}

} // namespace

Result<PhysicalSky> makePhysicalSky(SkyDesc const& desc, jobs::JobSystem& jobs) {
    if (Result<void> checked = checkSky(desc); !checked) return checked.error();
    const Atmosphere air = atmosphereOf(desc, jobs);
    const View view{ air, radiusOf(desc), glm::normalize(double3(desc.directionToSun)) };
    PhysicalSky sky;
    sky.panorama = panoramaOf(view, desc.height, jobs);
    sky.lights = lightsOf(view, sky.panorama, desc.showsDisc, jobs);
    return sky;
}

Result<EnvironmentData> bakePhysicalSky(SkyDesc const& desc, jobs::JobSystem& jobs, EnvironmentOptions options) {
    Result<PhysicalSky> sky = makePhysicalSky(desc, jobs);
    if (!sky) return sky.error();
    options.sun = EnvironmentSun::Keep; // it is not in the panorama
    Result<EnvironmentData> data = bakeEnvironment(sky->panorama, jobs, options);
    if (data) data->lights = sky->lights;
    return data;
}

Result<Fog> physicalFog(SkyDesc const& desc, jobs::JobSystem& jobs) {
    if (Result<void> checked = checkSky(desc); !checked) return checked.error();
    const Atmosphere air = atmosphereOf(desc, jobs);
    const View view{ air, radiusOf(desc), glm::normalize(double3(desc.directionToSun)) };
    // Extinction at the camera, and its slope, as the eye weighs the bands.
    const double molecules = elementary::exp(-double(desc.altitudeMeters) / kRayleighHeight);
    const double haze = elementary::exp(-double(desc.altitudeMeters) / kMieHeight);
    const double3 luminance(0.2126, 0.7152, 0.0722);
    double weights = 0, extinction = 0, slope = 0;
    for (size_t k = 0; k < kBands; ++k) {
        const double weight = glm::dot(kBandRgb[k], luminance);
        const double rayleigh = air.medium.rayleigh[k] * molecules, mie = air.medium.mieExtinction[k] * haze;
        weights += weight;
        extinction += weight * (rayleigh + mie);
        slope += weight * (rayleigh / kRayleighHeight + mie / kMieHeight);
    }
    const double density = extinction / weights, meters = std::min(kFogDepth / density, kFogMeters);
    const double opacity = 1 - elementary::exp(-density * meters);
    double3 light(0.0);
    const double sunSine = std::sqrt(std::max(0.0, 1 - view.sun.y * view.sun.y));
    for (size_t i = 0; i < kAzimuths; ++i) {
        const double azimuth = pi * (static_cast<double>(i) + 0.5) / kAzimuths, cosine = elementary::cos(azimuth);
        const double3 direction(cosine, 0, elementary::sin(azimuth));
        const ScatteredLight at = scatteredLight(air, view.radius, direction, { sunSine, view.sun.y, 0 }, meters);
        light += rgbOf(at.rayleigh) * rayleighPhase(cosine * sunSine) + rgbOf(at.mie) * miePhase(cosine * sunSine) +
                 rgbOf(at.further);
    }
    const float3 color(glm::max(light / (double(kAzimuths) * opacity), double3(0.0)));
    return Fog{ .enabled = true,
                .density = static_cast<float>(density),
                .heightFalloff = static_cast<float>(slope / extinction),
                .color = { color.x, color.y, color.z } };
}

} // namespace filament_core::assets
