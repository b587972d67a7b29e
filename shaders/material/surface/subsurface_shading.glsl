// SPDX-License-Identifier: Apache-2.0
// The standard model over a translucent medium (materials guide, 3.2; shaders/lib/subsurface.glsl). Implements the
// interface of shading models: README.md.

#include "shaders/lib/subsurface.glsl"
#include "shaders/material/surface/mixture.glsl"

struct Surface {
    vec3 diffuse;             // without the light scattered below; times alpha if the material is transparent
    vec3 scatter;             // albedo of the light scattered below; a metal scatters nothing
    float opacity;            // [0, 1]: 1 lets nothing through
    float power;
    vec3 f0;
    float f90;
    float metallic;
    highp float perceptualRoughness;
    float alpha;
    vec3 energyCompensation;
    vec3 specularAlbedo;
    // The dielectric part of a partly metallic surface: what its interface leaves is scattered.
    vec3 matterF0;
    float matterF90;
    vec3 boundary;            // the albedo of its interface
    vec3 diffuseExit;
    float visibility;         // ambient occlusion
    vec3 normal, view;
    float nov;
};

float f90Of(vec3 f0) { return saturate(dot(f0, vec3(50.0 * 0.33))); } // as in the standard model

void setInterface(MaterialInputs material, vec3 baseColor, inout Surface surface) {
    vec2 dfg = splitSumTerm(shading_NoV, surface.perceptualRoughness);
    surface.f0 = f0FromBaseColor(baseColor, material.metallic, material.reflectance);
    surface.f90 = f90Of(surface.f0);
    surface.energyCompensation = energyCompensationTerm(surface.f0, dfg);
    surface.specularAlbedo = specularDfg(surface.f0, surface.f90, dfg) * surface.energyCompensation;
    surface.matterF0 = surface.f0;
    surface.matterF90 = surface.f90;
    surface.boundary = surface.specularAlbedo;
    if (material.metallic > 0.0 && material.metallic < 1.0) {
        vec3 metalF0 = f0FromBaseColor(baseColor, 1.0, material.reflectance);
        surface.matterF0 = f0FromBaseColor(baseColor, 0.0, material.reflectance);
        surface.matterF90 = f90Of(surface.matterF0);
        Mixture mixture =
                mixtureOf(surface.matterF0, surface.matterF90, metalF0, f90Of(metalF0), material.metallic, dfg);
        surface.boundary = mixture.matterAlbedo;
        surface.specularAlbedo = mixture.albedo;
        surface.energyCompensation = mixture.compensation;
    }
}

Surface surfaceOf(MaterialInputs material) {
    vec3 baseColor = shadedBaseColor(material.baseColor);
    Surface surface;
    surface.normal = shading_normal;
    surface.view = shading_view;
    surface.nov = shading_NoV;
    surface.opacity = subsurfaceOpacity(material.thickness);
    surface.power = material.subsurfacePower;
    vec3 scatter = saturate(material.subsurfaceColor);
    surface.scatter = scatter * (1.0 - material.metallic);
    surface.diffuse = diffuseColor(baseColor, material.metallic) * subsurfaceDiffuseScaling(scatter, surface.opacity);
    surface.metallic = material.metallic;
    highp float roughness = shadedRoughness(material.roughness);
    surface.perceptualRoughness = roughness;
    surface.alpha = alphaFromPerceptual(roughness);
    setInterface(material, baseColor, surface);
    vec3 average = specularAlbedoTerm(surface.matterF0, surface.matterF90, dfgAverage(surface.alpha));
    surface.diffuseExit = diffuseExitTerm(surface.boundary, average);
    surface.visibility = ambientVisibility(material);
    return surface;
}

// Half of the scattered light wraps around the surface, the other half passes straight through the object.
highp vec3 shadeEnvironment(Surface surface) {
    vec3 irradiance = environmentIrradiance(openNormal(surface.normal));
    vec3 through = environmentRadiance(-shading_view, subsurfaceForwardRoughness(surface.power));
    vec3 scattered = surface.scatter * (0.5 * (1.0 - surface.opacity)) * (irradiance + through);
    vec3 albedo = surface.diffuse + surface.scatter * (1.0 - surface.opacity);
    vec3 inside = (surface.diffuse * irradiance + scattered) * (1.0 - surface.boundary);
    inside = seenDiffuse(inside, surface.visibility, albedo);

    highp vec3 direction = lobeDirectionTerm(surface.normal, shading_reflected, surface.alpha);
    vec3 specular = surface.specularAlbedo * environmentRadiance(direction, surface.perceptualRoughness);
    specular = seenReflection(specular, surface.visibility, surface.nov, shading_reflected, surface.alpha,
            surface.perceptualRoughness, surface.f0);
#if defined(HAS_NORMAL)
    specular = aboveHorizon(specular, shading_isBumped, shading_reflected);
#endif
    return inside + specular;
}

highp vec3 shadeLight(Surface surface, Light light) {
    float cosine = dot(surface.normal, light.direction);
    float lov = dot(surface.view, light.direction);
    vec3 scatter = surface.scatter * diffuseEntryTerm(surface.boundary);
    vec3 reflected = scatter * subsurfaceScatter(cosine, lov, surface.opacity, surface.power);
    float nol = saturate(cosine);
    if (nol > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float voh = saturate(dot(surface.view, halfway));
        float dv = distributionTerm(surface.normal, halfway, surface.alpha) *
                visibilityTerm(surface.nov, nol, surface.alpha);
        vec3 f = fresnelTerm(surface.f0, surface.f90, surface.metallic, voh);
        vec3 specular = finite(dv) * f * surface.energyCompensation;
#if defined(HAS_NORMAL)
        specular = aboveHorizon(specular, shading_isBumped, light.direction);
#endif
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        vec2 dfg = splitSumTerm(max(nol, kMinNoV), surface.perceptualRoughness);
        vec3 left = surface.diffuseExit * diffuseEntryTerm(specularAlbedoTerm(surface.matterF0, surface.matterF90, dfg));
        reflected += (surface.diffuse * left * diffuse + specular) * nol;
    }
    return reflected * light.illuminance;
}
