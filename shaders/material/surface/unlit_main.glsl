// SPDX-License-Identifier: Apache-2.0
// Fragment stage of unlit surface materials, entry point: the base colour without light and exposure.

void main() {
    MaterialInputs inputs;
    initMaterial(inputs);
#if defined(HAS_SECTION_PLANES)
    section_point = pointOfMesh();
#endif
    computeShadingGeometry();
#if defined(HAS_SECTION_PLANES)
    cutSurface();
#endif
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(0.0); // as in lit materials
#endif
#if defined(SHADOW_MULTIPLIER) && defined(RECEIVES_SHADOWS)
    if (variant_shadows != 0) computeFacet(); // before a discard: takeDerivatives() of lit materials
#endif
    material(inputs);
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(inputs.pixelDepthOffset);
#endif
    applyMask(inputs.baseColor);
#if defined(HAS_SECTION_PLANES)
    applySection(inputs);
#endif
#if defined(BLENDS_IN_ANY_ORDER)
    keepLayer(inputs.baseColor.a);
#endif
    vec4 color = vec4(inputs.baseColor.rgb, outputAlpha(inputs.baseColor.a));
    addEmissive(inputs, color);
#if defined(SHADOW_MULTIPLIER)
    // The material's colour is that of a full shadow of the sun (materials guide, 4.2.29).
    highp vec4 darkened = vec4(0.0);
#if defined(RECEIVES_SHADOWS)
    if (variant_shadows != 0)
        darkened = color * (vec4(1.0) - sunVisibility().rgbg); // coverage, as there is only one, is that of green
#endif
    color = darkened;
#endif
    blendPostLighting(inputs, color);
#if defined(HAS_FOG)
    if (quality_fog != 0) applyFog(color, vec3(0.0), vec3(0.0));
#endif
#if defined(BLENDS_IN_ANY_ORDER)
    color = composedColor(color);
#endif
    writeColor(color);
}
