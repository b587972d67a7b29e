// SPDX-License-Identifier: Apache-2.0
// The surface of the standard model and specular-glossiness, computed once for all lights.

#include "shaders/lib/specular.glsl"
#include "shaders/material/surface/mixture.glsl"

#if defined(HAS_SPECULAR_FACTOR) || defined(HAS_SPECULAR_COLOR_FACTOR)
#define HAS_SPECULAR_WEIGHTS
#endif

// Light scattered inside is diffuse light that came in on this side or on the other one.
#if defined(HAS_VOLUME_SCATTER) && !defined(HAS_DIFFUSE_TRANSMISSION)
#define HAS_DIFFUSE_TRANSMISSION
#endif

struct Surface {
#if defined(CUSTOM_SURFACE_SHADING)
    MaterialInputs inputs;    // for the author's surfaceShading()
#endif
    vec3 diffuse;             // albedo of the diffuse lobe, times alpha if the material is transparent
    vec3 f0;
    float f90;
    float metallic;           // 1: Fresnel's exact term uses the metal form
    highp float perceptualRoughness;
    float alpha;              // of the distribution: perceptualRoughness^2
    vec3 energyCompensation;
    vec3 specularAlbedo;      // over the whole hemisphere, with all bounces
    // The matter below the interface, which scatters or transmits: the dielectric part of a partly metallic surface.
    vec3 matterF0;            // without a film
    float matterF90;
    vec3 boundary;            // its specularAlbedo: what this leaves enters the matter
    vec3 diffuseExit;         // view-dependent factor of the diffuse lobe under lights
    float visibility;         // ambient occlusion
#if defined(HAS_BAKED_LIGHT)
    vec4 baked;               // as MaterialInputs::bakedLight
#endif
    vec3 normal, view;        // from prepareMaterial(), in the precision of the lighting
    float nov;
#if defined(HAS_IRIDESCENCE)
    Film film;
#endif
#if defined(HAS_ANISOTROPY)
    Grooves grooves;
#endif
#if defined(REFRACTION)
    Refraction refraction;
    vec3 through;             // transmitted share of the light behind
#if defined(REFRACTION_OF_PICTURE)
    Behind behind;
#endif
#endif
#if defined(REFLECTION_OF_PICTURE)
    PictureHit mirrored;
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

// Index and reflectance are two forms of the same quantity; if both are set, reflectance wins here.
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

// No real material reflects less than 2 %; a darker f0 disables reflection. Lagarde and
// de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 3.1.
float f90Of(vec3 f0) { return saturate(dot(f0, vec3(50.0 * 0.33))); }

// Without the layers above: the weights of KHR_materials_specular.
void weighReflectances(MaterialInputs material, vec3 baseColor, inout Surface surface) {
#if defined(HAS_SPECULAR_WEIGHTS)
    float f0 = f0FromReflectance(reflectanceOf(material));
    surface.f0 = f0FromSpecular(
            baseColor, material.metallic, f0, material.specularColorFactor, saturate(material.specularFactor));
    surface.f90 *= f90FromSpecular(saturate(material.specularFactor), material.metallic);
#endif
}

// The layers above change the reflectance of the base: a coat its index, a film its colour.
void coverReflectances(inout Surface surface) {
#if defined(HAS_IRIDESCENCE)
    surface.film.baseF0 = surface.f0;
#endif
#if defined(HAS_CLEAR_COAT) && defined(CLEAR_COAT_IOR_CHANGE)
    if (surface.coat.strength > 0.0) {
        vec3 covered = f0UnderCoat(surface.f0, 1.0) * saturate(surface.f0 * 50.0); // disabled reflection
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
    surface.specularAlbedo = specularDfg(surface.f0, surface.f90, dfg) * surface.energyCompensation;
}

void setMatter(Surface part, inout Surface surface) {
#if defined(HAS_IRIDESCENCE)
    surface.matterF0 = part.film.bareF0;
#else
    surface.matterF0 = part.f0;
#endif
    surface.matterF90 = part.f90;
}

#if !defined(SHADING_MODEL_SPECULAR_GLOSSINESS)

// One of the two materials that a partly metallic surface mixes: its reflectances.
Surface partOf(Surface surface, MaterialInputs material, vec3 baseColor, float metallic) {
    MaterialInputs inputs = material;
    inputs.metallic = metallic;
    Surface part = surface;
    setReflectances(inputs, baseColor, part);
    part.f90 = f90Of(part.f0);
    weighReflectances(inputs, baseColor, part);
    coverReflectances(part);
    return part;
}

void mixParts(MaterialInputs material, vec3 baseColor, highp float roughness, inout Surface surface) {
    if (surface.metallic > 0.0 && surface.metallic < 1.0) {
        vec2 dfg = splitSumTerm(shading_NoV, roughness);
        Surface matter = partOf(surface, material, baseColor, 0.0);
        Surface metal = partOf(surface, material, baseColor, 1.0);
#if defined(HAS_IRIDESCENCE)
        if (surface.film.strength == 0.0) // under lights, a film is evaluated over the mixture
#endif
        {
            setMatter(matter, surface);
        }
        Mixture mixture = mixtureOf(matter.f0, matter.f90, metal.f0, metal.f90, surface.metallic, dfg);
        surface.boundary = mixture.matterAlbedo;
        surface.specularAlbedo = mixture.albedo;
        surface.energyCompensation = mixture.compensation;
    }
}

#endif

#include "shaders/material/surface/lit_coupling.glsl"

#if defined(HAS_DIFFUSE_TRANSMISSION)

// KHR_materials_diffuse_transmission: this share of the light scattered by the diffuse lobe leaves on the other side.
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

// The tint of transmitted light: the colour of the dielectric, not its fraction of the surface.
vec3 dielectricColor(vec3 baseColor, Surface surface) {
#if defined(SHADING_MODEL_SPECULAR_GLOSSINESS)
    return surface.diffuse;
#else
    return baseColor;
#endif
}

#if defined(HAS_VOLUME_SCATTER)
#include "shaders/material/surface/scatter.glsl"
#endif

// Both interfaces: light reflected by the far side of a thin layer leaves together with the light reflected by the near
// side.
void setThrough(inout Surface surface) {
    surface.through = vec3(0.0);
    if (surface.refraction.transmission > 0.0) {
        float dielectric = 1.0 - surface.metallic;
        surface.through = transmittedShare(surface.refraction, surface.boundary) * dielectric;
        vec3 far = farReflectedShare(surface.refraction, surface.boundary) * dielectric;
        surface.energyCompensation *= 1.0 + far / max(surface.specularAlbedo, vec3(1e-4));
        surface.specularAlbedo += far;
    }
#if defined(REFRACTION_OF_PICTURE)
    surface.behind = nothingBehind();
    if (quality_screenRefraction != 0 && surface.refraction.transmission > 0.0) {
        surface.behind = behindOf(surface.refraction);
    }
#endif
}

#endif

void setLayers(MaterialInputs material, vec3 baseColor, inout Surface surface) {
#if defined(REFRACTION)
    surface.refraction = refractionOf(
            material, dielectricColor(baseColor, surface), roughnessOf(material), iorOf(material));
    surface.diffuse *= 1.0 - surface.refraction.transmission; // this share passes through instead
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
#if defined(HAS_VOLUME_SCATTER)
    setScattering(material, dielectricColor(baseColor, surface), surface);
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
    setLayers(material, baseColor, surface);
    coverReflectances(surface);
    setSpecularAlbedo(surface, roughness);
    setMatter(surface, surface);
    surface.boundary = surface.specularAlbedo;
#if !defined(SHADING_MODEL_SPECULAR_GLOSSINESS)
    mixParts(material, baseColor, roughness, surface);
#endif
#if defined(HAS_ANISOTROPY)
    surface.energyCompensation = groovesCompensation(surface.grooves, surface.energyCompensation);
#endif
#if defined(REFRACTION)
    setThrough(surface);
#endif
#if defined(REFLECTION_OF_PICTURE)
    surface.mirrored = noHit();
    if (quality_screenReflections != 0) surface.mirrored = reflectionInPicture(shading_reflected, roughness);
#endif
    surface.diffuseExit = diffuseExitOf(surface);
    surface.visibility = ambientVisibility(material);
#if defined(HAS_BAKED_LIGHT)
    surface.baked = material.bakedLight;
    // What hides the sky hides its reflections; probes have seen it.
    if (surface.baked.w >= 0.0) surface.visibility = min(surface.visibility, mix(surface.baked.w, 1.0, shareOfProbes()));
#endif
    return surface;
}
