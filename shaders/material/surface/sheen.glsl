// SPDX-License-Identifier: Apache-2.0
// A sheen above the base and below the coat: fibres of Charlie's distribution with Neubelt's visibility. Of two directions
// the one that leaves less decides, for the lobe as for the base: so pairs of directions may be exchanged.

#include "shaders/lib/sheen.glsl"

struct Sheen {
    vec3 color;        // black: none
    highp float perceptualRoughness;
    float alpha;
    highp float albedo; // of a white one towards the view, unlimited
};

// The split-sum table's third channel; there is no fit for it.
highp float sheenAlbedoTerm(highp float cosine, highp float perceptualRoughness) {
    return textureLod(viewDfg, vec2(cosine, perceptualRoughness), 0.0).z;
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

// What the sheen sends back of the environment, given what it gathers from there.
vec3 sheenOfEnvironment(Sheen sheen, vec3 radiance) {
    return sheen.color * radiance * (sheen.albedo * sheenLimit(sheen.albedo));
}

// The factor of what lies below, for the environment.
float sheenLeaves(Sheen sheen) { return sheenAlbedoScaling(sheen.color, sheen.albedo); }

// For one light: the lobe's rgb, and the factor of what lies below in w.
vec4 sheenOfLight(Sheen sheen, float nov, float nol, float noh) {
    highp float albedo = sheenAlbedoTerm(nol, sheen.perceptualRoughness);
    float limit = min(sheenLimit(sheen.albedo), sheenLimit(albedo));
    float lobe = finite(ndfCharlie(noh, sheen.alpha) * visibilityNeubelt(nov, nol)) * limit;
    float left = min(sheenAlbedoScaling(sheen.color, sheen.albedo), sheenAlbedoScaling(sheen.color, albedo));
    return vec4(sheen.color * lobe, left);
}
