// SPDX-License-Identifier: Apache-2.0
/// Photometry: the intensity of a lamp from what its data sheet states.
///   scene.add(PointLight{ .intensity = pointIntensity(Lumen{ 806 }) });
///   scene.add(PointLight{ .intensity = pointIntensity(luminousPower(Watt{ 9 }, efficacy::kLed)) });
///   In      finite numbers >= 0; anything else is an assertion.   Thread  any; pure.   Memory: none.
///   Source  ISO 80000-7 for the units; Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering",
///           section 4.4, for points and spots.
#pragma once

#include <filament_core/Units.h>

namespace filament_core {

/// Typical lamps, in lumens per watt of electrical power. Data sheets vary by a factor of two.
namespace efficacy {
inline constexpr LumensPerWatt kIncandescent{ 14 };
inline constexpr LumensPerWatt kHalogen{ 20 };
inline constexpr LumensPerWatt kFluorescent{ 75 };
inline constexpr LumensPerWatt kLed{ 100 };
inline constexpr LumensPerWatt kGreatest{
    683
}; ///< all power becomes green light of 540 THz: the definition of the candela
} // namespace efficacy

/// `lumensPerWatt` in [0, 683].
Lumen luminousPower(Watt power, LumensPerWatt lumensPerWatt);

/// Of a point, which shines in all directions: lm / (4 pi).
Candela pointIntensity(Lumen power);

/// Of a spot whose cone is cut out by a shade: lm / pi. A narrower cone is as bright and gives less light.
Candela spotIntensity(Lumen power);

/// Of a spot whose reflector sends all of its power into the cone: a narrower cone is brighter. The integral of the
/// spot's fall-off over the sphere gives back `power`. Angles as in SpotLight: 0 <= inner < outer <= pi / 2.
Candela focusedSpotIntensity(Lumen power, float innerConeRadians, float outerConeRadians);

/// What a point or a spot emits: the inverses.
Lumen pointPower(Candela intensity);
Lumen spotPower(Candela intensity, float innerConeRadians, float outerConeRadians);

/// Of a lamp that gives `illuminance` to a surface that faces it at a distance of `meters`, > 0: E d^2.
Candela intensityFor(Lux illuminance, float meters);

} // namespace filament_core
