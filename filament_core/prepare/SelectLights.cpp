// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SelectLights.h"

#include <algorithm>
#include <cmath>

namespace filament::prepare {
namespace {

using scene::LightRecord;
using shader::LightData;

struct Candidate {
    uint32_t index = 0;
    float importance = 0; ///< luminance-weighted intensity over squared distance
};

float weight(LightRecord const& light) {
    return light.intensity * glm::dot(light.color, float3(0.2126f, 0.7152f, 0.0722f));
}

bool reachesView(LightRecord const& light, ViewSpace const& space) {
    if (light.rangeMeters <= 0) return true;
    return intersectsSphere(space.frustum, float3(light.positionWorld - space.cameraWorld), light.rangeMeters);
}

// The spot's angular falloff as a scale and an offset of the cosine; Lagarde & de Rousiers 2014, section 4.3.
LightData lightData(LightRecord const& light, ViewSpace const& space) {
    LightData data{};
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

void writeSun(shader::FrameUniforms& frame, scene::Lights const& lights, float exposure, PacketCounts& counts) {
    LightRecord const* brightest = nullptr;
    for (LightRecord const& light : lights.records) {
        if (light.type != LightRecord::Type::Sun) continue;
        ++counts.suns;
        if (!brightest || weight(light) > weight(*brightest)) brightest = &light;
    }
    frame.sunDirection = brightest ? float4(-brightest->directionWorld, 1) : float4(0, 1, 0, 0);
    frame.sunIlluminance = brightest ? float4(brightest->color * (brightest->intensity * exposure), 0) : float4(0);
}

} // namespace

std::span<const LightData> selectLights(Arena& arena, scene::Lights const& lights, ViewSpace const& space,
                                        shader::FrameUniforms& frame, PacketCounts& counts) {
    writeSun(frame, lights, space.exposure, counts);

    std::span<Candidate> candidates = arena.array<Candidate>(lights.records.size());
    uint32_t count = 0;
    for (uint32_t i = 0; i < lights.records.size(); ++i) {
        LightRecord const& light = lights.records[i];
        if (light.type == LightRecord::Type::Sun || light.intensity <= 0) continue;
        if (!reachesView(light, space)) {
            ++counts.lightsOutOfView;
            continue;
        }
        const double3 toLight = light.positionWorld - space.cameraWorld;
        const auto squaredDistance = static_cast<float>(std::max(glm::dot(toLight, toLight), 1e-4));
        candidates[count++] = { i, weight(light) / squaredDistance };
    }
    if (count > shader::kMaxPunctualLights) {
        std::sort(candidates.begin(), candidates.begin() + count, [](Candidate const& a, Candidate const& b) {
            return a.importance != b.importance ? a.importance > b.importance : a.index < b.index;
        });
        counts.lightsOverLimit = count - shader::kMaxPunctualLights;
        count = shader::kMaxPunctualLights;
    }
    std::span<LightData> chosen = arena.array<LightData>(count);
    for (uint32_t i = 0; i < count; ++i) chosen[i] = lightData(lights.records[candidates[i].index], space);
    counts.lights = count;
    frame.ambient.w = static_cast<float>(count);
    return chosen;
}

} // namespace filament::prepare
