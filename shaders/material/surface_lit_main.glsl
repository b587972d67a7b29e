// SPDX-License-Identifier: Apache-2.0
// Fragment stage of lit surface materials, entry point: the standard model under image-based light, a sun and punctual
// lights. All light arrives pre-exposed, so that the sums stay within fp16 even under 110 000 lux.

struct Surface {
    vec3 diffuse;             // albedo of the diffuse lobe, times alpha if the material is transparent
    vec3 f0;
    float f90;
    float metallic;
    highp float perceptualRoughness;
    float alpha;              // of the distribution: perceptualRoughness^2
    vec3 energyCompensation;
    vec3 specularAlbedo;      // of the whole hemisphere, with all bounces
    float visibility;         // ambient occlusion
    vec3 normal, view;        // what prepareMaterial() found, in the precision of the lighting
    float nov;
};

highp float materialPerceptualRoughness(MaterialInputs material) {
    highp float roughness = material.roughness;
#if defined(SPECULAR_ANTI_ALIASING)
    roughness = filteredPerceptualRoughness(roughness, dFdx(shading_geometricNormal), dFdy(shading_geometricNormal),
            SPECULAR_ANTI_ALIASING_VARIANCE, SPECULAR_ANTI_ALIASING_THRESHOLD);
#endif
#if defined(HALF_PRECISION)
    return clamp(roughness, kMinPerceptualRoughnessMedium, 1.0);
#else
    return clampPerceptualRoughness(roughness);
#endif
}

Surface surfaceOf(MaterialInputs material) {
    vec3 baseColor = material.baseColor.rgb;
#if defined(BLEND_MODE_FADE)
    baseColor /= max(material.baseColor.a, 1e-5); // fading scales the lit colour as a whole, see main()
#endif
    Surface surface;
    surface.normal = shading_normal;
    surface.view = shading_view;
    surface.nov = shading_NoV;
    surface.diffuse = diffuseColor(baseColor, material.metallic);
    surface.metallic = material.metallic;
    surface.f0 = f0FromBaseColor(baseColor, material.metallic, material.reflectance);
    // Nothing real reflects less than 2 %; darker f0 means that the material wants no reflection at all. Lagarde and de
    // Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 3.1.
    surface.f90 = saturate(dot(surface.f0, vec3(50.0 * 0.33)));
    highp float roughness = materialPerceptualRoughness(material);
    surface.perceptualRoughness = roughness;
    surface.alpha = alphaFromPerceptual(surface.perceptualRoughness);
    vec2 dfg = splitSumTerm(shading_NoV, roughness);
    surface.energyCompensation = energyCompensationTerm(surface.f0, dfg);
    surface.specularAlbedo = specularDfg(surface.f0, dfg) * surface.energyCompensation;
#if defined(HAS_AMBIENT_OCCLUSION)
    surface.visibility = saturate(material.ambientOcclusion);
#else
    surface.visibility = 1.0;
#endif
    return surface;
}

highp vec3 environmentFromWorld(highp vec3 direction) {
    return direction * mat3(frameUniforms.worldFromEnvironment);
}

// One way out of each function: an early return costs a loop in the code that the drivers see.
highp vec3 imageBasedLight(Surface surface) {
    highp vec3 light = vec3(0.0);
    if (frameUniforms.ambient.x > 0.0) { // else: no environment
        vec3 irradiance = irradianceTerm(environmentFromWorld(surface.normal));
        vec3 diffuse = surface.diffuse * irradiance * (1.0 - surface.specularAlbedo) * surface.visibility;

        highp vec3 direction = dominantSpecularDirection(surface.normal, shading_reflected, surface.alpha);
        highp float level = levelFromPerceptualRoughness(surface.perceptualRoughness, frameUniforms.ambient.y,
                quality_roughnessMapping);
        vec3 radiance = radianceOfTexel(textureLod(viewSpecular, environmentFromWorld(direction), level));
        vec3 specular = surface.specularAlbedo * radiance;
#if defined(HAS_AMBIENT_OCCLUSION) && defined(SPECULAR_AMBIENT_OCCLUSION)
        specular *= specularOcclusion(surface.nov, surface.visibility, surface.alpha);
#endif
        light = (diffuse + specular) * frameUniforms.ambient.x;
    }
    return light;
}

#if defined(VARIANT_SUN) || defined(VARIANT_PUNCTUAL)

// Light from one direction; illuminance at normal incidence, pre-exposed.
highp vec3 directLight(Surface surface, vec3 light, vec3 illuminance) {
    highp vec3 reflected = vec3(0.0);
    float nol = saturate(dot(surface.normal, light));
    if (nol > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light);
        float voh = saturate(dot(surface.view, halfway));
        float dv = distributionTerm(surface.normal, halfway, surface.alpha) *
                visibilityTerm(surface.nov, nol, surface.alpha);
        vec3 f = fresnelTerm(surface.f0, surface.f90, surface.metallic, voh);
        vec3 specular = finite(dv) * f * surface.energyCompensation;
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        reflected = (surface.diffuse * diffuse + specular) * illuminance * nol;
    }
    return reflected;
}

#endif

#if defined(VARIANT_PUNCTUAL)

highp vec3 punctualLights(Surface surface) {
    highp vec3 sum = vec3(0.0);
    int count = int(frameUniforms.ambient.w);
    for (int i = 0; i < count; ++i) { // a loop, however few lights: unrolled code takes seconds to compile
        LightRecord light = lightUniforms.lights[i];
        highp vec3 toLight = light.positionRange.xyz - vertex_worldPosition;
        highp float attenuation = distanceAttenuation(toLight, light.positionRange.w);
        if (attenuation <= 0.0) continue; // out of range
        highp vec3 direction = normalizeOrZero(toLight);
        if (light.colorIntensity.w > 0.0) {
            attenuation *= spotAttenuation(direction, light.directionScale.xyz, light.directionScale.w, light.offset.x);
            if (attenuation <= 0.0) continue; // outside of the cone
        }
        sum += directLight(surface, direction, light.colorIntensity.rgb * attenuation);
    }
    return sum;
}

#endif

void main() {
    MaterialInputs inputs;
    initMaterial(inputs);
    computeShadingGeometry();
    material(inputs);
    applyMask(inputs.baseColor);

    Surface surface = surfaceOf(inputs);
    highp vec3 light = imageBasedLight(surface);
#if defined(VARIANT_SUN)
    light += directLight(surface, frameUniforms.sunDirection.xyz, frameUniforms.sunIlluminance.rgb);
#endif
#if defined(VARIANT_PUNCTUAL)
    light += punctualLights(surface);
#endif
#if defined(BLEND_MODE_FADE)
    light *= inputs.baseColor.a;
#endif

    highp vec4 color = vec4(light, outputAlpha(inputs.baseColor.a));
    addEmissive(inputs, color);
    blendPostLighting(inputs, color);
    fragment_color = color;
}
