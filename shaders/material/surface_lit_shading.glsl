// SPDX-License-Identifier: Apache-2.0
// The standard model, and specular-glossiness, which says the same in other words: a diffuse and a specular lobe, and
// whatever lies above them. Fulfils the contract of shading models: README.md.

#include "shaders/lib/specular.glsl"

#if defined(HAS_SPECULAR_FACTOR) || defined(HAS_SPECULAR_COLOR_FACTOR)
#define HAS_SPECULAR_WEIGHTS
#endif

struct Surface {
#if defined(CUSTOM_SURFACE_SHADING)
    MaterialInputs inputs;    // for the author's surfaceShading()
#endif
    vec3 diffuse;             // albedo of the diffuse lobe, times alpha if the material is transparent
    vec3 f0;
    float f90;
    float metallic;           // 1: Fresnel's exact term is a metal's
    highp float perceptualRoughness;
    float alpha;              // of the distribution: perceptualRoughness^2
    vec3 energyCompensation;
    vec3 specularAlbedo;      // of the whole hemisphere, with all bounces
    float visibility;         // ambient occlusion
    vec3 normal, view;        // what prepareMaterial() found, in the precision of the lighting
    float nov;
#if defined(HAS_IRIDESCENCE)
    Film film;
#endif
#if defined(HAS_ANISOTROPY)
    Grooves grooves;
#endif
#if defined(REFRACTION)
    Refraction refraction;
    vec3 through;             // share of the light behind that arrives
#endif
#if defined(HAS_DIFFUSE_TRANSMISSION)
    vec3 transmitted;         // albedo of the diffuse lobe behind the surface
#endif
#if defined(HAS_SHEEN)
    Sheen sheen;
#endif
#if defined(HAS_CLEAR_COAT)
    Coat coat;
#endif
};

#if defined(SHADING_MODEL_SPECULAR_GLOSSINESS)

highp float roughnessOf(MaterialInputs material) { return perceptualRoughnessFromGlossiness(material.glossiness); }

void setReflectances(MaterialInputs material, vec3 baseColor, inout Surface surface) {
    surface.diffuse = diffuseColorFromSpecularGlossiness(baseColor, material.specularColor);
    surface.metallic = 0.0;
    surface.f0 = material.specularColor;
}

#else

highp float roughnessOf(MaterialInputs material) { return material.roughness; }

// Index and reflectance say the same; reflectance is what counts here where both are given.
float reflectanceOf(MaterialInputs material) {
#if defined(HAS_IOR) && !defined(HAS_REFLECTANCE)
    return reflectanceFromIor(material.ior);
#else
    return material.reflectance;
#endif
}

void setReflectances(MaterialInputs material, vec3 baseColor, inout Surface surface) {
    surface.diffuse = diffuseColor(baseColor, material.metallic);
    surface.metallic = material.metallic;
    surface.f0 = f0FromBaseColor(baseColor, material.metallic, reflectanceOf(material));
}

#endif

#if defined(REFRACTION)

// What bends light, where both are given.
float iorOf(MaterialInputs material) {
#if defined(HAS_REFLECTANCE) && !defined(HAS_IOR)
    return iorFromReflectance(material.reflectance);
#else
    return material.ior;
#endif
}

#endif

// Nothing real reflects less than 2 %; darker f0 means that the material wants no reflection at all. Lagarde and de
// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 3.1.
float f90Of(vec3 f0) { return saturate(dot(f0, vec3(50.0 * 0.33))); }

// Before anything lies above: KHR_materials_specular's weights.
void weighReflectances(MaterialInputs material, vec3 baseColor, inout Surface surface) {
#if defined(HAS_SPECULAR_WEIGHTS)
    float f0 = f0FromReflectance(reflectanceOf(material));
    surface.f0 = f0FromSpecular(
            baseColor, material.metallic, f0, material.specularColorFactor, saturate(material.specularFactor));
    surface.f90 *= f90FromSpecular(saturate(material.specularFactor), material.metallic);
#endif
}

// What lies above changes what the base reflects: a coat its index, a film its colour.
void coverReflectances(inout Surface surface) {
#if defined(HAS_IRIDESCENCE)
    surface.film.baseF0 = surface.f0;
#endif
#if defined(HAS_CLEAR_COAT) && defined(CLEAR_COAT_IOR_CHANGE)
    if (surface.coat.strength > 0.0) {
        vec3 covered = f0UnderCoat(surface.f0, 1.0) * saturate(surface.f0 * 50.0); // what wants no reflection has none
        surface.f0 = mix(surface.f0, covered, surface.coat.strength);
        surface.f90 = min(surface.f90, f90Of(surface.f0));
    }
#endif
#if defined(HAS_IRIDESCENCE)
    surface.film.bareF0 = surface.f0;
    if (surface.film.strength > 0.0) {
        surface.f0 = mix(surface.f0, filmF0(surface.film, shading_NoV), surface.film.strength);
        surface.f90 = mix(surface.f90, 1.0, surface.film.strength);
    }
#endif
}

