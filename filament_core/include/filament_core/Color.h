// SPDX-License-Identifier: Apache-2.0
/// Color: linear Rec. 709 / sRGB primaries, D65. Everything in the engine is linear until the tone mapper.
#pragma once

#include <filament_core/Math.h>

namespace filament_core {

using LinearColor = float3; ///< linear, >= 0; reflectances in [0, 1]

namespace color {

/// IEC 61966-2-1 electro-optical transfer, per component; `encoded` in [0, 1].
LinearColor linearFromSrgb(float3 encoded);
float3 srgbFromLinear(LinearColor linear);

/// Chromaticity of a black body, luminance 1: lamps. `kelvin` in [1000, 15000], anything else is an assertion. Krystek
/// 1985 (CIE 1960 UCS). Below 1900 K blue is outside of Rec. 709 and becomes 0.
LinearColor fromTemperature(float kelvin);

/// Chromaticity of a phase of daylight, luminance 1: suns and skies. `kelvin` is the correlated colour temperature, in
/// [4000, 25000], anything else is an assertion; 6504 is D65, the white of Rec. 709. CIE 15:2004, section 3.1.
LinearColor fromDaylight(float kelvin);

/// CIE Y of a linear Rec. 709 colour.
float luminance(LinearColor linear);

/// The absorption of a medium, per metre, through which white light has the colour `transmittance` after `meters`:
/// -ln(transmittance) / meters (Beer and Lambert; materials guide, 3.1.22). Components below 1e-5 count as 1e-5, those
/// above 1 as 1, and distances below 1e-5 m as 1e-5 m, so that the result is finite and >= 0.
float3 absorptionAtDistance(LinearColor transmittance, float meters);

} // namespace color
} // namespace filament_core
