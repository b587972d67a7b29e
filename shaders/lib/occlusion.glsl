// SPDX-License-Identifier: Apache-2.0
// Specular occlusion from a direction as well as an amount (ao.glsl): the visible sky and the lobe are both cones, and
// their intersection is lit. Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// section 6.
//   Versine   1 - cosine of a cone's half angle: the solid angle over 2 pi. It keeps the digits of narrow cones.

// The cone around the bent normal that has this cosine-weighted visibility: visibility = sin^2. [0, 1] -> [0, 1].
float visibilityConeVersine(float visibility) {
    float hidden = sqrt(max(1.0f - visibility, 0.0f));
    return visibility / (1.0f + hidden);
}

// The cone that holds most of the lobe: Jimenez et al. 2016, eq. 31, cosine = 10^(-roughness^2), which is 0.1 at 1.
// perceptualRoughness in [0, 1]. Returns [0, 0.9].
float specularConeVersine(float perceptualRoughness) {
    return oneMinusExp(2.3025851f * perceptualRoughness * perceptualRoughness);
}

// The half angle of a cone, without the cancellation of acos() near 1: 2 asin(sqrt(v / 2)), which equals 2 atan(sqrt(v
// / (2 - v))). versine in [0, 1]. Returns radians, [0, pi / 2].
float coneAngle(float versine) { return 2.0f * atan(sqrt(versine / (2.0f - versine))); }

// The intersection of two cones over 2 pi: the narrower cone, nothing, or a smooth step in between. Oat and Sander
// 2007, "Ambient Aperture Lighting", section 3.3. versines in [0, 1], cosine between the axes in [-1, 1].
// fp32 only, because of acos() near 1.
float coneIntersection(float versineA, float versineB, float cosine) {
    float a = coneAngle(versineA);
    float b = coneAngle(versineB);
    float between = acos(clamp(cosine, -1.0f, 1.0f));
    float inside = max(a, b) - min(a, b);
    float t = saturate((a + b - between) / max(a + b - inside, 1e-4f));
    return t * t * (3.0f - 2.0f * t) * min(versineA, versineB);
}

// The part of the specular cone that sees the sky. bentCosine: between the bent normal and the reflected direction, in
// [-1, 1]; visibility, perceptualRoughness in [0, 1]. Returns [0, 1]. fp32 only: 16 bits cannot resolve the angles over
// which a mirror becomes hidden.
float specularOcclusionCones(float visibility, float bentCosine, float perceptualRoughness) {
    float lobe = max(specularConeVersine(perceptualRoughness), 1e-4f);
    return saturate(coneIntersection(visibilityConeVersine(visibility), lobe, bentCosine) / lobe);
}

// A normal map can tilt reflections below the surface that carries it: they fade as they sink. Russell 2015, "Horizon
// Occlusion for Normal Mapped Reflections". reflected and geometricNormal unit. Returns [0, 1], 1 above the surface.
float horizonOcclusion(vec3 reflected, vec3 geometricNormal) {
    float above = saturate(1.0f + dot(reflected, geometricNormal));
    return above * above;
}
