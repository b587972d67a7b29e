// SPDX-License-Identifier: Apache-2.0
// The standard model. Fulfils the contract of shading models: README.md.

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

Surface surfaceOf(MaterialInputs material) {
    vec3 baseColor = shadedBaseColor(material.baseColor);
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
    highp float roughness = shadedRoughness(material.roughness);
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

highp vec3 shadeEnvironment(Surface surface) {
    vec3 irradiance = environmentIrradiance(surface.normal);
    vec3 diffuse = surface.diffuse * irradiance * (1.0 - surface.specularAlbedo) * surface.visibility;

    highp vec3 direction = dominantSpecularDirection(surface.normal, shading_reflected, surface.alpha);
    vec3 specular = surface.specularAlbedo * environmentRadiance(direction, surface.perceptualRoughness);
#if defined(HAS_AMBIENT_OCCLUSION) && defined(SPECULAR_AMBIENT_OCCLUSION)
    specular *= specularOcclusion(surface.nov, surface.visibility, surface.alpha);
#endif
    return diffuse + specular;
}

// One way out of each function: an early return costs a loop in the code that the drivers see.
highp vec3 shadeLight(Surface surface, Light light) {
    highp vec3 reflected = vec3(0.0);
    float nol = saturate(dot(surface.normal, light.direction));
    if (nol > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float voh = saturate(dot(surface.view, halfway));
        float dv = distributionTerm(surface.normal, halfway, surface.alpha) *
                visibilityTerm(surface.nov, nol, surface.alpha);
        vec3 f = fresnelTerm(surface.f0, surface.f90, surface.metallic, voh);
        vec3 specular = finite(dv) * f * surface.energyCompensation;
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        reflected = (surface.diffuse * diffuse + specular) * light.illuminance * nol;
    }
    return reflected;
}
