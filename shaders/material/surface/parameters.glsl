// SPDX-License-Identifier: Apache-2.0
// The author's parameters in the form that the shading models need.

// Perceptual roughness clamped to the range of the precision.
highp float clampedRoughness(highp float perceptualRoughness) {
#if defined(HALF_PRECISION)
    return clamp(perceptualRoughness, kMinPerceptualRoughnessMedium, 1.0);
#else
    return clampPerceptualRoughness(perceptualRoughness);
#endif
}

// The same; SPECULAR_ANTI_ALIASING adds the variation of the geometry's normals within a pixel.
highp float shadedRoughness(highp float perceptualRoughness) {
    highp float roughness = perceptualRoughness;
#if defined(SPECULAR_ANTI_ALIASING)
    roughness = filteredPerceptualRoughness(roughness, dFdx(shading_geometricNormal), dFdy(shading_geometricNormal),
            SPECULAR_ANTI_ALIASING_VARIANCE, SPECULAR_ANTI_ALIASING_THRESHOLD);
#endif
    return clampedRoughness(roughness);
}

// The colour to be lit. Fading scales the lit colour as a whole (surface/main.glsl), so alpha is divided out first.
vec3 shadedBaseColor(highp vec4 baseColor) {
    vec3 color = baseColor.rgb;
#if defined(BLEND_MODE_FADE)
    color /= max(baseColor.a, 1e-5);
#endif
    return color;
}
