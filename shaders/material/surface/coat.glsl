// SPDX-License-Identifier: Apache-2.0
// A clear coat above everything else, with its own normal and roughness. The albedo of its lobe is removed from the
// layers below. Of the view and light directions, the one with the smaller transmission decides, which preserves
// reciprocity; a white base below the coat reflects all incident light.

#include "shaders/lib/coat.glsl"

struct Coat {
    float strength; // 0: none
    highp float perceptualRoughness;
    float alpha;
    vec3 normal;
    highp float nov;
    vec2 dfg;       // for the coat's lobe towards the view
};

Coat coatOf(MaterialInputs material) {
    Coat coat;
    coat.strength = saturate(material.clearCoat);
    coat.perceptualRoughness = shadedRoughness(material.clearCoatRoughness);
    coat.alpha = alphaFromPerceptual(coat.perceptualRoughness);
    coat.normal = shading_clearCoatNormal;
    coat.nov = max(dot(shading_clearCoatNormal, shading_view), kMinNoV);
    coat.dfg = splitSumTerm(coat.nov, coat.perceptualRoughness);
    return coat;
}

// Reflectance of the coat in a white environment.
float coatAlbedo(Coat coat) { return mix(coat.dfg.x, coat.dfg.y, kCoatF0) * coat.strength; }

// The factor of the layers below, for the environment.
float coatLeaves(Coat coat) { return coatTransmissionFromDfg(coat.dfg, coat.strength); }

// The factor for one light. nol: at the coat's normal, in [0, 1].
float coatLeavesOfLight(Coat coat, float nol) {
    vec2 dfg = splitSumTerm(max(nol, kMinNoV), coat.perceptualRoughness);
    return min(coatLeaves(coat), coatTransmissionFromDfg(dfg, coat.strength));
}

// The coat's own lobe for one light, before nol.
float coatOfLight(Coat coat, vec3 halfway, float nol, float voh) {
    float v = finite(visibilityCoat(coat.nov, nol, voh, coat.alpha));
    return finite(distributionTerm(coat.normal, halfway, coat.alpha) * v) * coatFresnel(voh, coat.strength);
}
