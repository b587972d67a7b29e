// SPDX-License-Identifier: Apache-2.0
// Cloth: a sheen (sheen.glsl) over a diffuse lobe that light also reaches through the threads.

// How far light reaches around an edge of cloth: a cosine of -1/2.
const float kClothWrap = 0.5f;

// What fibres reflect if nothing is said: brighter and paler than the base colour. [0, 1] -> [0, 1].
vec3 clothSheenColor(vec3 baseColor) { return sqrt(max(baseColor, vec3(0.0f))); }

// Instead of a diffuse lobe times nol, where light is scattered below the surface: wrapped, and tinted where the light
// grazes or comes from behind. Times illuminance and diffuse colour, like the product that it replaces. nol in [-1, 1],
// not clamped; subsurfaceColor in [0, 1]. Returns 1/sr; its integral is at most 1.
vec3 diffuseCloth(float nol, vec3 subsurfaceColor) {
    return saturate(subsurfaceColor + vec3(max(nol, 0.0f))) * diffuseWrapped(nol, kClothWrap);
}
