// SPDX-License-Identifier: Apache-2.0
// Fragment stage of depth-only variants: only discards matter, nothing is lit and no colour is written.

#if defined(DITHERS_DEPTH) || defined(TRANSMITS_DEPTH)

// Eight patterns, all different and none a shift of another, in turns for 16 layers of depth per octave. So two panes
// in different layers transmit the product of their transmittances.
highp float noiseOfLayer() {
    uint layer = floatBitsToUint(gl_FragCoord.z) >> 19u;
    highp vec2 pixel = floor(gl_FragCoord.xy);
    if ((layer & 1u) != 0u) pixel = pixel.yx;
    if ((layer & 2u) != 0u) pixel.x = -pixel.x;
    if ((layer & 4u) != 0u) pixel = vec2(pixel.x + pixel.y, pixel.y - pixel.x);
    return interleavedGradientNoise(pixel);
}

#endif

#if defined(TRANSMITS_DEPTH)

// From lights at a point, or parallel.
highp vec3 towardsLight() {
    bool isPoint = frameUniforms.clipFromView[2].w != 0.0;
    highp mat4 view = frameUniforms.viewFromWorld;
    return isPoint ? normalizeOrZero(-vertex_worldPosition) : vec3(view[0].z, view[1].z, view[2].z);
}

// Straight through, in the colour channel of this map. Light is not bent, as in the refraction of thin surfaces.
highp float sharePassed(MaterialInputs inputs) {
    float passed = 0.0;
    int channel = int(passUniforms.raster.y) - 1;
    if (quality_coloredShadows != 0 && channel >= 0) {
        shading_NoV = max(abs(dot(shading_normal, shading_view)), kMinNoV);
#if defined(SHADING_MODEL_SPECULAR_GLOSSINESS)
        vec3 color = diffuseColorFromSpecularGlossiness(inputs.baseColor.rgb, inputs.specularColor);
        vec3 f0 = inputs.specularColor;
        float dielectric = 1.0;
#else
        vec3 color = inputs.baseColor.rgb;
        vec3 f0 = vec3(f0FromIor(iorOf(inputs)));
        float dielectric = 1.0 - inputs.metallic;
#endif
        vec3 reflected = fresnelSchlick(f0, 1.0, shading_NoV);
        Refraction refraction = refractionOf(inputs, color, 0.0, iorOf(inputs));
        vec3 shares = transmittedShare(refraction, reflected) * dielectric;
        passed = channel == 0 ? shares.r : channel == 1 ? shares.g : shares.b;
    }
    return passed;
}

#endif

void main() {
#if defined(DEPTH_RUNS_MATERIAL)
    MaterialInputs inputs;
    initMaterial(inputs);
#if defined(HAS_SECTION_PLANES)
    section_point = pointOfMesh();
#endif
    computeShadingGeometry();
#if defined(TRANSMITS_DEPTH)
    shading_view = towardsLight();
#endif
    material(inputs);
#if defined(HAS_PIXEL_DEPTH_OFFSET)
    moveSurface(inputs.pixelDepthOffset);
#endif
#if defined(HAS_SECTION_PLANES)
    if (sectionDistance(pointOfMesh()) < 0.0) discard;
#endif
#if defined(BLEND_MODE_MASKED)
    if (inputs.baseColor.a < getMaskThreshold()) discard;
#endif
#if defined(DITHERS_DEPTH) || defined(TRANSMITS_DEPTH)
    highp float stopped = 1.0;
#if defined(DITHERS_DEPTH)
    stopped = inputs.baseColor.a;
#endif
#if defined(TRANSMITS_DEPTH)
#if defined(PREPARE_AFTER_MATERIAL)
    prepareMaterial(inputs);
#endif
    stopped *= 1.0 - sharePassed(inputs);
#endif
    if (stopped <= noiseOfLayer()) discard;
#endif
#endif
}
