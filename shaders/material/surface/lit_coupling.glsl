// SPDX-License-Identifier: Apache-2.0
// The share of a light that reaches the diffuse lobe below the specular one, for the standard model and
// specular-glossiness. It depends on the albedo of the specular lobe towards the view and towards the light
// (diffuseEntry() of shaders/lib/brdf.glsl).

// Total reflectance from the split-sum terms, whatever the roughness they were looked up with.
vec3 reflectedShare(Surface surface, vec3 f0, vec2 dfg) {
    vec3 albedo = specularAlbedoTerm(f0, surface.matterF90, dfg);
#if defined(REFRACTION)
    albedo += farReflectedShare(surface.refraction, albedo);
#endif
    return albedo;
}

// direction: unit, its cosine in [0, 1].
vec3 reflectedTowards(Surface surface, vec3 direction, float cosine) {
    vec3 f0 = surface.matterF0;
    highp float roughness = surface.perceptualRoughness;
#if defined(HAS_IRIDESCENCE)
    if (surface.film.strength > 0.0) f0 = mix(f0, filmF0(surface.film, cosine), surface.film.strength);
#endif
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) roughness = groovesRoughness(surface.grooves, direction);
#endif
    return reflectedShare(surface, f0, splitSumTerm(max(cosine, kMinNoV), roughness));
}

// Computed once for all lights.
vec3 diffuseExitOf(Surface surface) {
    vec3 albedo = surface.boundary;
    float alpha = surface.alpha;
#if defined(HAS_IRIDESCENCE)
    bool isMixed = surface.metallic > 0.0 && surface.metallic < 1.0;
    if (surface.film.strength > 0.0 && isMixed) albedo = reflectedTowards(surface, surface.view, surface.nov);
#endif
#if defined(HAS_ANISOTROPY)
    if (surface.grooves.amount != 0.0) { // the larger roughness has the smaller average: a bound
        albedo = reflectedTowards(surface, surface.view, surface.nov);
        alpha = min(max(surface.grooves.alpha.x, surface.grooves.alpha.y), 1.0);
    }
#endif
    vec3 average = reflectedShare(surface, surface.matterF0, dfgAverage(alpha));
#if defined(HAS_IRIDESCENCE)
    average *= 1.0 - surface.film.strength; // the average of an angle-dependent film is unknown: some light is lost
#endif
    return diffuseExitTerm(albedo, average);
}

// The factor of the diffuse lobe for one light, on either side of the surface. cosine: in [0, 1].
vec3 diffuseLeft(Surface surface, vec3 direction, float cosine) {
    return surface.diffuseExit * diffuseEntryTerm(reflectedTowards(surface, direction, cosine));
}
