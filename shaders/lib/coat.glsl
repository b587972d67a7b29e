// SPDX-License-Identifier: Apache-2.0
// A clear coat: a second, dielectric and isotropic lobe of index 1.5 above everything else, and what it does to the
// layers below. Light passes it twice, so the base gets transmission on the way in times transmission on the way out.
//   Before it  brdf.glsl.
//   strength   how much of the surface is coated, in [0, 1]; 0 leaves the base as it is.

const float kCoatIor = 1.5f;
const float kCoatF0 = 0.04f; // of that index in air

// A cheap visibility term for the coat, whose lobe is narrow. Kelemen and Szirmay-Kalos 2001, "A Microfacet Based
// Coupled Specular-Matte BRDF Model with Importance Sampling", section 3: G / (4 nol nov) = 1 / (4 voh^2).
// voh in [0, 1]. Returns 1/sr, >= 0.25, finite for voh = 0.
float visibilityKelemen(float voh) { return 0.25f / max(voh * voh, kMinVisibilityDenominator); }

// Kelemen's term knows no masking: where the view grazes, a coat of roughness 0.3 would send back 7 % of what arrives too
// much. What GGX's masking leaves bounds it; for a narrow lobe and its mirror direction both are the same.
// nov, nol, voh in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr, finite.
float visibilityCoat(float nov, float nol, float voh, float alpha) {
    return min(visibilityKelemen(voh), visibilitySmithGgxCorrelatedFast(nov, nol, alpha));
}

// What the coat reflects: Schlick's term (fresnelSchlick()) of index 1.5. cosine: to the facet for a lobe, to the normal
// for a whole layer. All in [0, 1].
float coatFresnel(float cosine, float strength) {
    return (kCoatF0 + (1.0f - kCoatF0) * pow5(1.0f - cosine)) * strength;
}

// What enters, or leaves, through the coat in one direction. Returns [0, 1].
float coatTransmission(float cosine, float strength) { return 1.0f - coatFresnel(cosine, strength); }

// The same of a rough coat, from the directional albedo of its lobe: a rough coat reflects far less at grazing angles than
// Fresnel's equations say of its mean plane, and what it does not reflect enters. dfg: the split-sum table (DfgTable.h) for
// this direction and the coat's roughness. Returns [0, 1].
float coatTransmissionFromDfg(vec2 dfg, float strength) { return 1.0f - mix(dfg.x, dfg.y, kCoatF0) * strength; }

// coatTransmission() for light from everywhere: weighted by 2 cosine, in closed form. Schlick's term averages to
// f0 + (1 - f0) / 21. Returns [0.914, 1].
float coatAverageTransmission(float strength) { return 1.0f - (kCoatF0 + (1.0f - kCoatF0) / 21.0f) * strength; }

// The factor of everything below the coat for one light: in and out. Symmetric, so the layers stay reciprocal.
// Returns [0, 1].
float coatAttenuation(float nov, float nol, float strength) {
    return coatTransmission(nov, strength) * coatTransmission(nol, strength);
}

// f0 of a base that borders on the coat instead of on air. From f0 follows the index (1 + r) / (1 - r), r = sqrt(f0)
// (iorFromF0()); Fresnel's equations between it and 1.5 are ((5 r - 1) / (5 - r))^2: a root and a division. A base of the
// coat's own f0 vanishes in it. f0 in [0, 1]. Returns [0, 1].
float f0UnderCoat(float f0) {
    float r = sqrt(f0);
    return sq((5.0f * r - 1.0f) / (5.0f - r));
}

// The same per component, as far as the surface is coated. f0, strength in [0, 1].
vec3 f0UnderCoat(vec3 f0, float strength) {
    return mix(f0, vec3(f0UnderCoat(f0.x), f0UnderCoat(f0.y), f0UnderCoat(f0.z)), strength);
}
