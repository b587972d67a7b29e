// SPDX-License-Identifier: Apache-2.0
// Occlusion of ambient light by the surroundings, by the material (ambientOcclusion, bentNormal) and in
// screen space (Quality::ao), and by the surface itself, of light from below to the normal of a map.

const int kOcclusionBent = 2; // of quality_screenOcclusion

// Screen-space occlusion: xyz: offset of the mean unoccluded direction from the normal, w: visibility.
highp vec4 screenOcclusion() {
    highp vec4 open = vec4(0.0, 0.0, 0.0, 1.0);
    if (quality_screenOcclusion != 0) {
        highp vec4 texel = texelFetch(passOcclusion, ivec2(gl_FragCoord.xy), 0);
        open.w = texel.x;
        if (quality_screenOcclusion == kOcclusionBent) open.xyz = decodeLean(texel.yzw);
    }
    return open;
}

float materialVisibility(MaterialInputs material) {
#if defined(HAS_AMBIENT_OCCLUSION)
    return saturate(material.ambientOcclusion);
#else
    return 1.0;
#endif
}

// Both contain some of the same occluders: the smaller one contains more of them.
float ambientVisibility(MaterialInputs material) {
    float visibility = materialVisibility(material);
    if (quality_screenOcclusion != 0) visibility = min(visibility, screenOcclusion().w);
    return visibility;
}

// The mean direction of the diffuse light.
highp vec3 openNormal(highp vec3 normal) {
#if defined(HAS_BENT_NORMAL)
    highp vec3 open = shading_bentNormal;
#else
    highp vec3 open = normal;
#endif
    if (quality_screenOcclusion == kOcclusionBent) {
        highp vec3 leaning = open + screenOcclusion().xyz;
        if (dot(leaning, leaning) > 1e-4) open = normalizeOrZero(leaning);
    }
    return open;
}

// Whether there is any occlusion: otherwise the code that uses it is omitted.
bool isOccluded() {
#if defined(HAS_AMBIENT_OCCLUSION)
    return true;
#else
    return quality_screenOcclusion != 0;
#endif
}

// Diffuse light, given the light without occlusion; the removed part bounces according to the albedo.
vec3 seenDiffuse(vec3 light, float visibility, vec3 albedo) {
#if defined(MULTI_BOUNCE_AMBIENT_OCCLUSION)
    vec3 seen = light;
    if (isOccluded()) seen *= multiBounceAo(visibility, albedo);
    return seen;
#else
    return light * visibility;
#endif
}

// Occlusion of a lobe around `reflected`; alpha and perceptualRoughness are its roughness.
vec3 seenReflection(vec3 light, float visibility, float nov, highp vec3 reflected, float alpha,
        highp float perceptualRoughness, vec3 albedo) {
    vec3 seen = light;
#if defined(SPECULAR_AMBIENT_OCCLUSION)
    if (isOccluded()) {
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
    }
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
