// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Photometry.h>

#include "base/Assert.h"
#include "base/math/Elementary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core {
namespace {

using std::numbers::pi;

double checked(float quantity) {
    FILAMENT_ASSERT(quantity >= 0 && std::isfinite(quantity), "a quantity of light or power is finite and >= 0");
    return static_cast<double>(quantity);
}

Candela candela(double value) { return { static_cast<float>(value) }; }

// Lumens of a spot of one candela. The fall-off of KHR_lights_punctual is ((c - outer) / (inner - outer))^2 in the
// cosine c of the angle; with d = inner - outer its integral over the sphere is 2 pi (1 - inner + d / 3). The engine's
// d is at least 1e-3 (SelectLights.cpp), so narrower cones do not reach the full intensity.
double spotLumens(float innerConeRadians, float outerConeRadians) {
    FILAMENT_ASSERT(innerConeRadians >= 0 && innerConeRadians < outerConeRadians && outerConeRadians <= 1.5707964f,
                    "a spot has 0 <= inner < outer <= pi/2");
    // 1 - cos, without cancellation.
    const auto versine = [](float radians) {
        return 2 * elementary::pow(elementary::sin(static_cast<double>(radians) / 2), 2);
    };
    const double outer = versine(outerConeRadians), inner = versine(innerConeRadians);
    const double width = std::max(1e-3, outer - inner), whole = outer - width;
    const double solidAngle = whole >= 0 ? whole + width / 3 : outer * (outer / width) * (outer / width) / 3;
    return 2 * pi * solidAngle;
}

} // namespace

Lumen luminousPower(Watt power, LumensPerWatt lumensPerWatt) {
    FILAMENT_ASSERT(lumensPerWatt.value <= efficacy::kGreatest.value, "a luminous efficacy is at most 683 lm/W");
    return { static_cast<float>(checked(power.value) * checked(lumensPerWatt.value)) };
}

Candela pointIntensity(Lumen power) { return candela(checked(power.value) / (4 * pi)); }

Candela spotIntensity(Lumen power) { return candela(checked(power.value) / pi); }

Candela focusedSpotIntensity(Lumen power, float innerConeRadians, float outerConeRadians) {
    return candela(checked(power.value) / spotLumens(innerConeRadians, outerConeRadians));
}

Lumen pointPower(Candela intensity) { return { static_cast<float>(checked(intensity.value) * 4 * pi) }; }

Lumen spotPower(Candela intensity, float innerConeRadians, float outerConeRadians) {
    return { static_cast<float>(checked(intensity.value) * spotLumens(innerConeRadians, outerConeRadians)) };
}

Candela intensityFor(Lux illuminance, float meters) {
    FILAMENT_ASSERT(meters > 0 && std::isfinite(meters),
                    "an illuminance is measured at a distance that is finite and > 0");
    return candela(checked(illuminance.value) * static_cast<double>(meters) * static_cast<double>(meters));
}

} // namespace filament_core
