// SPDX-License-Identifier: Apache-2.0
// Fragment stage of unlit surface materials, entry point: the base colour without light and exposure.

#if defined(SHADOW_MULTIPLIER)
// The share of sunlight that a shadow removes: the material's colour is that of a full shadow (materials guide,
// 4.2.29). Nothing casts shadows yet, so an invisible shadow plane stays invisible.
const float kShadowing = 0.0;
#endif

void main() {
    MaterialInputs inputs;
    initMaterial(inputs);
    computeShadingGeometry();
    material(inputs);
    applyMask(inputs.baseColor);
    vec4 color = vec4(inputs.baseColor.rgb, outputAlpha(inputs.baseColor.a));
    addEmissive(inputs, color);
#if defined(SHADOW_MULTIPLIER)
    color *= kShadowing;
#endif
    blendPostLighting(inputs, color);
    fragment_color = color;
}
