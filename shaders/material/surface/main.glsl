// SPDX-License-Identifier: Apache-2.0
// Fragment stage of lit surface materials, entry point.
// Size: main() is the order in which the light of a surface comes together, read from top to bottom.

// Before the author's code and the mask, which may discard neighbours: a fragment that a device has ended has undefined
// derivatives (OpenGL ES Shading Language, "Derivative Functions"). GPUs stop there, Mesa's CPU drivers do not.
void takeDerivatives() {
#if defined(SPECULAR_ANTI_ALIASING)
    shading_normalRight = dFdx(shading_geometricNormal);
    shading_normalDown = dFdy(shading_geometricNormal);
#endif
    if (variant_shadows != 0 || quality_contactShadows != 0) computeFacet();
}

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
    moveSurface(0.0); // derivatives are the mesh's: those of relief differ at every step
#endif
    takeDerivatives();
    material(inputs);
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(inputs.pixelDepthOffset);
#endif
#if defined(PREPARE_AFTER_MATERIAL)
    prepareMaterial(inputs); // the author did not
#endif
    applyMask(inputs.baseColor);
#if defined(HAS_SECTION_PLANES)
    applySection(inputs);
#endif
#if defined(BLENDS_IN_ANY_ORDER)
    keepLayer(inputs.baseColor.a);
#endif

    Surface surface = surfaceOf(inputs);
    highp vec3 light = vec3(0.0);
    if (ofFragment(frameUniforms.ambient.x) > 0.0) light = shadeEnvironment(surface) * frameUniforms.ambient.x;
#if defined(SHADOW_MULTIPLIER)
    shading_leftByShadows = light;
    if (ofFragment(frameUniforms.ambient.x) > 0.0) light = shadeOpenEnvironment(surface) * frameUniforms.ambient.x;
#endif
#if defined(HAS_BAKED_LIGHT)
    light += bakedReflection(surface);
#endif
#if defined(REFRACTION_OF_PICTURE)
    if (quality_screenRefraction != 0) light += refractedPicture(surface);
#endif
#if defined(REFLECTION_OF_PICTURE) && !defined(SHADOW_MULTIPLIER)
    if (quality_screenReflections != 0) light += reflectedPicture(surface);
#endif
    addLights(surface, light);
#if defined(BLEND_MODE_FADE)
    light *= inputs.baseColor.a;
#endif

#if defined(SHADOW_MULTIPLIER)
    highp vec4 color = caughtShadow(surface, light, inputs.baseColor.a);
#else
    highp vec4 color = vec4(light, outputAlpha(inputs.baseColor.a));
#endif
    addEmissive(inputs, color);
    blendPostLighting(inputs, color);
#if defined(HAS_FOG)
    if (quality_fog != 0) {
        highp vec3 seen = vec3(0.0), share = vec3(0.0);
#if defined(REFRACTION_OF_PICTURE)
        if (quality_screenRefraction != 0) {
            seen = refractedPicture(surface);
            share = saturate(surface.through * (vec3(1.0) - surface.behind.environment));
#if defined(BLEND_MODE_FADE)
            seen *= inputs.baseColor.a;
#endif
        }
#endif
        applyFog(color, seen, share);
    }
#endif
#if defined(REFRACTION_OF_PICTURE)
    if (quality_screenRefraction == 2) color.rgb = codeOfBehind(surface.behind);
#endif
#if defined(REFLECTION_OF_PICTURE)
    if (quality_screenReflections == 2) color.rgb = codeOfHit(surface.mirrored);
#endif
#if defined(BLENDS_IN_ANY_ORDER)
    color = composedColor(color);
#endif
    writeColor(color);
}
