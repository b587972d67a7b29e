// SPDX-License-Identifier: Apache-2.0
// The terms of the standard material: D, V, F, the diffuse lobe, and the conversion of material parameters to their
// arguments.
//   Names     noh, nov, nol, voh: cosines between normal, view, light and half vector, in [0, 1].
//   Roughness perceptual roughness is what the user sets; alpha = perceptual^2 is what the terms take.
//   Units     D and V in 1/sr, D * V * F is the specular BRDF (V contains the 1 / (4 nol nov)).

// 0.045: alpha^2 = 4.1e-6 is the smallest value for which 1 - noh^2 + alpha^2 noh^2 still has significant bits in fp32.
const float kMinPerceptualRoughness = 0.045f;
// 2^(-14/4): alpha^2 = roughness^4 must not fall below the smallest normal half float, 2^-14.
const float kMinPerceptualRoughnessMedium = 0.089f;
const float kMinAlpha = 0.002025f; // kMinPerceptualRoughness^2
// Keeps 0.5 / 0 finite where both view and light graze; four decades below the smallest sum of visible directions. In
// 16 bits, where that is 0, it is the smallest normal number: V is at most 8192.
#ifdef HALF_PRECISION
const float kMinVisibilityDenominator = 6.103515625e-5f;
#else
const float kMinVisibilityDenominator = 1e-10f;
#endif

// Clamps to what fp32 shading can represent, [0.045, 1].
float clampPerceptualRoughness(float perceptualRoughness) {
    return clamp(perceptualRoughness, kMinPerceptualRoughness, 1.0f);
}

// Clamps to what fp16 shading can represent, [0.089, 1].
float clampPerceptualRoughnessMedium(float perceptualRoughness) {
    return clamp(perceptualRoughness, kMinPerceptualRoughnessMedium, 1.0f);
}

// Burley 2012, "Physically Based Shading at Disney", section 5.4: squaring looks linear. [0, 1] -> [0, 1].
float alphaFromPerceptual(float perceptualRoughness) { return perceptualRoughness * perceptualRoughness; }

// GGX / Trowbridge-Reitz distribution of normals. Walter et al. 2007, "Microfacet Models for Refraction through Rough
// Surfaces", eq. 33, as (alpha / (1 - noh^2 + (alpha noh)^2))^2 / pi.
// 1 - noh^2 is factored so that the subtraction is exact for noh >= 1/2. The remaining error is the rounding of noh
// itself, at most 3 % of D at kMinAlpha (see ndfGgxFromVectors). Squaring last keeps alpha^4 out of the intermediate
// values.
// noh in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr in [0, 1 / (pi alpha^2)]. fp32 only: in 16 bits 1 - noh has no
// digits near the highlight.
float ndfGgx(float noh, float alpha) {
    float a = noh * alpha;
    float k = alpha / ((1.0f - noh) * (1.0f + noh) + a * a);
    return k * k * kInversePi;
}

// The same distribution from the vectors: 1 - noh^2 = |n x h|^2 (Lagrange's identity) does not cancel, so D is accurate
// to a few ulp for any alpha, also in 16 bits. Costs one more cross product. n and h are unit vectors.
float ndfGgxFromVectors(vec3 n, vec3 h, float alpha) {
    vec3 nxh = cross(n, h);
    float a = dot(n, h) * alpha;
    float k = alpha / (dot(nxh, nxh) + a * a);
    return k * k * kInversePi;
}

// Height-correlated Smith masking and shadowing over 4 nol nov. Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs", eq. 99.
// nov, nol in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr, finite also where nov = nol = 0.
float visibilitySmithGgxCorrelated(float nov, float nol, float alpha) {
    float a2 = alpha * alpha;
    float masking = nol * sqrt(nov * nov * (1.0f - a2) + a2);
    float shadowing = nov * sqrt(nol * nol * (1.0f - a2) + a2);
    return 0.5f / max(masking + shadowing, kMinVisibilityDenominator);
}

// Without square roots: Hammon 2017, "PBR Diffuse Lighting for GGX+Smith Microsurfaces", slide 83.
// Exact at alpha 0 and 1, a few per cent too dark in between. Same ranges.
float visibilitySmithGgxCorrelatedFast(float nov, float nol, float alpha) {
    return 0.5f / max(mix(2.0f * nol * nov, nol + nov, alpha), kMinVisibilityDenominator);
}

