// SPDX-License-Identifier: Apache-2.0
// The standard model and specular-glossiness, which differ only in their parameters: a diffuse and a specular lobe, and
// the layers above them. Implements the interface of shading models: README.md.

#include "shaders/material/surface/lit_surface.glsl"

// ---- the environment

#include "shaders/material/surface/look_ups.glsl"

highp vec3 reflectedOf(Surface surface) {
    highp vec3 reflected = shading_reflected;
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) {
        reflected = groovesReflected(surface.grooves, surface.normal, surface.view, surface.perceptualRoughness);
    }
#endif
    return reflected;
}

// The fraction of ambient light that reaches the layers below the specular lobe.
vec3 leftBySpecular(Surface surface) { return 1.0 - surface.boundary; }

#if defined(REFRACTION)

// The environment behind, where the scene colour ends.
vec3 environmentSeen(Surface surface) {
#if defined(REFRACTION_OF_PICTURE)
    vec3 seen = vec3(0.0);
    if (quality_screenRefraction == 0) {
        seen = environmentBehind(surface.refraction);
    } else if (dot(surface.behind.environment, vec3(1.0)) > 0.0) {
        seen = environmentBehind(surface.refraction) * surface.behind.environment;
    }
    return seen;
#else
    return environmentBehind(surface.refraction);
#endif
}

#endif

// Irradiance / pi, none where baked light is in its place.
vec3 diffuseOfEnvironment(Surface surface) {
    vec3 irradiance = vec3(0.0);
#if defined(HAS_BAKED_LIGHT)
    if (surface.baked.w < 0.0)
#endif
    {
        irradiance = environmentIrradiance(openNormal(surface.normal));
    }
    return irradiance;
}

highp vec3 baseOfEnvironment(Surface surface) {
    vec3 irradiance = diffuseOfEnvironment(surface);
    vec3 diffuse = surface.diffuse * irradiance * leftBySpecular(surface);
    diffuse = seenDiffuse(diffuse, surface.visibility, surface.diffuse);
#if defined(HAS_DIFFUSE_TRANSMISSION)
    vec3 behind = surface.transmitted * environmentIrradiance(-openNormal(surface.normal));
    diffuse += seenDiffuse(behind * leftBySpecular(surface), surface.visibility, surface.transmitted);
#endif
#if defined(REFRACTION)
    if (surface.refraction.transmission > 0.0) diffuse += surface.through * environmentSeen(surface);
#endif

    highp vec3 reflected = reflectedOf(surface);
    vec3 specular = surface.specularAlbedo * radianceOfBase(surface, reflected);
    specular = seenReflection(specular, surface.visibility, surface.nov, reflected, surface.alpha,
            surface.perceptualRoughness, surface.f0);
#if defined(HAS_NORMAL)
    specular = aboveHorizon(specular, shading_isBumped, reflected);
#endif
#if defined(REFLECTION_OF_PICTURE)
    if (quality_screenReflections != 0) specular *= 1.0 - surface.mirrored.weight; // the rest: reflectedPicture()
#endif
    return diffuse + specular;
}

#if defined(HAS_SHEEN)

highp vec3 addSheenOfEnvironment(Surface surface, highp vec3 below) {
    Sheen sheen = surface.sheen;
    highp vec4 lookUp = sheenLookUp(sheen);
    vec3 radiance = environmentRadiance(lookUp.xyz, lookUp.w);
    radiance = seenReflection(radiance, surface.visibility, surface.nov, lookUp.xyz, sheen.alpha,
            sheen.perceptualRoughness, sheen.color);
#if defined(HAS_NORMAL)
    radiance = aboveHorizon(radiance, shading_isBumped, lookUp.xyz);
#endif
    return below * sheenLeaves(sheen) + sheenOfEnvironment(sheen, radiance);
}

#endif

#if defined(HAS_CLEAR_COAT)

highp vec3 addCoatOfEnvironment(Surface surface, highp vec3 below) {
    Coat coat = surface.coat;
    highp vec3 reflected = reflect(-shading_view, shading_clearCoatNormal);
    highp vec3 direction = lobeDirectionTerm(coat.normal, reflected, coat.alpha);
    vec3 radiance = environmentRadiance(direction, coat.perceptualRoughness) * coatAlbedo(coat);
    radiance = seenReflection(radiance, surface.visibility, coat.nov, reflected, coat.alpha, coat.perceptualRoughness,
            vec3(kCoatF0));
#if defined(HAS_CLEAR_COAT_NORMAL)
    radiance = aboveHorizon(radiance, true, reflected);
#endif
    return below * coatLeaves(coat) + radiance;
}

#endif

#if defined(REFRACTION_OF_PICTURE) || defined(REFLECTION_OF_PICTURE) || defined(HAS_BAKED_LIGHT)

// Transmittance of the layers above for light from the base.
highp vec3 throughLayers(Surface surface, highp vec3 light) {
#if defined(HAS_SHEEN)
    if (hasSheen(surface.sheen)) light *= sheenLeaves(surface.sheen);
#endif
#if defined(HAS_CLEAR_COAT)
    if (surface.coat.strength > 0.0) light *= coatLeaves(surface.coat);
#endif
    return light;
}

#endif

// Refracted scene colour. Unlike that of the environment it is pre-exposed, and not occluded: it contains the
// occluders.
#if defined(REFRACTION_OF_PICTURE)

