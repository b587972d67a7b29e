// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SelectLights.h"

#include "base/math/Elementary.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;
using shader::PunctualLight;

/// Square metres that an area shows where it is seen best; 1 for lights that are points.
float extentOf(LightRecord const& light) {
    const float square = light.halfExtent.x * light.halfExtent.y;
    if (!light.isArea()) return 1;
    return light.type == LightRecord::Type::Disc ? 3.14159265f * square : 4 * square;
}

float weight(LightRecord const& light) {
    return light.intensity * extentOf(light) * glm::dot(light.color, float3(0.2126f, 0.7152f, 0.0722f));
}

bool reachesView(LightRecord const& light, ViewSpace const& space) {
    if (light.rangeMeters <= 0) return true;
    return intersectsSphere(space.frustum, float3(light.positionWorld - space.cameraWorld), light.rangeMeters);
}

float contactBit(LightRecord const& light) {
    return light.contactShadows ? static_cast<float>(shader::kContactShadowBit) : 0.0f;
}

// The shader treats the direction towards a sun as a place, and does not attenuate.
PunctualLight furtherSun(LightRecord const& light, float exposure) {
    PunctualLight data{};
    data.positionRange = float4(-light.directionWorld, 0);
    data.colorIntensity = float4(light.color * (light.intensity * exposure), -1);
    data.directionScale = float4(light.directionWorld, 0);
    data.offset = float4(0, 0, contactBit(light), 0);
    return data;
}

float shapeOf(LightRecord const& light) {
    const int twoSided = light.isTwoSided ? shader::kShapeTwoSided : 0;
    if (light.type == LightRecord::Type::Tube) return shader::kShapeTube;
    return static_cast<float>((light.type == LightRecord::Type::Rect ? shader::kShapeRect : shader::kShapeDisc) +
                              twoSided);
}

/// Fills in the half edges; see shader::LightShape. A node with unequal scales turns side and direction towards each
/// other: then the direction stays.
void writeArea(LightRecord const& light, float exposure, PunctualLight& data) {
    float3 x = light.sideWorld * light.halfExtent.x, y(light.halfExtent.y, 0, 0);
    if (light.type != LightRecord::Type::Tube) {
        const float3 up = glm::cross(light.sideWorld, light.directionWorld);
        const float length = glm::length(up);
        y = length > 0 ? up * (light.halfExtent.y / length) : float3(0);
        x = glm::cross(light.directionWorld, length > 0 ? up / length : float3(0)) * light.halfExtent.x;
    }
    data.colorIntensity = float4(light.color * (light.intensity * exposure), shapeOf(light));
    data.directionScale = float4(x, y.x);
    data.offset = float4(y.y, 0, 0, y.z);
}

// The spot's angular falloff as a scale and an offset of the cosine; Lagarde & de Rousiers 2014, section 4.3.
PunctualLight punctualLight(LightRecord const& light, ViewSpace const& space) {
    if (light.type == LightRecord::Type::Sun) return furtherSun(light, space.exposure);
    PunctualLight data{};
    const float range = light.rangeMeters;
    data.positionRange = float4(float3(light.positionWorld - space.cameraWorld), range > 0 ? 1 / (range * range) : 0);
    if (light.isArea()) {
        writeArea(light, space.exposure, data);
        return data;
    }
    const bool spot = light.type == LightRecord::Type::Spot;
    data.colorIntensity = float4(light.color * (light.intensity * space.exposure), spot ? 1 : 0);
    const float cosOuter = elementary::cos(light.outerConeRadians);
    const float cosInner = elementary::cos(std::min(light.innerConeRadians, light.outerConeRadians));
    const float scale = 1 / std::max(1e-3f, cosInner - cosOuter);
    data.directionScale = float4(light.directionWorld, scale);
    data.offset = float4(-cosOuter * scale, 0, contactBit(light), 0);
    return data;
}

/// Of the sun's light, what reaches the camera through fog that falls off with height; under fog without end, none.
float sunThroughFog(shader::FrameUniforms const& frame) {
    const float rate = frame.fogMedium.y * frame.sunDirection.y;
    return rate > 0 ? elementary::exp(-elementary::exp(std::clamp(frame.fogMedium.x, -80.0f, 50.0f)) / rate) : 0.0f;
}

