// SPDX-License-Identifier: Apache-2.0
// Attenuation of points and spots: candela in, lux at normal incidence out.

// A light closer than a centimetre is treated as a centimetre away: real lights have a size.
const float kMinLightDistanceSquared = 1e-4f;

// Inverse square law, faded smoothly to zero at the range. Karis 2013, "Real Shading in Unreal Engine 4", eq. 9, with
// the plain inverse square instead of 1 / (d^2 + 1).
// toLight in metres, not normalised; inverseSquaredRange = 1 / range^2 in 1/m^2, 0: unlimited.
// Returns 1/m^2 in [0, 1 / kMinLightDistanceSquared], also for a light at distance 0. fp32 only: 256 m squared exceeds
// 16 bits.
float distanceAttenuation(vec3 toLight, float inverseSquaredRange) {
    float distanceSquared = dot(toLight, toLight);
    float ratio = distanceSquared * inverseSquaredRange;
    float window = saturate(1.0f - ratio * ratio);
    return window * window / max(distanceSquared, kMinLightDistanceSquared);
}

// The same fade for a light that is an area, toLight its centre. Zero wherever distanceAttenuation() is. Returns [0, 1].
float rangeWindow(vec3 toLight, float inverseSquaredRange) {
    float ratio = dot(toLight, toLight) * inverseSquaredRange;
    float window = saturate(1.0f - ratio * ratio);
    return window * window;
}

// Angular fall-off of a spot. KHR_lights_punctual, "Inner and Outer Cone Angles".
// lightDirection: unit, from the surface to the light; spotDirection: unit, where the spot shines.
// scale = 1 / (cos(inner) - cos(outer)), offset = -cos(outer) * scale. Returns [0, 1].
float spotAttenuation(vec3 lightDirection, vec3 spotDirection, float scale, float offset) {
    float attenuation = saturate(-dot(lightDirection, spotDirection) * scale + offset);
    return attenuation * attenuation;
}
