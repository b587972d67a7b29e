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

#if defined(SPECULAR_ANTI_ALIASING)
// How the geometry's normal changes from this pixel to its neighbours.
highp vec3 shading_normalRight, shading_normalDown;
#endif

// The same; SPECULAR_ANTI_ALIASING adds the variation of the geometry's normals within a pixel.
highp float shadedRoughness(highp float perceptualRoughness) {
    highp float roughness = perceptualRoughness;
#if defined(SPECULAR_ANTI_ALIASING)
    roughness = filteredPerceptualRoughness(roughness, shading_normalRight, shading_normalDown,
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
