// SPDX-License-Identifier: Apache-2.0
/// SkyDesc: what decides how a clear sky looks. loadSky() of <filament_core/Sky.h> computes it.
///   Thread  any; plain values.
#pragma once

#include <filament_core/Math.h>

#include <cstdint>

namespace filament_core {

struct SkyDesc {
    float3 directionToSun{ 0.45f, 0.55f, 0.70f }; ///< any length except zero, at most 18 degrees below the horizon
    /// Optical thickness of air and haze over that of the air alone, at 550 nm; [1, 10]: 1 no haze, 2 very clear,
    /// 3 clear, 6 warm and moist, 10 hazy.
    float turbidity = 2.5f;
    float3 groundAlbedo{ 0.18f, 0.17f, 0.15f }; ///< linear, [0, 1]
    float altitudeMeters = 0;                   ///< of the camera above the sea, [0, 50'000]
    bool showsDisc = true;                      ///< SunLight::showsDisc of the sun
    uint32_t height = 256; ///< of the panorama in pixels, an even number in [16, 2048]; it is twice as wide
    friend bool operator==(SkyDesc const&, SkyDesc const&) = default;
};

} // namespace filament_core
