// SPDX-License-Identifier: Apache-2.0
// A sheen above the base and below the coat: fibres with Charlie's distribution and Neubelt's visibility. For the lobe
// and for the base, the direction that leaves less decides, which preserves reciprocity.

#include "shaders/lib/sheen.glsl"

struct Sheen {
    vec3 color;        // black: none
    highp float perceptualRoughness;
    float alpha;
    highp float albedo; // of a white sheen towards the view, not limited to 1
};

// The split-sum table's third channel; there is no fit for it.
highp float sheenAlbedoTerm(highp float cosine, highp float perceptualRoughness) {
    return textureLod(passDfg, vec2(cosine, perceptualRoughness), 0.0).z;
}

bool hasSheen(Sheen sheen) { return max(sheen.color.x, max(sheen.color.y, sheen.color.z)) > 0.0; }

Sheen sheenOf(MaterialInputs material) {
    Sheen sheen;
    sheen.color = saturate(material.sheenColor);
    sheen.perceptualRoughness = clampedRoughness(material.sheenRoughness);
    sheen.alpha = alphaFromPerceptual(sheen.perceptualRoughness);
    sheen.albedo = sheenAlbedoTerm(shading_NoV, sheen.perceptualRoughness);
    return sheen;
}

// The direction for looking up the environment, unit, and its perceptual roughness in w.
highp vec4 sheenLookUp(Sheen sheen) {
    highp vec2 mean = sheenMeanDirection(shading_NoV, sheen.perceptualRoughness);
    highp vec3 direction = (shading_view - shading_normal * shading_NoV) * mean.x + shading_normal * mean.y;
    return vec4(normalizeOrZero(direction), sheenLookUpRoughness(mean, shading_NoV));
}

// Reflection of the environment, given its radiance over the lobe.
vec3 sheenOfEnvironment(Sheen sheen, vec3 radiance) {
    return sheen.color * radiance * (sheen.albedo * sheenLimit(sheen.albedo));
}

// The factor of the layers below, for the environment.
float sheenLeaves(Sheen sheen) { return sheenAlbedoScaling(sheen.color, sheen.albedo); }

// For one light: the lobe's rgb, and the factor of the layers below in w.
vec4 sheenOfLight(Sheen sheen, float nov, float nol, float noh) {
    highp float albedo = sheenAlbedoTerm(nol, sheen.perceptualRoughness);
    float limit = min(sheenLimit(sheen.albedo), sheenLimit(albedo));
    float lobe = finite(ndfCharlie(noh, sheen.alpha) * visibilityNeubelt(nov, nol)) * limit;
    float left = min(sheenAlbedoScaling(sheen.color, sheen.albedo), sheenAlbedoScaling(sheen.color, albedo));
    return vec4(sheen.color * lobe, left);
}
