// SPDX-License-Identifier: Apache-2.0
// Effect of ambient visibility on the specular lobe and on bright surfaces.

// Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 26: narrow lobes are
// occluded like a mirror, wide ones like a diffuse surface.
// nov, visibility, alpha in [0, 1]. Returns [0, 1]; 1 where visibility is 1.
float specularOcclusion(float nov, float visibility, float alpha) {
    return saturate(pow(nov + visibility, exp2(-16.0f * alpha - 1.0f)) - 1.0f + visibility);
}

// Light bounces inside crevices: bright albedos are darkened less, and coloured. Cubic fit of Jimenez et al. 2016,
// "Practical Realtime Strategies for Accurate Indirect Occlusion", section 5.
// visibility and albedo in [0, 1]. Returns [visibility, 1]: the fit alone reaches 1.0001 for white without occlusion.
vec3 multiBounceAo(float visibility, vec3 albedo) {
    vec3 a = 2.0404f * albedo - 0.3324f;
    vec3 b = -4.7951f * albedo + 0.6417f;
    vec3 c = 2.7552f * albedo + 0.6903f;
    return max(vec3(visibility), min(((visibility * a + b) * visibility + c) * visibility, 1.0f));
}
