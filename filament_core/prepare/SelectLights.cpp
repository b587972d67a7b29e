// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SelectLights.h"

#include <algorithm>
#include <cmath>

namespace filament::prepare {
namespace {

using scene::LightRecord;
using shader::PunctualLight;

float weight(LightRecord const& light) {
    return light.intensity * glm::dot(light.color, float3(0.2126f, 0.7152f, 0.0722f));
}

bool reachesView(LightRecord const& light, ViewSpace const& space) {
    if (light.rangeMeters <= 0) return true;
    return intersectsSphere(space.frustum, float3(light.positionWorld - space.cameraWorld), light.rangeMeters);
}

// The shader treats the direction towards a sun as a place, and does not attenuate.
PunctualLight furtherSun(LightRecord const& light, float exposure) {
    PunctualLight data{};
    data.positionRange = float4(-light.directionWorld, 0);
    data.colorIntensity = float4(light.color * (light.intensity * exposure), -1);
    data.directionScale = float4(light.directionWorld, 0);
    return data;
}

// The spot's angular falloff as a scale and an offset of the cosine; Lagarde & de Rousiers 2014, section 4.3.
PunctualLight punctualLight(LightRecord const& light, ViewSpace const& space) {
    if (light.type == LightRecord::Type::Sun) return furtherSun(light, space.exposure);
    PunctualLight data{};
    const float range = light.rangeMeters;
    data.positionRange = float4(float3(light.positionWorld - space.cameraWorld), range > 0 ? 1 / (range * range) : 0);
    const bool spot = light.type == LightRecord::Type::Spot;
    data.colorIntensity = float4(light.color * (light.intensity * space.exposure), spot ? 1 : 0);
    const float cosOuter = std::cos(light.outerConeRadians);
    const float cosInner = std::cos(std::min(light.innerConeRadians, light.outerConeRadians));
    const float scale = 1 / std::max(1e-3f, cosInner - cosOuter);
    data.directionScale = float4(light.directionWorld, scale);
    data.offset = float4(-cosOuter * scale, 0, 0, 0);
    return data;
}

/// Returns the sun of the uniforms, the brightest.
LightRecord const* writeSun(shader::FrameUniforms& frame, scene::Lights const& lights, float exposure,
                            ViewCounts& counts) {
    LightRecord const* brightest = nullptr;
    for (LightRecord const& light : lights.records) {
        if (light.type != LightRecord::Type::Sun) continue;
        ++counts.suns;
        if (!brightest || weight(light) > weight(*brightest)) brightest = &light;
    }
    frame.sunDirection = brightest ? float4(-brightest->directionWorld, 1) : float4(0, 1, 0, 0);
    frame.sunIlluminance = brightest ? float4(brightest->color * (brightest->intensity * exposure), 0) : float4(0);
    return brightest;
}

} // namespace

LightSelector::LightSelector(Arena& arena, scene::Lights const& lights)
        : mLights(lights), mCandidates(arena.arrayForOverwrite<Candidate>(lights.records.size())),
          mChosen(arena.arrayForOverwrite<PunctualLight>(
                  std::min<size_t>(lights.records.size(), shader::kMaxPunctualLights))) {}

uint32_t LightSelector::findCandidates(ViewSpace const& space, LightRecord const* sun, ViewCounts& counts) const {
    uint32_t count = 0;
    for (uint32_t i = 0; i < mLights.records.size(); ++i) {
        LightRecord const& light = mLights.records[i];
        if (&light == sun || light.intensity <= 0) continue;
        const bool isSun = light.type == LightRecord::Type::Sun;
        if (!isSun && !reachesView(light, space)) {
            ++counts.lightsOutOfView;
            continue;
        }
        const double3 toLight = light.positionWorld - space.cameraWorld;
        const auto squaredDistance = static_cast<float>(std::max(glm::dot(toLight, toLight), 1e-4));
        const float importance = isSun ? weight(light) : weight(light) / squaredDistance;
        mCandidates[count++] = { i, importance > 0 ? importance : 0.0f }; // colours may be NaN; sorting needs numbers
    }
    return count;
}

std::span<const PunctualLight> LightSelector::select(ViewSpace const& space, shader::FrameUniforms& frame,
                                                     ViewCounts& counts) const {
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
    for (uint32_t i = 0; i < counts.lights; ++i)
        mChosen[i] = punctualLight(mLights.records[candidates[i].index], space);
    frame.ambient.w = static_cast<float>(counts.lights);
    return mChosen.first(counts.lights);
}

} // namespace filament::prepare
