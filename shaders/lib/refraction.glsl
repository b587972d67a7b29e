// SPDX-License-Identifier: Apache-2.0
// Light that goes through: where it bends to, how far it goes inside, what is absorbed on the way.
//   Directions unit; n and view point away from the surface, nov >= 0. ior >= 1: of the material, seen from air.
//   Solid      the object near the point is a ball that touches it, as wide as it is thick there. A view that enters a ball
//              also leaves it: no light is trapped.
//   Thin       two parallel interfaces: light leaves in the direction in which it came.

// Below it a ray runs along the surface of a thin layer, whose path would be infinite.
const float kMinThinCosine = 0.03125f;
// Of a colour from which absorption follows: what is darker after its distance is black.
const float kMinTransmittance = 6.103515625e-5f; // 2^-14
const float kMinAttenuationMeters = 1e-6f;

// Snell's law, or the mirror direction where all light is reflected inside (total internal reflection).
// incident towards the surface, n against it; eta: index of where it comes from over index of where it goes to.
vec3 refractOrReflect(vec3 incident, vec3 n, float eta) {
    float cosine = -dot(n, incident);
    float k = 1.0f - eta * eta * (1.0f - cosine) * (1.0f + cosine);
    return k < 0.0f ? incident + n * (2.0f * cosine) : incident * eta + n * (eta * cosine - sqrt(max(k, 0.0f)));
}

// The cosine to the normal behind the surface: 1 - (1 - nov^2) / ior^2 as a sum of positive terms, so that grazing light
// keeps its angle where ior is almost 1. nov in [0, 1]. Returns [nov, 1].
float refractedCosine(float nov, float ior) {
    return sqrt(max((ior - 1.0f) * (ior + 1.0f) + nov * nov, 0.0f)) / ior;
}

// Where the view goes on behind the surface: straight on for ior 1.
vec3 refractedInside(vec3 n, vec3 view, float ior) {
    float nov = max(dot(n, view), 0.0f);
    return (n * nov - view) / ior - n * refractedCosine(nov, ior);
}

// Where it leaves the ball: at the exit both angles are those of the entry, so no root and no total reflection remain. The
// normal there is the chord's mirror image of n. Straight on for ior 1.
vec3 refractedSolid(vec3 n, vec3 view, float ior) {
    float nov = max(dot(n, view), 0.0f);
    float inside = refractedCosine(nov, ior);
    vec3 chord = (n * nov - view) / ior - n * inside;
    vec3 exitNormal = n + chord * (2.0f * inside);
    return chord * ior - exitNormal * (ior * inside - nov);
}

// How far light goes through the ball, a chord. thickness: its diameter, in metres.
float solidPathLength(float nov, float ior, float thickness) { return thickness * refractedCosine(nov, ior); }

// How far it goes through a thin layer, in metres.
float thinPathLength(float nov, float ior, float thickness) {
    return thickness / max(refractedCosine(nov, ior), kMinThinCosine);
}

// Both interfaces of a thin layer and all bounces between them: a geometric series of a single interface's reflectance f.
// The transmittance is what is left. f in [0, 1]. Returns [f, 1].
vec3 thinReflectance(vec3 f) { return 2.0f * f / (1.0f + f); }

// A thin layer with a colour that light takes on at each crossing, t: what its far side adds to the reflectance f of the near
// one, and what passes. All bounces: (1-f)^2 f t^2 and (1-f)^2 t, times the sum of the powers of f^2 t^2.
// f, tint in [0, 1]. Return [0, 1 - f], and no more than that together.
const float kMinThinDenominator = 1e-6f;
vec3 thinFarReflectance(vec3 f, vec3 tint) {
    vec3 once = (vec3(1.0f) - f) * tint;
    return f * once * once / max(vec3(1.0f) - f * f * tint * tint, vec3(kMinThinDenominator));
}
vec3 thinTransmittance(vec3 f, vec3 tint) {
    vec3 through = vec3(1.0f) - f;
    return through * through * tint / max(vec3(1.0f) - f * f * tint * tint, vec3(kMinThinDenominator));
}

// The roughness at which the scene behind is looked up: without a change of index nothing scatters. In the form of
// KHR_materials_transmission's implementation notes. Returns [0, perceptualRoughness].
float refractionPerceptualRoughness(float perceptualRoughness, float ior) {
    return perceptualRoughness * saturate(2.0f * ior - 2.0f);
}

// The indices for red, green and blue. KHR_materials_dispersion: dispersion is 20 over the Abbe number (ior - 1) /
// (ior of blue - ior of red), so half of the difference is (ior - 1) dispersion / 40. Red stays at least 1.
vec3 dispersedIor(float ior, float dispersion) {
    float halfSpread = (ior - 1.0f) * dispersion * 0.025f;
    return vec3(max(ior - halfSpread, 1.0f), ior, ior + halfSpread);
}

// Beer 1852, Lambert 1760: what remains after a distance in metres. absorption in 1/m, >= 0. Returns [0, 1].
vec3 transmittance(vec3 absorption, float distance) { return exp(-absorption * distance); }

// Where no distance is known absorption is a fraction. Returns [0, 1].
vec3 transmittanceWithoutThickness(vec3 absorption) { return saturate(vec3(1.0f) - absorption); }

// Inverse of transmittance(): the absorption after which white light has this colour at this distance in metres. 0 for an
// infinite one. color in [0, 1]. Returns 1/m, >= 0. fp32 only: short distances absorb more than 65504.
vec3 absorptionAtDistance(vec3 color, float distance) {
    return -log(clamp(color, kMinTransmittance, 1.0f)) / max(distance, kMinAttenuationMeters);
}
