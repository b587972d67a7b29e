// SPDX-License-Identifier: Apache-2.0
/// LightNumbers: the lights of an environment as numbers, for caches and packages. Private to this folder.
///   Layout  SunSearch, the number of lights, then eight numbers each of four lights and of the brightest region:
///           direction, illuminance, radius in degrees, share.
///   Thread  pure functions.
///   Fails   lightsFrom(): nothing for numbers that are no lights: SunLights made of the others are valid.
#pragma once

#include <filament_core/EnvironmentLights.h>

#include <array>
#include <optional>

namespace filament_core::assets {

inline constexpr size_t kLightNumbers = 2 + 8 * (EnvironmentLights::kMost + 1);
using LightNumbers = std::array<float, kLightNumbers>;

LightNumbers numbersOf(EnvironmentLights const& lights);
std::optional<EnvironmentLights> lightsFrom(LightNumbers const& numbers);

} // namespace filament_core::assets