void setSpecularAlbedo(inout Surface surface, highp float roughness) {
    vec2 dfg = splitSumTerm(shading_NoV, roughness);
    surface.energyCompensation = energyCompensationTerm(surface.f0, dfg);
#if defined(HAS_SPECULAR_WEIGHTS) || defined(HAS_CLEAR_COAT) || defined(REFRACTION)
    surface.specularAlbedo = specularDfg(surface.f0, surface.f90, dfg) * surface.energyCompensation;
#else
    surface.specularAlbedo = specularDfg(surface.f0, dfg) * surface.energyCompensation;
#endif
#if defined(HAS_ANISOTROPY)
    surface.energyCompensation = groovesCompensation(surface.grooves, surface.energyCompensation);
#endif
}

#if defined(HAS_DIFFUSE_TRANSMISSION)

// KHR_materials_diffuse_transmission: this part of what the diffuse lobe scatters leaves at the other side.
void setTransmission(MaterialInputs material, inout Surface surface) {
    float part = saturate(material.diffuseTransmission);
    vec3 albedo = saturate(material.diffuseTransmissionColor) * (1.0 - material.metallic);
#if defined(BLEND_MODE_TRANSPARENT)
    albedo *= material.baseColor.a;
#endif
    surface.transmitted = albedo * part;
    surface.diffuse *= 1.0 - part;
#if defined(REFRACTION)
    surface.transmitted *= 1.0 - surface.refraction.transmission;
#endif
}

#endif

#if defined(REFRACTION)

// Both interfaces: what the far one of a thin layer sends back comes out with what the near one reflects.
void setThrough(inout Surface surface) {
    surface.through = vec3(0.0);
    if (surface.refraction.transmission > 0.0) {
        surface.through = transmittedShare(surface.refraction, surface.specularAlbedo);
        vec3 far = farReflectedShare(surface.refraction, surface.specularAlbedo);
        surface.energyCompensation *= 1.0 + far / max(surface.specularAlbedo, vec3(1e-4));
        surface.specularAlbedo += far;
    }
}

#endif

void setLayers(MaterialInputs material, inout Surface surface) {
#if defined(REFRACTION)
    surface.refraction = refractionOf(material, surface.diffuse, roughnessOf(material), iorOf(material));
    surface.diffuse *= 1.0 - surface.refraction.transmission; // goes through instead
#endif
#if defined(HAS_IRIDESCENCE)
    surface.film = filmOf(material);
#endif
#if defined(HAS_ANISOTROPY)
    surface.grooves = groovesOf(material, surface.alpha);
#endif
#if defined(HAS_DIFFUSE_TRANSMISSION)
    setTransmission(material, surface);
#endif
#if defined(HAS_SHEEN)
    surface.sheen = sheenOf(material);
#endif
#if defined(HAS_CLEAR_COAT)
    surface.coat = coatOf(material);
#endif
#if defined(HAS_IRIDESCENCE) && defined(HAS_CLEAR_COAT)
    surface.film.outsideIor = mix(1.0, kCoatIor, surface.coat.strength);
#endif
}

Surface surfaceOf(MaterialInputs material) {
    vec3 baseColor = shadedBaseColor(material.baseColor);
    Surface surface;
#if defined(CUSTOM_SURFACE_SHADING)
    surface.inputs = material;
#endif
    surface.normal = shading_normal;
    surface.view = shading_view;
    surface.nov = shading_NoV;
    setReflectances(material, baseColor, surface);
    surface.f90 = f90Of(surface.f0);
    weighReflectances(material, baseColor, surface);
    highp float roughness = shadedRoughness(roughnessOf(material));
    surface.perceptualRoughness = roughness;
    surface.alpha = alphaFromPerceptual(surface.perceptualRoughness);
    setLayers(material, surface);
    coverReflectances(surface);
    setSpecularAlbedo(surface, roughness);
#if defined(REFRACTION)
    setThrough(surface);
#endif
    surface.visibility = ambientVisibility(material);
    return surface;
}

// ---- the environment

highp vec3 reflectedOf(Surface surface) {
    highp vec3 reflected = shading_reflected;
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) {
        reflected = groovesReflected(surface.grooves, surface.normal, surface.view, surface.perceptualRoughness);
    }
