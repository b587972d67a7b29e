// SPDX-License-Identifier: Apache-2.0
// Common to lit and unlit materials, before and after lighting: alpha mask, emissive, post-lighting colour, alpha.

#if defined(BLEND_MODE_TRANSPARENT) || defined(BLEND_MODE_FADE)
#define ALPHA_IS_COVERAGE
#endif

// With several samples a pixel, the edge becomes a ramp of one pixel's width around the threshold, from which
// applyCoverage() derives coverage (Golus 2017, "Anti-aliased alpha test: the esoteric alpha to coverage").
void applyMask(inout vec4 baseColor) {
#if defined(BLEND_MODE_MASKED)
#if defined(ALPHA_TO_COVERAGE)
    if (ofFragment(passUniforms.raster.x) > 1.0) {
        float ramp = (baseColor.a - getMaskThreshold()) / max(fwidth(baseColor.a), 1e-4) + 0.5;
        if (ramp <= 0.0) discard;
        baseColor.a = min(ramp, 1.0);
        return;
    }
#endif
    if (baseColor.a < getMaskThreshold()) discard;
    baseColor.a = 1.0;
#endif
}

// The exposure converts nits to exposed values, weighted by alpha.
void addEmissive(MaterialInputs material, inout vec4 color) {
#if defined(HAS_EMISSIVE)
    float factor = mix(1.0, getExposure(), material.emissive.a);
#if defined(ALPHA_IS_COVERAGE)
    factor *= color.a;
#endif
    color.rgb += material.emissive.rgb * factor;
#endif
}

// 1 for an opaque surface, unless coverage is derived from it. A masked one has what applyMask() left.
float outputAlpha(float alpha) {
#if defined(BLEND_MODE_OPAQUE) && !defined(ALPHA_TO_COVERAGE)
    return 1.0;
#else
    return alpha;
#endif
}

// The modes of postLightingBlending (materials guide, 4.2.17), with the post-lighting colour above the lit one. They
// match the device's blending of the same name: multiply and screen weight all four channels.
void blendPostLighting(MaterialInputs material, inout vec4 color) {
#if defined(HAS_POST_LIGHTING_COLOR)
    vec4 above = material.postLightingColor;
    float surfaceAlpha = color.a;
#if defined(HAS_POST_LIGHTING_MIX)
    vec4 lit = color;
#endif
#if defined(POST_LIGHTING_OPAQUE)
    color = above;
#elif defined(POST_LIGHTING_TRANSPARENT)
    color = above + color * (1.0 - above.a);
#elif defined(POST_LIGHTING_ADD)
    color += above;
#elif defined(POST_LIGHTING_MULTIPLY)
    color *= above;
#elif defined(POST_LIGHTING_SCREEN)
    color += above * (1.0 - color);
#endif
#if defined(HAS_POST_LIGHTING_MIX)
    color = mix(lit, color, material.postLightingMixFactor);
#endif
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED)
    color.a = surfaceAlpha; // what lies above an opaque surface cannot make it transparent
#endif
#endif
}

#if defined(ALPHA_TO_COVERAGE)

// Sample s of N is covered if alpha > s / N: the first ceil(alpha * N) of them. Which samples devices would choose is
// unspecified (Vulkan 1.3, "Multisample Coverage"), and versions of Mesa differ. samples: a power of two, at most
// 16, which makes the product exact. Returns bit s for sample s; no sample if alpha is no number.
int coveredSamples(highp float alpha, highp float samples) {
    int count = alpha > 0.0 ? int(ceil(min(alpha, 1.0) * samples)) : 0;
    return (1 << count) - 1;
}

// All samples if there is one: a device does not define the mask of a program that writes it on some of its ways only.
void applyCoverage(inout highp vec4 color) {
    int covered = -1;
    highp float samples = ofFragment(passUniforms.raster.x);
    if (samples > 1.0) {
        covered = coveredSamples(color.a, samples);
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED)
        color.a = 1.0; // of a covered sample
#endif
    }
    gl_SampleMask[0] = covered;
}

#endif

void writeColor(highp vec4 color) {
#if defined(ALPHA_TO_COVERAGE)
    applyCoverage(color);
#if defined(HAS_SECTION_PLANES)
    gl_SampleMask[0] &= section_samples;
#endif
#elif defined(HAS_SECTION_PLANES)
    gl_SampleMask[0] = section_samples;
#endif
    fragment_color = color;
}