// Separable Smith masking and shadowing over 4 nol nov, as if masking and shadowing were independent. Walter et al.
// 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 23 and 34. Never brighter than
// visibilitySmithGgxCorrelated(). Same ranges.
float visibilitySmithGgxUncorrelated(float nov, float nol, float alpha) {
    float a2 = alpha * alpha;
    float masking = nov + sqrt(nov * nov * (1.0f - a2) + a2);
    float shadowing = nol + sqrt(nol * nol * (1.0f - a2) + a2);
    return 1.0f / (masking * shadowing);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", eq. 15. f0, f90 in [0, 1].
vec3 fresnelSchlick(vec3 f0, float f90, float voh) { return f0 + (vec3(f90) - f0) * pow5(1.0f - voh); }

// Lambert 1760: a diffuse reflector scatters equally into all directions. Returns 1/sr.
float diffuseLambert() { return kInversePi; }

// Lambert's lobe times nol, extended to cosines of -wrap as if light passed through: McAuley 2013, "Extension to
// Energy-Conserving Wrapped Diffuse". (1 + wrap)^2 keeps its integral at 1. nol in [-1, 1], wrap in [0, 1].
// Returns 1/sr.
float diffuseWrapped(float nol, float wrap) {
    return max((nol + wrap) / ((1.0f + wrap) * (1.0f + wrap)), 0.0f) * kInversePi;
}

// Burley 2012, "Physically Based Shading at Disney", section 5.3: darker edges on smooth surfaces, brighter ones on
// rough surfaces. The factors of Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering",
// section 3.1.3, keep its albedo at or below 1. All in [0, 1], perceptual roughness. Returns 1/sr.
float diffuseDisney(float nov, float nol, float voh, float perceptualRoughness) {
    float grazing = perceptualRoughness * (0.5f + 2.0f * voh * voh) - 1.0f;
    float in_ = 1.0f + grazing * pow5(1.0f - nol);
    float out_ = 1.0f + grazing * pow5(1.0f - nov);
    return kInversePi * in_ * out_ * mix(1.0f, 1.0f / 1.51f, perceptualRoughness);
}

// Reflectance at normal incidence of a dielectric, [0, 1] -> [0, 0.16]; 0.5 is the usual 4 %, 1 a gemstone.
// Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 3.1.
float f0FromReflectance(float reflectance) { return 0.16f * reflectance * reflectance; }

// Fresnel's equations at normal incidence, from air. ior >= 1.
float f0FromIor(float ior) {
    float r = (ior - 1.0f) / (ior + 1.0f);
    return r * r;
}

// Inverse of f0FromIor for f0 in [0, 1). The result is at least 1. (1 + r) / (1 - r) with r = sqrt(f0), written so that
// the value subtracted from 1 is not rounded: 1 - r would have no bits left for f0 close to 1.
float iorFromF0(float f0) {
    float r = sqrt(f0);
    return (1.0f + r) * (1.0f + r) / (1.0f - f0);
}

// Metals reflect their base colour, dielectrics a grey given by reflectance. All in [0, 1].
vec3 f0FromBaseColor(vec3 baseColor, float metallic, float reflectance) {
    return mix(vec3(f0FromReflectance(reflectance)), baseColor, metallic);
}

// Metals have no diffuse lobe. All in [0, 1].
vec3 diffuseColor(vec3 baseColor, float metallic) { return baseColor * (1.0f - metallic); }

// The factor that restores the energy that rough metals lose to multiple scattering. Lagarde and Golubev 2018, "The
// Road toward Unified Rendering with Unity's High Definition Rendering Pipeline"; dfg is the table of DfgTable.h.
// dfg.y in (0, 1]. Returns values >= 1.
vec3 energyCompensation(vec3 f0, vec2 dfg) { return vec3(1.0f) + f0 * (1.0f / dfg.y - 1.0f); }

// Directional albedo of the specular lobe for one bounce: the second factor of the split sum.
// dfg.x <= dfg.y: the integrals weighted by Schlick's (1 - voh)^5 and by 1. f90 in [0, 1]: reflectance at grazing
// angles. Multiply by energyCompensation() as well.
vec3 specularDfg(vec3 f0, float f90, vec2 dfg) { return vec3(dfg.x * f90) + (dfg.y - dfg.x) * f0; }

// The two values of the split-sum table averaged over all directions, weighted by the cosine; a fit of the integrals
// with errors of 0.001 and 0.003. alpha in [0, 1].
vec2 dfgAverage(float alpha) {
    float weighted = 1.0f / (20.58f + alpha * (59.03f + alpha * 286.2f));
    float lost = alpha * (0.1269f + alpha * (1.8562f - alpha * (2.2382f - alpha * 0.8483f)));
    return vec2(weighted, 1.0f - lost);
}

// Light that the diffuse lobe scatters crosses the specular lobe above it twice, on the way in and out. The factor for
// one direction is the part that the specular lobe's directional albedo leaves. The product of both factors, divided by
// the part left on average over all directions, is reciprocal, and both lobes together reflect all incident light.
// Kelemen and Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling",
// equation 5. diffuseEntry() is one factor; diffuseExit() is the other, divided by the average.
// albedo, averageAlbedo: of the specular lobe with all bounces; slightly more than 1 counts as 1. If the average leaves
// less than a 16th, some light is lost: the quotient would have no bits left.
vec3 diffuseEntry(vec3 albedo) { return max(vec3(1.0f) - albedo, vec3(0.0f)); }
vec3 diffuseExit(vec3 albedo, vec3 averageAlbedo) {
    return diffuseEntry(albedo) / max(vec3(1.0f) - averageAlbedo, vec3(0.0625f));
}
