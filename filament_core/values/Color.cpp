// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"
#include "base/math/Elementary.h"
#include "base/math/Math.h"
#include "filament_core/values/Daylight.h"

#include <filament_core/Color.h>

#include <algorithm>
#include <cmath>

namespace filament_core::color {
namespace {

float decode(float v) { return v <= 0.04045f ? v / 12.92f : elementary::pow((v + 0.055f) / 1.055f, 2.4f); }
float encode(float v) { return v <= 0.0031308f ? v * 12.92f : 1.055f * elementary::pow(v, 1 / 2.4f) - 0.055f; }

// CIE 1931 x, y; luminance 1. What Rec. 709 cannot show becomes 0 before the luminance is restored.
LinearColor fromChromaticity(float x, float y) {
    const float3 xyz(x / y, 1, (1 - x - y) / y);
    // IEC 61966-2-1: linear sRGB from CIE XYZ.
    const float3x3 rgbFromXyz(float3(3.2404542f, -0.9692660f, 0.0556434f), float3(-1.5371385f, 1.8760108f, -0.2040259f),
                              float3(-0.4985314f, 0.0415560f, 1.0572252f));
    const float3 rgb = glm::max(rgbFromXyz * xyz, float3(0.0f));
    return rgb / luminance(rgb);
}

} // namespace

LinearColor linearFromSrgb(float3 encoded) { return { decode(encoded.x), decode(encoded.y), decode(encoded.z) }; }

float3 srgbFromLinear(LinearColor linear) { return { encode(linear.x), encode(linear.y), encode(linear.z) }; }

float luminance(LinearColor linear) { return glm::dot(linear, float3(0.2126f, 0.7152f, 0.0722f)); }

float3 absorptionAtDistance(LinearColor transmittance, float meters) {
    const float3 t = glm::clamp(transmittance, 1e-5f, 1.0f);
    return -float3(elementary::log(t.x), elementary::log(t.y), elementary::log(t.z)) / std::max(meters, 1e-5f);
}

LinearColor fromTemperature(float kelvin) {
    FILAMENT_ASSERT(kelvin >= 1000 && kelvin <= 15'000,
                    "the temperature of a black body is from 1000 to 15 000 kelvin");
    // Krystek 1985, "An algorithm to calculate correlated colour temperature": rational fits of the Planckian locus in
    // CIE 1960 UCS, error below 1e-4 from 1000 K to 15 000 K.
    const float t = kelvin;
    const float u = (0.860117757f + 1.54118254e-4f * t + 1.28641212e-7f * t * t) /
                    (1.0f + 8.42420235e-4f * t + 7.08145163e-7f * t * t);
    const float v = (0.317398726f + 4.22806245e-5f * t + 4.20481691e-8f * t * t) /
                    (1.0f - 2.89741816e-5f * t + 1.61456053e-7f * t * t);
    const float scale = 1 / (2 * u - 8 * v + 4);
    return fromChromaticity(3 * u * scale, 2 * v * scale);
}

LinearColor fromDaylight(float kelvin) {
    FILAMENT_ASSERT(kelvin >= 4000 && kelvin <= 25'000, "the temperature of daylight is from 4000 to 25 000 kelvin");
    const double2 chromaticity = daylightChromaticity(static_cast<double>(kelvin));
    return fromChromaticity(static_cast<float>(chromaticity.x), static_cast<float>(chromaticity.y));
}

double2 daylightChromaticity(double kelvin) {
    const double t = 1e3 / kelvin;
    const double x = kelvin <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                                    : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
    return { x, (-3.000 * x + 2.870) * x - 0.275 };
}

} // namespace filament_core::color