/// Returns the sun of the uniforms, the brightest of those without an image.
LightRecord const* writeSun(shader::FrameUniforms& frame, scene::Lights const& lights, float exposure,
                            ViewCounts& counts) {
    LightRecord const* brightest = nullptr;
    for (LightRecord const& light : lights.records) {
        if (light.type != LightRecord::Type::Sun || light.channels == 0 || light.image) continue;
        ++counts.suns;
        if (!brightest || weight(light) > weight(*brightest)) brightest = &light;
    }
    frame.sunDirection = brightest ? float4(-brightest->directionWorld, 1) : float4(0, 1, 0, 0);
    frame.sunIlluminance = brightest ? float4(brightest->color * (brightest->intensity * exposure), 0) : float4(0);
    frame.fogSunDirection = float4(float3(frame.sunDirection), frame.fogSunDirection.w);
    frame.fogSun = float4(float3(frame.fogSun) * float3(frame.sunIlluminance), frame.fogSun.w);
    if (frame.fogGrid.z > 0 && frame.fogSun.w == 0) frame.fogSun.w = sunThroughFog(frame);
    frame.contactShadows.w = brightest && brightest->contactShadows ? 1.0f : 0.0f;
    return brightest;
}

} // namespace

LightSelector::LightSelector(Arena& arena, scene::Lights const& lights)
        : mLights(lights), mCandidates(arena.arrayForOverwrite<Candidate>(lights.records.size())),
          mChosen(arena.arrayForOverwrite<PunctualLight>(
                  std::min<size_t>(lights.records.size(), shader::kMaxPunctualLights))),
          mRecords(arena.arrayForOverwrite<uint32_t>(mChosen.size())) {}

uint32_t LightSelector::findCandidates(ViewSpace const& space, LightRecord const* sun, ViewCounts& counts) const {
    uint32_t count = 0, areas = 0, profiled = 0, imaged = 0;
    for (uint32_t i = 0; i < mLights.records.size(); ++i) {
        LightRecord const& light = mLights.records[i];
        if (&light == sun || light.intensity <= 0 || light.channels == 0 || extentOf(light) <= 0) continue;
        const bool isSun = light.type == LightRecord::Type::Sun;
        if (!isSun && !reachesView(light, space)) {
            ++counts.lightsOutOfView;
            counts.areaLightsLeftOut += light.isArea() ? 1 : 0;
            counts.profiledLightsLeftOut += light.profile ? 1 : 0;
            counts.imagedLightsLeftOut += light.image ? 1 : 0;
            continue;
        }
        const double3 toLight = light.positionWorld - space.cameraWorld;
        const auto squaredDistance = static_cast<float>(std::max(glm::dot(toLight, toLight), 1e-4));
        const float importance = isSun ? weight(light) : weight(light) / squaredDistance;
        areas += light.isArea() ? 1 : 0;
        profiled += light.profile ? 1 : 0;
        imaged += light.image ? 1 : 0;
        mCandidates[count++] = { i, importance > 0 ? importance : 0.0f }; // colours may be NaN; sorting needs numbers
    }
    counts.areaLightsLeftOut += areas; // until they are chosen
    counts.profiledLightsLeftOut += profiled;
    counts.imagedLightsLeftOut += imaged;
    return count;
}

SelectedLights LightSelector::select(ViewSpace const& space, shader::FrameUniforms& frame, ViewCounts& counts) const {
    LightRecord const* const sun = writeSun(frame, mLights, space.exposure, counts);
    const std::span<Candidate> candidates = mCandidates.first(findCandidates(space, sun, counts));
    const auto isBrighter = [](Candidate const& a, Candidate const& b) {
        return a.importance != b.importance ? a.importance > b.importance : a.index < b.index;
    };
    counts.lights = static_cast<uint32_t>(std::min(candidates.size(), mChosen.size()));
    if (candidates.size() > mChosen.size()) {
        std::ranges::nth_element(candidates, candidates.begin() + counts.lights, isBrighter);
        std::ranges::sort(candidates.first(counts.lights), {}, &Candidate::index); // sums have the order of the scene
    }
    counts.lightsOverLimit = static_cast<uint32_t>(candidates.size()) - counts.lights;
    uint8_t inCommon = sun ? sun->channels : 0xFF;
    for (uint32_t i = 0; i < counts.lights; ++i) {
        mRecords[i] = candidates[i].index;
        LightRecord const& light = mLights.records[mRecords[i]];
        mChosen[i] = punctualLight(light, space);
        inCommon &= light.channels;
        counts.areaLights += light.isArea() ? 1 : 0;
        counts.profiledLights += light.profile ? 1 : 0;
        counts.imagedLights += light.image ? 1 : 0;
        counts.contactLights += light.contactShadows ? 1 : 0;
    }
    counts.areaLightsLeftOut -= counts.areaLights;
    counts.profiledLightsLeftOut -= counts.profiledLights;
    counts.imagedLightsLeftOut -= counts.imagedLights;
    frame.ambient.w = static_cast<float>(counts.lights);
    if (sun && sun->contactShadows) ++counts.contactLights;
    SelectedLights selected{ mChosen.first(counts.lights), mRecords.first(counts.lights), {}, inCommon };
    if (sun) selected.sun = static_cast<uint32_t>(sun - mLights.records.data());
    return selected;
}

} // namespace filament_core::prepare
