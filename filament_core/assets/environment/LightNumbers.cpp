// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/LightNumbers.h"

#include "base/math/Math.h"
#include "filament_core/assets/image/HdrImage.h"

#include <cmath>

namespace filament_core::assets {
namespace {

constexpr float kMostIlluminance = 13 * kMaxRadiance; // 4 pi of the largest radiance

void write(ExtractedLight const& light, float* at) {
    for (int i = 0; i < 3; ++i) at[i] = light.direction[i], at[3 + i] = light.illuminance[i];
    at[6] = light.angularRadiusDegrees;
    at[7] = light.share;
}

bool isWithin(float value, float least, float most) { return value >= least && value <= most; } // NaN is not

/// False: they are no light.
bool read(const float* at, ExtractedLight& light) {
    for (int i = 0; i < 3; ++i) {
        light.direction[i] = at[i], light.illuminance[i] = at[3 + i];
        if (!isWithin(at[i], -1, 1) || !isWithin(at[3 + i], 0, kMostIlluminance)) return false;
    }
    light.angularRadiusDegrees = at[6];
    light.share = at[7];
    return isWithin(glm::length(light.direction), 0.999f, 1.001f) && isWithin(at[6], 0, 20) && isWithin(at[7], 0, 1);
}

} // namespace

LightNumbers numbersOf(EnvironmentLights const& lights) {
    LightNumbers numbers{ static_cast<float>(lights.search), static_cast<float>(lights.count) };
    for (size_t i = 0; i < EnvironmentLights::kMost; ++i) write(lights.lights[i], &numbers[2 + 8 * i]);
    write(lights.brightest, &numbers[2 + 8 * EnvironmentLights::kMost]);
    return numbers;
}

std::optional<EnvironmentLights> lightsFrom(LightNumbers const& numbers) {
    const auto isWhole = [](float value, size_t most) {
        return isWithin(value, 0, static_cast<float>(most)) && value == std::floor(value);
    };
    if (!isWhole(numbers[0], size_t(SunSearch::Even)) || !isWhole(numbers[1], EnvironmentLights::kMost))
        return std::nullopt;
    EnvironmentLights lights{ .search = static_cast<SunSearch>(static_cast<uint8_t>(numbers[0])),
                              .count = static_cast<uint32_t>(numbers[1]) };
    if ((lights.search == SunSearch::Found) != (lights.count > 0)) return std::nullopt;
    for (size_t i = 0; i < EnvironmentLights::kMost; ++i)
        if (!read(&numbers[2 + 8 * i], lights.lights[i])) return std::nullopt;
    if (!read(&numbers[2 + 8 * EnvironmentLights::kMost], lights.brightest)) return std::nullopt;
    return lights;
}

} // namespace filament_core::assets
