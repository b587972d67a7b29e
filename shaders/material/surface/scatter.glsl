// SPDX-License-Identifier: Apache-2.0
// KHR_materials_volume_scatter: what a solid scatters becomes part of the diffuse lobe and of the one behind it, so that
// every light and the environment shade it like those. The formulas: shaders/lib/scatter.glsl.

#include "shaders/lib/scatter.glsl"

// The medium inside, by colour.
struct Medium {
    vec3 depth;       // across the ball
    vec3 steady;      // the part of it that is left if forward scattering does not count as a change of direction
    vec3 similar;     // the depth of the similar medium
    vec3 similarLoss;
    vec3 behind;      // the part of scattered light that comes from the far side
};

Medium mediumOf(MaterialInputs material, float ior) {
    Medium medium;
    float anisotropy = clamp(material.scatterAnisotropy, -kMaxScatterAnisotropy, kMaxScatterAnisotropy);
    vec3 loss = scatterLoss(saturate(material.multiscatterColor));
    vec3 similarity = scatterSimilarity(loss, anisotropy);
    vec3 depth = max(material.absorption * material.thickness, 0.0);
    medium.depth = min(depth, vec3(kMaxScatterDepth));
    medium.steady = min(depth * min(similarity, vec3(1.0)), vec3(kMaxScatterDepth));
    medium.similar = min(depth * similarity, vec3(kMaxScatterDepth));
    medium.similarLoss = min(loss * inversesqrt(max(similarity, vec3(0.0009765625))), vec3(1.0));
    medium.behind = scatteredFromBehind(medium.similar, anisotropy, ior);
    return medium;
}

// Light that enters by transmission, of the given colour. What is scattered forwards comes from behind like the light
// that crosses the ball, but from all of it.
void scatterTransmitted(Medium medium, vec3 color, inout Surface surface) {
    float chord = refractedCosine(surface.nov, surface.refraction.ior);
    vec3 crossed = transmittance(medium.depth, chord);
    vec3 steady = transmittance(medium.steady, chord);
    vec3 scattered = (1.0 - steady) * scatteredShare(medium.similar, medium.similarLoss, surface.refraction.ior);
    surface.transmitted += color * (steady - crossed + scattered * medium.behind);
    surface.diffuse += color * scattered * (1.0 - medium.behind);
}

// Light that enters by diffuse transmission leaves by it, too, or is reflected inside by the diffuse lobe and crosses
// the ball again. Diffuse light that crosses it comes from everywhere.
void scatterDiffuse(Medium medium, vec3 leaves, vec3 reflected, inout Surface surface) {
    vec3 crossed = ballTransmittance(medium.steady);
    vec3 scattered = (1.0 - crossed) * scatteredShare(medium.similar, medium.similarLoss, 1.0);
    vec3 once = crossed + scattered;
    vec3 more = once * reflected * once / max(1.0 - once * reflected, vec3(0.0009765625));
    vec3 color = surface.transmitted * leaves;
    surface.transmitted = color * (0.5 * (crossed + more) + scattered * medium.behind);
    surface.diffuse += color * (0.5 * (crossed + more) + scattered * (1.0 - medium.behind));
}

// color: of the dielectric.
void setScattering(MaterialInputs material, vec3 color, inout Surface surface) {
    if (max3(material.multiscatterColor) > 0.0 && max3(material.absorption) > 0.0 && material.thickness > 0.0) {
        Medium medium = mediumOf(material, surface.refraction.ior);
        vec3 reflected = surface.diffuse;
        if (material.diffuseTransmission > 0.0) {
            vec3 leaves = saturate(material.diffuseTransmissionColor) * saturate(material.diffuseTransmission);
            scatterDiffuse(medium, leaves, reflected, surface);
        }
        if (surface.refraction.transmission > 0.0) {
            float share = surface.refraction.transmission * (1.0 - surface.metallic);
            scatterTransmitted(medium, color * share, surface);
        }
    }
}
