// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SunDiscs.h"

#include "base/math/Elementary.h"
#include "filament_core/prepare/DarkLights.h"
#include "filament_core/prepare/ViewConstants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;

constexpr double kSmallestRadius = 1.745329252e-5; // tangent of 0.001 degrees
constexpr double kMostPixels = 1e6;                // from the screen to a sun that pixels are counted from
constexpr float kBrightestDisc = 1e30f;            // a finite number, whatever the light

bool hasDisc(LightRecord const& light) {
    return light.type == LightRecord::Type::Sun && light.showsDisc && light.channels != 0 && light.intensity > 0;
}

/// 1 - cos of an angle by its tangent.
double versineOfTangent(double tangent) {
    const double secant = std::sqrt(1 + tangent * tangent);
    return tangent * tangent / (secant * (1 + secant));
}

/// Of the halo, or of the disc if there is none; radians.
double outerRadius(LightRecord const& light, double tangent) {
    return std::min(elementary::atan(tangent) * static_cast<double>(light.haloSize), std::numbers::pi);
}

/// Whether a cone of directions may be in view; not exact at the corners.
bool mayBeSeen(ViewSpace const& space, float3 axis, double radius) {
    if (radius >= std::numbers::pi / 2) return true;
    const auto reach = static_cast<float>(elementary::sin(radius) + 1e-6); // floats on both sides
    return std::ranges::all_of(space.frustum.planes,
                               [&](float4 const& plane) { return glm::dot(float3(plane), axis) >= -reach; });
}

/// View rays of a camera, in view space: first + x right + y down, in pixels.
struct PixelRays {
    double3 first, right, down;
    double2 size;

    PixelRays(ViewSpace const& space, uint2 pixels) : size(pixels) {
        const double4x4 clip(space.clipFromView);
        first = { (clip[2][0] - 1) / clip[0][0], (clip[2][1] - 1) / clip[1][1], -1 };
        right = { 2 / (size.x * clip[0][0]), 0, 0 };
        down = { 0, 2 / (size.y * clip[1][1]), 0 };
    }

    double3 at(double2 pixel) const { return first + right * pixel.x + down * pixel.y; }

    /// The pixel nearest to a direction that floats can count from: the image centre if it is far away.
    float2 pixelOf(double3 direction) const {
        const double2 middle = size * 0.5;
        if (!(direction.z < 0)) return float2(middle);
        const double3 ray = direction / -direction.z;
        const double2 pixel((ray.x - first.x) / right.x, (ray.y - first.y) / down.y);
        const double2 away = glm::abs(pixel - middle);
        return std::max(away.x, away.y) < kMostPixels ? float2(pixel) : float2(middle);
    }
};

SunDisc discOf(LightRecord const& light, ViewSpace const& space, ViewInput const& view) {
    const double3x3 viewFromWorld = glm::transpose(double3x3(view.camera.worldFromView));
    const double3 sun = viewFromWorld * glm::normalize(-double3(light.directionWorld));
    const double3 side = glm::normalize(glm::cross(sun, std::abs(sun.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0)));
    const double3x3 discFromView = glm::transpose(double3x3(side, glm::cross(sun, side), sun));
    const PixelRays rays(space, view.size);
    const float2 pixel = rays.pixelOf(sun);
    const double tangent = std::max(static_cast<double>(light.sourceRadius), kSmallestRadius);
    const double versine = versineOfTangent(tangent), square = tangent * tangent;
    const double luminance = static_cast<double>(light.intensity) * static_cast<double>(space.exposure) /
                             (std::numbers::pi * square / (1 + square));
    const double halfHalo = elementary::sin(outerRadius(light, tangent) / 2);
    const double ofHalo = 2 * halfHalo * halfHalo - versine;
    SunDisc disc{};
    disc.axisX = float4(float3(discFromView * rays.right), pixel.x);
    disc.axisY = float4(float3(discFromView * rays.down), pixel.y);
    disc.axisZ = float4(float3(discFromView * rays.at(double2(pixel))), static_cast<float>(tangent));
    disc.light = float4(glm::min(float3(double3(light.color) * luminance), float3(kBrightestDisc)), light.haloFalloff);
    disc.halo = float4(static_cast<float>(versine), ofHalo > 0 && light.haloSize > 1 ? 1 / ofHalo : 0, 0, 0);
    return disc;
}

} // namespace

SunDiscs findSunDiscs(Arena& arena, scene::Lights const& lights, ViewInput const& view) {
    const auto count = static_cast<size_t>(std::ranges::count_if(lights.records, hasDisc));
    if (count == 0) return {};
    const ViewSpace space = makeViewSpace(view);
    if (space.clipFromView[3][3] != 0) return { {}, static_cast<uint32_t>(count) }; // parallel: one direction is seen
    const std::span<SunDisc> discs = arena.array<SunDisc>(count);
    size_t seen = 0;
    for (LightRecord const& light : lights.records) {
        if (!hasDisc(light)) continue;
        const double tangent = std::max(static_cast<double>(light.sourceRadius), kSmallestRadius);
        if (!mayBeSeen(space, -light.directionWorld, outerRadius(light, tangent))) continue;
        discs[seen] = discOf(light, space, view);
        if (isDark(view, static_cast<size_t>(&light - lights.records.data())))
            discs[seen].light = float4(0, 0, 0, discs[seen].light.w);
        ++seen;
    }
    return { discs.first(seen), static_cast<uint32_t>(count - seen) };
}

} // namespace filament_core::prepare
