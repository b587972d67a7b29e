// SPDX-License-Identifier: Apache-2.0
// Occlusion of ambient light by the surroundings (ambientOcclusion, bentNormal), and by the surface itself, of what
// reaches a normal from a map from below.

float ambientVisibility(MaterialInputs material) {
#if defined(HAS_AMBIENT_OCCLUSION)
    return saturate(material.ambientOcclusion);
#else
    return 1.0;
#endif
}

// The mean direction of the diffuse light.
highp vec3 openNormal(highp vec3 normal) {
#if defined(HAS_BENT_NORMAL)
    return shading_bentNormal;
#else
    return normal;
#endif
}

// Diffuse light, given the light without occlusion; the removed part bounces according to the albedo.
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

// A reflection about a normal from a map: the surface itself hides light from below it. `direction`: of the lamp, or of
// the environment's look-up.
vec3 aboveHorizon(vec3 light, bool isBumped, highp vec3 direction) {
    vec3 seen = light;
    if (isBumped) seen *= horizonOcclusion(direction, shading_geometricNormal);
    return seen;
}
