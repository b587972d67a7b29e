// SPDX-License-Identifier: Apache-2.0
// Transmitted light: its direction, its path length inside, and its absorption.
//   Directions unit; n and view point away from the surface, nov >= 0. ior >= 1: of the material, seen from air.
//   Solid      near the point the object is a ball that touches it, with the object's local thickness as its diameter.
//              A view that enters a ball also leaves it: no light is trapped.
//   Thin       two parallel interfaces: light leaves in the direction in which it arrived.

// Below this a ray runs along the surface of a thin layer, and its path would be infinite.
const float kMinThinCosine = 0.03125f;
// For colours that determine absorption: a darker colour counts as black.
const float kMinTransmittance = 6.103515625e-5f; // 2^-14
const float kMinAttenuationMeters = 1e-6f;

// Snell's law, or the mirror direction in case of total internal reflection.
// incident towards the surface, n against it; eta: index of the medium of origin over index of the medium entered.
vec3 refractOrReflect(vec3 incident, vec3 n, float eta) {
    float cosine = -dot(n, incident);
    float k = 1.0f - eta * eta * (1.0f - cosine) * (1.0f + cosine);
    return k < 0.0f ? incident + n * (2.0f * cosine) : incident * eta + n * (eta * cosine - sqrt(max(k, 0.0f)));
}

// The cosine with the normal behind the surface: 1 - (1 - nov^2) / ior^2 as a sum of positive terms, so that grazing
// light keeps its angle if ior is close to 1. nov in [0, 1]. Returns [nov, 1].
float refractedCosine(float nov, float ior) {
    return min(sqrt(max((ior - 1.0f) * (ior + 1.0f) + nov * nov, 0.0f)) / ior, 1.0f);
}

// The view direction behind the surface: unchanged for ior 1.
vec3 refractedInside(vec3 n, vec3 view, float ior) {
    float nov = max(dot(n, view), 0.0f);
    return (n * nov - view) / ior - n * refractedCosine(nov, ior);
}

// The direction in which the view leaves the ball: both angles at the exit equal those at the entry, so there is no
// root and no total reflection. The normal there is n mirrored at the chord. Unchanged for ior 1.
vec3 refractedSolid(vec3 n, vec3 view, float ior) {
    float nov = max(dot(n, view), 0.0f);
    float inside = refractedCosine(nov, ior);
    vec3 chord = (n * nov - view) / ior - n * inside;
    vec3 exitNormal = n + chord * (2.0f * inside);
    return chord * ior - exitNormal * (ior * inside - nov);
}

// Path length through the ball, a chord. thickness: the ball's diameter in metres.
float solidPathLength(float nov, float ior, float thickness) { return thickness * refractedCosine(nov, ior); }

// From where the view enters the ball to where it leaves it: the chord, in metres. thickness: of the ball, at most
// kMaxSolidMeters.
const float kMaxSolidMeters = 1e6f;
vec3 solidExit(vec3 n, vec3 view, float ior, float thickness) {
    float nov = max(dot(n, view), 0.0f);
    return refractedInside(n, view, ior) * solidPathLength(nov, ior, thickness);
}

// Path length through a thin layer, in metres.
float thinPathLength(float nov, float ior, float thickness) {
    return thickness / max(refractedCosine(nov, ior), kMinThinCosine);
}

// Both interfaces of a thin layer and all bounces between them: a geometric series of the reflectance f of one
// interface. The rest is transmitted. f in [0, 1]. Returns [f, 1].
vec3 thinReflectance(vec3 f) { return 2.0f * f / (1.0f + f); }

// A thin layer that tints light by t at each crossing: what its far side adds to the reflectance f of the near one, and
// what it transmits. All bounces: (1-f)^2 f t^2 and (1-f)^2 t, times the sum of the powers of f^2 t^2.
// f, tint in [0, 1]. Both return [0, 1 - f], and their sum is at most that.
const float kMinThinDenominator = 6.103515625e-5f; // 2^-14: devices may take smaller halves for 0
vec3 thinFarReflectance(vec3 f, vec3 tint) {
    vec3 once = (vec3(1.0f) - f) * tint;
    return f * once * once / max(vec3(1.0f) - f * f * tint * tint, vec3(kMinThinDenominator));
}
vec3 thinTransmittance(vec3 f, vec3 tint) {
    vec3 through = vec3(1.0f) - f;
    return through * through * tint / max(vec3(1.0f) - f * f * tint * tint, vec3(kMinThinDenominator));
}

// The roughness for looking up the scene behind: without a change of index nothing scatters. In the form of
// KHR_materials_transmission's implementation notes. Returns [0, perceptualRoughness].
float refractionPerceptualRoughness(float perceptualRoughness, float ior) {
    return perceptualRoughness * saturate(2.0f * ior - 2.0f);
}

// The standard deviation of the tangent by which a rough interface spreads transmitted light, for a normal distribution
// that blurs an edge alike: half of the light is within the same distance. The lobe is that of reflection, mirrored, as
// in KHR_materials_transmission's implementation notes: half vectors of GGX have slopes with the distribution
// a^2 / 2 (a^2 + x^2)^(-3/2) along one axis (Walter et al. 2007, eq. 33, integrated over the other), half of them
// within a / sqrt(3); light deviates twice as far. A normal distribution has half within 0.6745 deviations.
// perceptualRoughness in [0, 1]. Returns [0, 1.712].
float transmittedDeviation(float perceptualRoughness) { return 1.712f * perceptualRoughness * perceptualRoughness; }

// The level of an image whose texels, read with linear weights, are blurred by this standard deviation in pixels. Each
// level is the one before it with the weights 1, 3, 3, 1, which have the variance 3/4 of its texels: (4^n - 1) / 4 in
// all. Linear weights have 1/6 of a texel: 4^n / 6. Returns 0 below a half of a pixel. pixels >= 0. fp32 only: squares
// exceed 65504.
float pictureLevel(float pixels) { return 0.5f * log2(max((pixels * pixels + 0.25f) * 2.4f, 1.0f)); }

// The indices for red, green and blue. KHR_materials_dispersion: dispersion is 20 over the Abbe number (ior - 1) /
// (ior of blue - ior of red), so half of the difference is (ior - 1) dispersion / 40. Red stays at least 1.
vec3 dispersedIor(float ior, float dispersion) {
    float halfSpread = (ior - 1.0f) * dispersion * 0.025f;
    return vec3(max(ior - halfSpread, 1.0f), ior, ior + halfSpread);
}

// Beer 1852, Lambert 1760: the fraction that remains after a distance in metres. absorption in 1/m, >= 0.
// Returns [0, 1].
vec3 transmittance(vec3 absorption, float distance) { return exp(-absorption * distance); }

// Without a distance, absorption is a fraction. Returns [0, 1].
vec3 transmittanceWithoutThickness(vec3 absorption) { return saturate(vec3(1.0f) - absorption); }

// Inverse of transmittance(): the absorption that gives white light this colour at this distance in metres. 0 for an
// infinite distance. color in [0, 1]. Returns 1/m, >= 0. fp32 only: short distances give values above 65504.
vec3 absorptionAtDistance(vec3 color, float distance) {
    return -log(clamp(color, kMinTransmittance, 1.0f)) / max(distance, kMinAttenuationMeters);
}
