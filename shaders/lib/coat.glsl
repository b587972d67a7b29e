// SPDX-License-Identifier: Apache-2.0
// A clear coat: a second, dielectric and isotropic lobe of index 1.5 above everything else, and its effect on the
// layers below. Light crosses it twice, so the base is multiplied by the transmission on the way in and on the way out.
//   Requires   brdf.glsl, included before it.
//   strength   the fraction of the surface that is coated, in [0, 1]; 0 does not change the base.

const float kCoatIor = 1.5f;
const float kCoatF0 = 0.04f; // f0 of that index in air

// A cheap visibility term for the coat, whose lobe is narrow. Kelemen and Szirmay-Kalos 2001, "A Microfacet Based
// Coupled Specular-Matte BRDF Model with Importance Sampling", section 3: G / (4 nol nov) = 1 / (4 voh^2).
// voh in [0, 1]. Returns 1/sr, >= 0.25, finite for voh = 0.
float visibilityKelemen(float voh) { return 0.25f / max(voh * voh, kMinVisibilityDenominator); }

// Kelemen's term has no masking: at grazing views a coat of roughness 0.3 would reflect 7 % too much. The result is
// therefore limited to the visibility of GGX; for a narrow lobe and its mirror direction both are the same.
// nov, nol, voh in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr, finite.
float visibilityCoat(float nov, float nol, float voh, float alpha) {
    return min(visibilityKelemen(voh), visibilitySmithGgxCorrelatedFast(nov, nol, alpha));
}

// Reflectance of the coat: Schlick's term (fresnelSchlick()) for index 1.5. cosine: with the facet for a lobe, with the
// normal for a whole layer. All in [0, 1].
float coatFresnel(float cosine, float strength) {
    return (kCoatF0 + (1.0f - kCoatF0) * pow5(1.0f - cosine)) * strength;
}

// Transmission through the coat, in or out, in one direction. Returns [0, 1].
float coatTransmission(float cosine, float strength) { return 1.0f - coatFresnel(cosine, strength); }

// The same for a rough coat, from the directional albedo of its lobe: at grazing angles a rough coat reflects far less
// than Fresnel's equations for its mean plane, and the light that is not reflected enters. dfg: the split-sum table
// (DfgTable.h) for this direction and the coat's roughness. Returns [0, 1].
float coatTransmissionFromDfg(vec2 dfg, float strength) { return 1.0f - mix(dfg.x, dfg.y, kCoatF0) * strength; }

// coatTransmission() averaged over all directions, weighted by 2 cosine, in closed form. Schlick's term averages to f0
// + (1 - f0) / 21. Returns [0.914, 1].
float coatAverageTransmission(float strength) { return 1.0f - (kCoatF0 + (1.0f - kCoatF0) / 21.0f) * strength; }

// The factor of everything below the coat for one light: in and out. Symmetric, which preserves reciprocity.
// Returns [0, 1].
float coatAttenuation(float nov, float nol, float strength) {
    return coatTransmission(nov, strength) * coatTransmission(nol, strength);
}

// f0 of a base that borders on the coat instead of on air. f0 gives the index (1 + r) / (1 - r), r = sqrt(f0)
// (iorFromF0()); Fresnel's equations between it and 1.5 are ((5 r - 1) / (5 - r))^2: a root and a division. A base with
// the coat's own f0 reflects nothing. f0 in [0, 1]. Returns [0, 1].
float f0UnderCoat(float f0) {
    float r = sqrt(f0);
    return sq((5.0f * r - 1.0f) / (5.0f - r));
}

// The same per component, weighted by the coated fraction of the surface. f0, strength in [0, 1].
vec3 f0UnderCoat(vec3 f0, float strength) {
    return mix(f0, vec3(f0UnderCoat(f0.x), f0UnderCoat(f0.y), f0UnderCoat(f0.z)), strength);
}
