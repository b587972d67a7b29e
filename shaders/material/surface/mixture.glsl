// SPDX-License-Identifier: Apache-2.0
// A partly metallic surface is a metal and a dielectric side by side (glTF 2.0, appendix B.2), and only the dielectric
// scatters and transmits. With one interpolated f0, the light that the metal reflects would be removed a second
// time, and bounces between facets would be compensated for neither.

struct Mixture {
    vec3 matterAlbedo; // of the dielectric's interface, with all bounces: the rest enters the dielectric
    vec3 albedo;       // of both interfaces
    vec3 compensation; // of both for their bounces
};

// dfg: from splitSumTerm().
Mixture mixtureOf(vec3 matterF0, float matterF90, vec3 metalF0, float metalF90, float metallic, vec2 dfg) {
    Mixture mixture;
    mixture.matterAlbedo = specularAlbedoTerm(matterF0, matterF90, dfg);
    vec3 once = mix(specularDfg(matterF0, matterF90, dfg), specularDfg(metalF0, metalF90, dfg), metallic);
    mixture.albedo = mix(mixture.matterAlbedo, specularAlbedoTerm(metalF0, metalF90, dfg), metallic);
    mixture.compensation = mixture.albedo / max(once, vec3(1e-4));
    return mixture;
}
