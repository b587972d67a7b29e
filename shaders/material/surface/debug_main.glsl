// SPDX-License-Identifier: Apache-2.0
// Fragment stage of variants with kVariantDebug: one of the values that the material's code gives to shading, for
// DebugView. Nothing is lit. debug_material.mat converts it to colours.

// Levels of a texture of 1024 texels a side that the first coordinates read: log2 of the texels between two pixels (OpenGL
// ES 3.1, 8.14.1).
float debugMipLevel() {
    float level = 0.0;
#if defined(HAS_UV0)
    vec2 right = dFdx(vertex_uv01.xy), down = dFdy(vertex_uv01.xy);
    level = 10.0 + 0.5 * log2(max(max(dot(right, right), dot(down, down)), 1e-30));
#endif
    return level;
}

vec4 debugDirection(vec3 direction) { return vec4(direction * 0.5 + 0.5, kHasValue); }

// Red: u, green: v, of the repeated texture; blue outside of the first one. Numbers are not repeated: they are not kept in
// half floats.
vec4 debugCoordinates(bool isNumber) {
#if defined(HAS_UV0)
    vec2 uv = vertex_uv01.xy;
    bool isInside = isNumber || uv.x >= 0.0 && uv.y >= 0.0 && uv.x <= 1.0 && uv.y <= 1.0;
    return vec4(isInside ? uv : fract(uv), isInside ? 0.0 : 0.5, kHasValue);
#else
    return vec4(vec3(0.0), kHasNone);
#endif
}

#if defined(SHADING_MODEL_LIT) || defined(SHADING_MODEL_SUBSURFACE)
// Of dielectrics, as lit_surface.glsl has it.
float debugF0(MaterialInputs inputs) {
#if defined(HAS_IOR) && !defined(HAS_REFLECTANCE)
    float f0 = f0FromIor(inputs.ior);
#else
    float f0 = f0FromReflectance(inputs.reflectance);
#endif
#if defined(HAS_SPECULAR_FACTOR)
    f0 *= saturate(inputs.specularFactor);
#endif
#if defined(HAS_SPECULAR_COLOR_FACTOR)
    f0 *= max3(inputs.specularColorFactor);
#endif
    return f0;
}

// Red: the rule, green: the luminance of the base colour. Both are exact, or nearly, in half floats.
vec4 debugPlausibility(MaterialInputs inputs) {
    vec3 color = inputs.baseColor.rgb;
#if defined(BLEND_MODE_TRANSPARENT)
    color /= max(inputs.baseColor.a, 6.103515625e-5); // it is multiplied by alpha
#endif
    vec3 emissive = inputs.emissive.rgb * mix(1.0, getExposure(), inputs.emissive.a);
    return vec4(implausibleRule(color, inputs.metallic, debugF0(inputs), emissive), luminance(color), 0.0, kHasValue);
}
#endif

vec4 debugShading(MaterialInputs inputs, int view) {
    vec4 shown = vec4(vec3(0.0), kHasNone);
#if !defined(SHADING_MODEL_UNLIT)
#if defined(SHADING_MODEL_SPECULAR_GLOSSINESS)
    if (view == kViewRoughness) shown = vec4(vec3(1.0 - inputs.glossiness), kHasValue);
#else
    if (view == kViewRoughness) shown = vec4(vec3(inputs.roughness), kHasValue);
#endif
#if defined(SHADING_MODEL_LIT) || defined(SHADING_MODEL_SUBSURFACE)
    if (view == kViewMetallic) shown = vec4(vec3(inputs.metallic), kHasValue);
    if (view == kViewPlausibility) shown = debugPlausibility(inputs);
#endif
    if (view == kViewMaterialOcclusion) shown = vec4(vec3(inputs.ambientOcclusion), kHasValue);
#endif
#if defined(NEEDS_NORMAL)
    if (view == kViewNormals) shown = debugDirection(shading_normal);
    if (view == kViewGeometricNormals) shown = debugDirection(shading_geometricNormal);
#endif
#if defined(NEEDS_TANGENT)
    if (view == kViewTangents) shown = debugDirection(normalizeOrZero(shading_tangentToWorld[0]));
#endif
    return shown;
}

// 1 for a layer that transparency.glsl composes. Opaque surfaces only write depth.
vec4 debugLayer(MaterialInputs inputs) {
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED)
    return vec4(0.0);
#elif defined(BLEND_MODE_FADE)
    return vec4(inputs.baseColor.a > 0.0 ? 1.0 : 0.0);
#else
    return vec4(1.0);
#endif
}

// Red: what is covered of the samples that the fragment covers; alpha blends it over what lies behind, and with masks
// and several samples it says which of these are covered (applyCoverage()).
vec4 debugCoverage(float alpha) {
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED)
    return vec4(1.0, 0.0, 0.0, alpha);
#else
    return vec4(alpha, 0.0, 0.0, alpha);
#endif
}

vec4 debugValue(MaterialInputs inputs, float level, int view, bool isNumber) {
    vec4 shown = debugShading(inputs, view);
    // The draw has bound the object's record first.
    if (view >= kViewObjectIds && view <= kViewMaterialInstanceIds)
        shown = vec4(objectUniforms.objects[1].row0.w, 0.0, 0.0, kHasValue);
    if (view == kViewCoverage) shown = debugCoverage(inputs.baseColor.a);
    if (view == kViewBaseColor) shown = vec4(inputs.baseColor.rgb, kHasValue);
    if (view == kViewEmissive)
        shown = vec4(inputs.emissive.rgb * mix(1.0, getExposure(), inputs.emissive.a), kHasValue);
    if (view == kViewTextureCoordinates) shown = debugCoordinates(isNumber);
#if defined(HAS_UV0)
    if (view == kViewMipLevel) shown = vec4(vec3(level), kHasValue);
#endif
    if (view == kViewOverdraw) shown = vec4(1.0);
    if (view == kViewTransparentLayers) shown = debugLayer(inputs);
    return shown;
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
    float level = debugMipLevel(); // before a discard
    material(inputs);
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(inputs.pixelDepthOffset);
#endif
#if defined(PREPARE_AFTER_MATERIAL)
    prepareMaterial(inputs);
#endif
#if defined(BLEND_MODE_MASKED)
    applyMask(inputs.baseColor);
#endif
#if defined(HAS_SECTION_PLANES)
    applySection(inputs);
#endif
    int view = int(ofFragment(passUniforms.raster.z));
    highp vec4 shown = debugValue(inputs, level, view & (kViewNumbers - 1), view >= kViewNumbers);
#if defined(HAS_SECTION_PLANES)
    if ((view & (kViewNumbers - 1)) == kViewCapDepth) {
        if (!section_isCap) discard;
        shown = vec4(capDepth(), 0.0, 0.0, 1.0); // no return: a program that writes a mask writes it on all of its ways
    }
#endif
#if defined(ALPHA_TO_COVERAGE) || defined(HAS_SECTION_PLANES)
    writeColor(shown);
#else
    fragment_color = shown;
#endif
}
