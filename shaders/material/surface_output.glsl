// SPDX-License-Identifier: Apache-2.0
// What lit and unlit materials do alike before and after lighting: alpha mask, emissive, post-lighting colour, alpha.

#if defined(BLEND_MODE_TRANSPARENT) || defined(BLEND_MODE_FADE)
#define ALPHA_IS_COVERAGE
#endif

void applyMask(inout vec4 baseColor) {
#if defined(BLEND_MODE_MASKED)
    if (baseColor.a < getMaskThreshold()) discard;
    baseColor.a = 1.0;
#endif
}

// Nits become picture values by the exposure, as far as the weight in alpha asks for it.
void addEmissive(MaterialInputs material, inout vec4 color) {
#if defined(HAS_EMISSIVE)
    float factor = mix(1.0, getExposure(), material.emissive.a);
#if defined(ALPHA_IS_COVERAGE)
    factor *= color.a;
#endif
    color.rgb += material.emissive.rgb * factor;
#endif
}

// Source over: the default of postLightingBlending.
void blendPostLighting(MaterialInputs material, inout vec4 color) {
#if defined(HAS_POST_LIGHTING_COLOR)
    color = material.postLightingColor + color * (1.0 - material.postLightingColor.a);
#endif
}

float outputAlpha(float alpha) {
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED)
    return 1.0;
#else
    return alpha;
#endif
}
