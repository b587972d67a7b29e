// SPDX-License-Identifier: Apache-2.0
// Cloth: fibres that stand up over a diffuse lobe (materials guide, 3.3; shaders/lib/cloth.glsl). Implements the
// interface of shading models: README.md.

#include "shaders/lib/sheen.glsl"
#include "shaders/lib/cloth.glsl"

struct Surface {
    vec3 diffuse;         // times alpha if the material is transparent
    vec3 sheenColor;
    vec3 subsurfaceColor; // 0: light does not pass through the threads
    highp float perceptualRoughness;
    float alpha;
    float sheenAlbedo;    // of white fibres, towards the view
    float visibility;     // ambient occlusion
    vec3 normal, view;
    float nov;
};

// Albedo of white fibres for a cosine with view or light: channels of the table for which there is no fit.
float clothAlbedoTerm(highp float cosine, highp float perceptualRoughness) {
#if defined(CLOTH_ASHIKHMIN)
    return textureLod(passDfg, vec2(cosine, perceptualRoughness), 0.0).w;
#else
    return textureLod(passDfg, vec2(cosine, perceptualRoughness), 0.0).z;
#endif
}

Surface surfaceOf(MaterialInputs material) {
    Surface surface;
    surface.normal = shading_normal;
    surface.view = shading_view;
    surface.nov = shading_NoV;
    surface.diffuse = shadedBaseColor(material.baseColor);
#if defined(HAS_SHEEN_COLOR)
    surface.sheenColor = saturate(material.sheenColor);
#else
    surface.sheenColor = clothSheenColor(saturate(surface.diffuse));
#endif
#if defined(HAS_SUBSURFACE_COLOR)
    surface.subsurfaceColor = saturate(material.subsurfaceColor);
#else
    surface.subsurfaceColor = vec3(0.0);
#endif
    surface.perceptualRoughness = shadedRoughness(material.roughness);
    surface.alpha = alphaFromPerceptual(surface.perceptualRoughness);
    surface.sheenAlbedo = clothAlbedoTerm(shading_NoV, surface.perceptualRoughness);
    surface.visibility = ambientVisibility(material);
    return surface;
}

// The direction of the fibres' look-up, and its perceptual roughness in w.
highp vec4 clothLookUp(Surface surface) {
#if defined(CLOTH_ASHIKHMIN)
    highp vec3 direction = lobeDirectionTerm(surface.normal, shading_reflected, surface.alpha);
    return vec4(direction, surface.perceptualRoughness);
#else
    highp vec2 mean = sheenMeanDirection(shading_NoV, surface.perceptualRoughness);
    highp vec3 direction = (shading_view - shading_normal * shading_NoV) * mean.x + shading_normal * mean.y;
    return vec4(normalizeOrZero(direction), sheenLookUpRoughness(mean, shading_NoV));
#endif
}

highp vec3 shadeEnvironment(Surface surface) {
    vec3 diffuse = surface.diffuse * environmentIrradiance(openNormal(surface.normal)) *
            sheenAlbedoScaling(surface.sheenColor, surface.sheenAlbedo);
#if defined(HAS_SUBSURFACE_COLOR)
    diffuse *= clothScatterAlbedo(surface.subsurfaceColor);
#endif
    diffuse = seenDiffuse(diffuse, surface.visibility, surface.diffuse);
    highp vec4 lookUp = clothLookUp(surface);
    vec3 specular = surface.sheenColor * (surface.sheenAlbedo * sheenLimit(surface.sheenAlbedo)) *
            environmentRadiance(lookUp.xyz, lookUp.w);
    specular = seenReflection(specular, surface.visibility, surface.nov, lookUp.xyz, surface.alpha,
            surface.perceptualRoughness, surface.sheenColor);
#if defined(HAS_NORMAL)
    specular = aboveHorizon(specular, shading_isBumped, lookUp.xyz);
#endif
    return diffuse + specular;
}

float clothDistribution(float noh, float alpha) {
#if defined(CLOTH_ASHIKHMIN)
    return ndfAshikhmin(noh, alpha);
#else
    return ndfCharlie(noh, alpha);
#endif
}

// Includes the cosine.
vec3 clothDiffuse(Surface surface, float cosine, float nol, float voh) {
#if defined(HAS_SUBSURFACE_COLOR)
    return diffuseCloth(cosine, surface.subsurfaceColor);
#else
    return vec3(diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness) * nol);
#endif
}

// Taking the smaller of the values for view and light preserves reciprocity.
highp vec3 shadeLight(Surface surface, Light light) {
    highp vec3 reflected = vec3(0.0);
    float cosine = dot(surface.normal, light.direction);
#if defined(HAS_SUBSURFACE_COLOR)
    float leastCosine = -kClothWrap;
#else
    float leastCosine = 0.0;
#endif
    if (cosine > leastCosine) {
        float nol = saturate(cosine);
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float noh = saturate(dot(surface.normal, halfway));
        float voh = saturate(dot(surface.view, halfway));
        float lightAlbedo = clothAlbedoTerm(nol, surface.perceptualRoughness);
        float limit = min(sheenLimit(surface.sheenAlbedo), sheenLimit(lightAlbedo));
        float scaling = min(sheenAlbedoScaling(surface.sheenColor, surface.sheenAlbedo),
                sheenAlbedoScaling(surface.sheenColor, lightAlbedo));
        vec3 sheen = surface.sheenColor *
                (finite(clothDistribution(noh, surface.alpha) * visibilityNeubelt(surface.nov, nol)) * limit * nol);
#if defined(HAS_NORMAL)
        sheen = aboveHorizon(sheen, shading_isBumped, light.direction);
#endif
        vec3 diffuse = surface.diffuse * scaling * clothDiffuse(surface, cosine, nol, voh);
        reflected = (diffuse + sheen) * light.illuminance;
    }
    return reflected;
}