highp vec3 refractedPicture(Surface surface) {
    return throughLayers(surface, surface.through * surface.behind.light);
}

#endif
#if defined(REFLECTION_OF_PICTURE)

highp vec3 reflectedPicture(Surface surface) {
    vec3 mirrored = surface.specularAlbedo * surface.mirrored.color * surface.mirrored.weight;
#if defined(HAS_NORMAL)
    mirrored = aboveHorizon(mirrored, shading_isBumped, shading_reflected);
#endif
    return throughLayers(surface, mirrored);
}

#endif

#if defined(HAS_BAKED_LIGHT)

// Diffuse reflection of baked light, which is exposed, and has met all that occludes it.
highp vec3 bakedReflection(Surface surface) {
    highp vec3 light = vec3(0.0);
    if (surface.baked.w >= 0.0) {
        light = throughLayers(surface, surface.diffuse * leftBySpecular(surface) * surface.baked.rgb * diffuseLambert());
    }
    return light;
}

#endif

highp vec3 shadeEnvironment(Surface surface) {
    highp vec3 light = baseOfEnvironment(surface);
#if defined(HAS_SHEEN)
    if (hasSheen(surface.sheen)) light = addSheenOfEnvironment(surface, light);
#endif
#if defined(HAS_CLEAR_COAT)
    if (surface.coat.strength > 0.0) light = addCoatOfEnvironment(surface, light);
#endif
    return light;
}

// ---- one light

// D V of the base.
float specularOfLight(Surface surface, vec3 halfway, vec3 light, float nol) {
    float dv;
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) {
        dv = groovesLobe(surface.grooves, surface.normal, halfway, light, nol);
    } else
#endif
    {
        dv = distributionTerm(surface.normal, halfway, surface.alpha) *
                visibilityTerm(surface.nov, nol, surface.alpha);
    }
    return finite(dv);
}

vec3 fresnelOfLight(Surface surface, float voh) {
    vec3 f;
#if defined(HAS_IRIDESCENCE)
    // A film looks different on every facet: evaluated exactly here, which preserves reciprocity.
    if (surface.film.strength > 0.0) {
        vec3 bare = fresnelTerm(surface.film.bareF0, surface.f90, surface.metallic, voh);
        f = mix(bare, filmReflectance(surface.film, voh), surface.film.strength);
    } else
#endif
    {
        f = fresnelTerm(surface.f0, surface.f90, surface.metallic, voh);
    }
    return f;
}

#if defined(HAS_CLEAR_COAT)

highp vec3 addCoatOfLight(Surface surface, Light light, highp vec3 below) {
    Coat coat = surface.coat;
    float cosine = dot(coat.normal, light.direction);
    highp vec3 reflected = below * coatLeavesOfLight(coat, max(cosine, -cosine));
    if (cosine > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float voh = saturate(dot(surface.view, halfway));
        float nol = saturate(cosine);
        vec3 specular = vec3(coatOfLight(coat, halfway, nol, voh));
#if defined(HAS_CLEAR_COAT_NORMAL)
        specular = aboveHorizon(specular, true, light.direction);
#endif
        reflected += specular * light.illuminance * nol;
    }
    return reflected;
}

#endif

#if !defined(CUSTOM_SURFACE_SHADING)

// Each function has a single exit: an early return adds a loop to the code that the drivers see.
highp vec3 shadeLight(Surface surface, Light light) {
    highp vec3 reflected = vec3(0.0);
    float nol = saturate(dot(surface.normal, light.direction));
    if (nol > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float voh = saturate(dot(surface.view, halfway));
        float dv = specularOfLight(surface, halfway, light.direction, nol);
        vec3 specular = dv * fresnelOfLight(surface, voh) * surface.energyCompensation;
#if defined(HAS_NORMAL)
        specular = aboveHorizon(specular, shading_isBumped, light.direction);
#endif
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        vec3 lobes = surface.diffuse * diffuseLeft(surface, light.direction, nol) * diffuse + specular;
#if defined(HAS_SHEEN)
        if (hasSheen(surface.sheen)) {
            vec4 sheen = sheenOfLight(surface.sheen, surface.nov, nol, saturate(dot(surface.normal, halfway)));
#if defined(HAS_NORMAL)
            sheen.rgb = aboveHorizon(sheen.rgb, shading_isBumped, light.direction);
#endif
            lobes = lobes * sheen.w + sheen.rgb;
        }
#endif
        reflected = lobes * light.illuminance * nol;
    }
#if defined(HAS_DIFFUSE_TRANSMISSION)
    else {
        float behind = saturate(-dot(surface.normal, light.direction));
        vec3 left = diffuseLeft(surface, light.direction, behind);
        reflected = surface.transmitted * left * diffuseLambert() * light.illuminance * behind;
#if defined(HAS_SHEEN)
        reflected *= sheenLeaves(surface.sheen); // only crossed on the way out
#endif
    }
#endif
#if defined(REFRACTION_THIN)
    if (surface.refraction.transmission > 0.0) {
        reflected += surface.through * lightThrough(surface.refraction, surface.normal, surface.view, surface.nov, light);
    }
#endif
#if defined(HAS_CLEAR_COAT)
    if (surface.coat.strength > 0.0) reflected = addCoatOfLight(surface, light, reflected);
#endif
    return reflected;
}

#endif
