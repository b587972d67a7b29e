// SPDX-License-Identifier: Apache-2.0
// Light from behind a surface, for models that transmit it: its direction, its blur, its colour. The environment replaces
// the scene behind, unless the material refracts the scene colour. Directions are in 32 bits, whatever the precision of
// the lighting.

#include "shaders/material/surface/transmission.glsl"
#if defined(REFRACTION_OF_PICTURE)
#include "shaders/material/surface/scene_color.glsl"
#endif

// Contribution of the far interface to the albedo f of the near one. A ball's is omitted: that light leaves elsewhere.
vec3 farReflectedShare(Refraction refraction, vec3 f) {
#if defined(REFRACTION_THIN)
    return refraction.transmission * thinFarReflectance(f, refraction.tint);
#else
    return vec3(0.0);
#endif
}

#if defined(REFRACTION_THIN)
// A light behind a thin layer, including its cosine: the reflection of the light mirrored to the front, as if all of it
// were reflected, in the form of KHR_materials_transmission's implementation notes. Balls focus light into a point,
// which is not shown here.
vec3 lightThrough(Refraction refraction, vec3 normal, vec3 view, float nov, Light light) {
    vec3 seen = vec3(0.0);
    float cosine = dot(normal, light.direction);
    if (cosine < 0.0) {
        vec3 halfway = normalizeOrZero(view + light.direction - normal * (2.0 * cosine));
        float alpha = alphaFromPerceptual(clampedRoughness(refraction.perceptualRoughness));
        float dv = distributionTerm(normal, halfway, alpha) * visibilityTerm(nov, min(-cosine, 1.0), alpha);
        seen = (finite(dv) * -cosine) * light.illuminance;
    }
    return seen;
}
#endif

// The environment behind, before frameUniforms.ambient.x.
vec3 environmentBehind(Refraction refraction) {
#if defined(REFRACTION_THIN)
    return environmentRadiance(-shading_view, refraction.perceptualRoughness);
#else
    float roughness = refraction.perceptualRoughness;
    vec3 radiance = environmentRadiance(refractedSolid(shading_normal, shading_view, refraction.ior), roughness);
#if defined(HAS_DISPERSION)
    if (refraction.dispersion > 0.0) { // green keeps its direction
        vec3 ior = dispersedIor(refraction.ior, refraction.dispersion);
        radiance.r = environmentRadiance(refractedSolid(shading_normal, shading_view, ior.r), roughness).r;
        radiance.b = environmentRadiance(refractedSolid(shading_normal, shading_view, ior.b), roughness).b;
    }
#endif
    return radiance;
#endif
}
