// SPDX-License-Identifier: Apache-2.0
// How much of the light behind a surface passes through it, and in which colour.

struct Refraction {
    vec3 tint;         // what remains of transmitted light without the interfaces: base colour and absorption
    float transmission;
    float ior;
    float dispersion;
    float perceptualRoughness; // for looking up the light behind
#if defined(REFRACTION_OF_PICTURE)
    highp float thickness;     // of a solid, in metres
#endif
};

// The index that bends light, if both are set.
float iorOf(MaterialInputs material) {
#if defined(HAS_REFLECTANCE) && !defined(HAS_IOR)
    return iorFromReflectance(material.reflectance);
#else
    return material.ior;
#endif
}

// Lengths are metres in world space. Without a known distance, absorption is a fraction (materials guide, 3.1.22).
vec3 absorbedOnTheWay(MaterialInputs material, float ior) {
    vec3 remains = vec3(1.0);
#if defined(HAS_ABSORPTION)
#if defined(REFRACTION_THIN) && defined(HAS_MICRO_THICKNESS)
    remains = transmittance(material.absorption, thinPathLength(shading_NoV, ior, material.microThickness));
#elif !defined(REFRACTION_THIN) && defined(HAS_THICKNESS)
    remains = transmittance(material.absorption, solidPathLength(shading_NoV, ior, material.thickness));
#else
    remains = transmittanceWithoutThickness(material.absorption);
#endif
#endif
    return remains;
}

// color: of the diffuse lobe of the dielectric, which transmitted light replaces.
Refraction refractionOf(MaterialInputs material, vec3 color, float perceptualRoughness, float ior) {
    Refraction refraction;
    refraction.transmission = saturate(material.transmission);
    refraction.ior = max(ior, 1.0);
    refraction.tint = color * absorbedOnTheWay(material, refraction.ior);
    refraction.perceptualRoughness = refractionPerceptualRoughness(saturate(perceptualRoughness), refraction.ior);
#if defined(REFRACTION_OF_PICTURE)
#if !defined(REFRACTION_THIN) && defined(HAS_THICKNESS)
    refraction.thickness = clamp(material.thickness, 0.0, kMaxSolidMeters);
#else
    refraction.thickness = 0.0;
#endif
#endif
#if defined(HAS_DISPERSION)
    refraction.dispersion = max(material.dispersion, 0.0);
#else
    refraction.dispersion = 0.0;
#endif
    return refraction;
}

// The share of the light behind that arrives, with both interfaces. f: albedo of the near interface.
vec3 transmittedShare(Refraction refraction, vec3 f) {
#if defined(REFRACTION_THIN)
    return refraction.transmission * thinTransmittance(f, refraction.tint);
#else
    return refraction.transmission * (1.0 - f) * refraction.tint;
#endif
}
