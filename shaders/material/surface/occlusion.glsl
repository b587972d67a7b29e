// SPDX-License-Identifier: Apache-2.0
// Of ambient light only: what the surroundings of a point take from it (ambientOcclusion, bentNormal), and what the surface
// itself takes from reflections that a normal map turns below it.

float ambientVisibility(MaterialInputs material) {
#if defined(HAS_AMBIENT_OCCLUSION)
    return saturate(material.ambientOcclusion);
#else
    return 1.0;
#endif
}

// Where diffuse light comes from on average.
highp vec3 openNormal(highp vec3 normal) {
#if defined(HAS_BENT_NORMAL)
    return shading_bentNormal;
#else
    return normal;
#endif
}

// Diffuse light, given what there would be in the open; what is taken bounces as often as the albedo lets it.
vec3 seenDiffuse(vec3 light, float visibility, vec3 albedo) {
#if defined(HAS_AMBIENT_OCCLUSION) && defined(MULTI_BOUNCE_AMBIENT_OCCLUSION)
    return light * multiBounceAo(visibility, albedo);
#else
    return light * visibility;
#endif
}

// The same for a lobe around `reflected`; alpha and perceptualRoughness are its roughness.
vec3 seenReflection(vec3 light, float visibility, float nov, highp vec3 reflected, float alpha,
        highp float perceptualRoughness, vec3 albedo) {
    vec3 seen = light;
#if defined(HAS_AMBIENT_OCCLUSION) && defined(SPECULAR_AMBIENT_OCCLUSION)
#if defined(SPECULAR_OCCLUSION_BENT_NORMALS)
    highp float cosine = dot(openNormal(shading_normal), normalizeOrZero(reflected));
    highp float visible = specularOcclusionCones(visibility, cosine, perceptualRoughness);
#else
    highp float visible = specularOcclusion(nov, visibility, alpha);
#endif
#if defined(MULTI_BOUNCE_AMBIENT_OCCLUSION)
    seen *= multiBounceAo(visible, albedo);
#else
    seen *= visible;
#endif
#endif
    return seen;
}

// Light around a direction that was reflected at a normal of a map: the surface itself hides what comes from below it.
vec3 aboveHorizon(vec3 light, bool isBumped, highp vec3 reflected) {
    vec3 seen = light;
    if (isBumped) seen *= horizonOcclusion(reflected, shading_geometricNormal);
    return seen;
}
