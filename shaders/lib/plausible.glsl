// SPDX-License-Identifier: Apache-2.0
// Which values no real material has. Guy and Agopian 2018, "Physically Based Rendering in Filament", and its notes for
// artists. color.glsl goes before.

// The number of the rule that a texel breaks, as in PlausibilityRule (<filament_core/DebugViews.h>); 0: none. Of several
// rules, the first one. The colour counts by its luminance, whose codes of sRGB are from 50 to 240 for dielectrics and
// from 170 on for metals: limits are half a code beyond. f0: of dielectrics; 2 % is a reflectance of 0.35. emissive:
// relative to white.
float implausibleRule(vec3 baseColor, float metallic, float f0, vec3 emissive) {
    float light = luminance(baseColor);
    bool isMetal = metallic > 0.9f;
    float rule = 0.0f;
    if (max(max(emissive.x, emissive.y), emissive.z) > 1.0f) rule = 6.0f;
    if (!isMetal && f0 < 0.0195f) rule = 5.0f;
    if (isMetal && light < 0.39936153f) rule = 4.0f;  // code 169.5
    if (!isMetal && light > 0.87548908f) rule = 3.0f; // code 240.5
    if (!isMetal && light < 0.03130148f) rule = 2.0f; // code 49.5
    if (!isMetal && metallic >= 0.1f) rule = 1.0f;
    return rule;
}