#endif
    return reflected;
}

highp vec3 baseOfEnvironment(Surface surface) {
    vec3 irradiance = environmentIrradiance(openNormal(surface.normal));
    vec3 diffuse = surface.diffuse * irradiance * (1.0 - surface.specularAlbedo);
    diffuse = seenDiffuse(diffuse, surface.visibility, surface.diffuse);
#if defined(HAS_DIFFUSE_TRANSMISSION)
    vec3 behind = surface.transmitted * environmentIrradiance(-openNormal(surface.normal));
    diffuse += seenDiffuse(behind * (1.0 - surface.specularAlbedo), surface.visibility, surface.transmitted);
#endif
#if defined(REFRACTION)
    if (surface.refraction.transmission > 0.0) diffuse += surface.through * environmentBehind(surface.refraction);
#endif

    highp vec3 reflected = reflectedOf(surface);
    highp vec3 direction = dominantSpecularDirection(surface.normal, reflected, surface.alpha);
    vec3 specular = surface.specularAlbedo * environmentRadiance(direction, surface.perceptualRoughness);
    specular = seenReflection(specular, surface.visibility, surface.nov, reflected, surface.alpha,
            surface.perceptualRoughness, surface.f0);
#if defined(HAS_NORMAL)
    specular = aboveHorizon(specular, shading_isBumped, reflected);
#endif
    return diffuse + specular;
}

#if defined(HAS_SHEEN)

highp vec3 addSheenOfEnvironment(Surface surface, highp vec3 below) {
    Sheen sheen = surface.sheen;
    vec3 radiance = environmentRadiance(shading_reflected, sheen.perceptualRoughness);
    radiance = seenReflection(radiance, surface.visibility, surface.nov, shading_reflected, sheen.alpha,
            sheen.perceptualRoughness, sheen.color);
#if defined(HAS_NORMAL)
    radiance = aboveHorizon(radiance, shading_isBumped, shading_reflected);
#endif
    return below * sheenLeaves(sheen) + sheenOfEnvironment(sheen, radiance);
}

#endif

#if defined(HAS_CLEAR_COAT)

highp vec3 addCoatOfEnvironment(Surface surface, highp vec3 below) {
    Coat coat = surface.coat;
    highp vec3 reflected = reflect(-shading_view, shading_clearCoatNormal);
    highp vec3 direction = dominantSpecularDirection(coat.normal, reflected, coat.alpha);
    vec3 radiance = environmentRadiance(direction, coat.perceptualRoughness) * coatAlbedo(coat);
    radiance = seenReflection(radiance, surface.visibility, coat.nov, reflected, coat.alpha, coat.perceptualRoughness,
            vec3(kCoatF0));
#if defined(HAS_CLEAR_COAT_NORMAL)
    radiance = aboveHorizon(radiance, true, reflected);
#endif
    return below * coatLeaves(coat) + radiance;
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
    // A film looks different on every facet: here exactly, so that pairs of directions may be exchanged.
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
        reflected += coatOfLight(coat, halfway, nol, voh) * light.illuminance * nol;
    }
    return reflected;
}

#endif

#if !defined(CUSTOM_SURFACE_SHADING)

// One way out of each function: an early return costs a loop in the code that the drivers see.
highp vec3 shadeLight(Surface surface, Light light) {
    highp vec3 reflected = vec3(0.0);
    float nol = saturate(dot(surface.normal, light.direction));
    if (nol > 0.0) {
        vec3 halfway = normalizeOrZero(surface.view + light.direction);
        float voh = saturate(dot(surface.view, halfway));
        float dv = specularOfLight(surface, halfway, light.direction, nol);
        vec3 specular = dv * fresnelOfLight(surface, voh) * surface.energyCompensation;
        float diffuse = diffuseTerm(surface.nov, nol, voh, surface.perceptualRoughness);
        vec3 lobes = surface.diffuse * diffuse + specular;
#if defined(HAS_SHEEN)
        if (hasSheen(surface.sheen)) {
            vec4 sheen = sheenOfLight(surface.sheen, surface.nov, nol, saturate(dot(surface.normal, halfway)));
            lobes = lobes * sheen.w + sheen.rgb;
        }
#endif
        reflected = lobes * light.illuminance * nol;
    }
#if defined(HAS_DIFFUSE_TRANSMISSION)
    else {
        float behind = saturate(-dot(surface.normal, light.direction));
        reflected = surface.transmitted * diffuseLambert() * light.illuminance * behind;
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
