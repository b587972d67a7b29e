// SPDX-License-Identifier: Apache-2.0
// Cloth: a sheen (sheen.glsl) over a diffuse lobe that light also reaches through the threads.

// How far light reaches past the edge of cloth: to a cosine of -1/2.
const float kClothWrap = 0.5f;

// Default sheen colour of cloth: brighter and paler than the base colour. [0, 1] -> [0, 1].
vec3 clothSheenColor(vec3 baseColor) { return sqrt(max(baseColor, vec3(0.0f))); }

// The integral of diffuseCloth() over all light directions: the part of white light that remains. With w = kClothWrap:
// 2 / (1 + w)^2 times the integral of (x + w) min(s + max(x, 0), 1) over x in [-w, 1]. subsurfaceColor in [0, 1].
// Returns [0.51, 1].
vec3 clothScatterAlbedo(vec3 subsurfaceColor) {
    vec3 s = saturate(subsurfaceColor);
    vec3 a = vec3(1.0f) - s; // from this cosine on the tint is white
    vec3 behind = s * (0.5f * kClothWrap * kClothWrap);
    vec3 tinted = a * (a * (a * (1.0f / 3.0f) + (s + kClothWrap) * 0.5f) + s * kClothWrap);
    vec3 white = s * (1.0f - 0.5f * s + kClothWrap); // (1 - a^2) / 2 + w (1 - a), with 1 - a = s
    return (behind + tinted + white) * (2.0f / ((1.0f + kClothWrap) * (1.0f + kClothWrap)));
}

// Replaces a diffuse lobe times nol if light is scattered below the surface: wrapped, and tinted where the light grazes
// or comes from behind. Multiply by illuminance and diffuse colour. nol in [-1, 1], not clamped.
// subsurfaceColor in [0, 1]. Returns 1/sr; its integral is at most 1.
vec3 diffuseCloth(float nol, vec3 subsurfaceColor) {
    return saturate(subsurfaceColor + vec3(max(nol, 0.0f))) * diffuseWrapped(nol, kClothWrap);
}
