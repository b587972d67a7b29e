// SPDX-License-Identifier: Apache-2.0
// Fuzz and cloth: lobes of fibres that stand up from the surface and catch light at grazing angles.
//   Names     as in brdf.glsl; alpha = perceptualRoughness^2, clamped like that of GGX.
//   Energy    light that the sheen reflects is removed from the layer below: sheenAlbedoScaling() with the third
//             channel of the split-sum table (DfgTable.h), which integrates ndfCharlie() * visibilityNeubelt().

// 2^-7: its square is the smallest normal half float, 2^-14. Distributions of fibres vanish at the pole anyway.
const float kMinSheenSin2 = 0.0078125f;
// Smaller cosines are clamped before taking the logarithm: 16 bits cannot represent them.
#ifdef HALF_PRECISION
const float kMinSheenCosine = 6.103515625e-5f;
#else
const float kMinSheenCosine = 1e-10f;
#endif

// Fibres as a power of the sine. Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", eq. 2.
// noh in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr in [0, (2 + 1 / alpha) / (2 pi)].
float ndfCharlie(float noh, float alpha) {
    float inverseAlpha = 1.0f / alpha;
    float sin2 = max((1.0f - noh) * (1.0f + noh), kMinSheenSin2);
    return (2.0f + inverseAlpha) * pow(sin2, 0.5f * inverseAlpha) * (0.5f * kInversePi);
}

// Velvet: an inverted Gaussian of the slope plus a uniform part. Ashikhmin and Premoze 2007, "Distribution-based
// BRDFs", normalised to an integral of 1. Wider than Charlie, and not 0 at the pole.
// noh in [0, 1], alpha in [kMinAlpha, 1]. Returns 1/sr in [0, 5 / pi].
float ndfAshikhmin(float noh, float alpha) {
    float a2 = alpha * alpha;
    float cos2 = noh * noh;
    float sin2 = max((1.0f - noh) * (1.0f + noh), kMinSheenSin2);
    float gaussian = exp(-(cos2 / sin2) / a2) / (sin2 * sin2);
    return (1.0f + 4.0f * gaussian) / (1.0f + 4.0f * a2) * kInversePi;
}

// Smooth and cheap. Neubelt and Pettineo 2013, "Crafting a Next-Gen Material Pipeline for The Order: 1886".
// nov, nol in [0, 1]. Returns 1/sr, >= 0.25, finite where both are 0.
float visibilityNeubelt(float nov, float nol) {
    return 0.25f / max(nov + nol - nov * nol, kMinVisibilityDenominator);
}

// The logarithm of Smith's lambda for Charlie: the fit of Estevez and Kulla 2017, eq. 3 and table 1, with the
// parameters interpolated by (1 - alpha)^2. cosine in [0, 1/2], alpha in [kMinAlpha, 1]. Returns [-3, 21].
float charlieLogLambdaFit(float cosine, float alpha) {
    float t = (1.0f - alpha) * (1.0f - alpha);
    float a = mix(21.5473f, 25.3245f, t);
    float b = mix(3.82987f, 3.32435f, t);
    float c = mix(0.19823f, 0.16801f, t);
    float d = mix(-1.97760f, -1.27393f, t);
    float e = mix(-4.32054f, -4.85967f, t);
    return a / (1.0f + b * pow(cosine, c)) + d * cosine + e;
}

// The same for cosines in [0, 1]: the fit is extended by symmetry about 1/2.
float charlieLogLambda(float cosine, float alpha) {
    float fit = charlieLogLambdaFit(min(cosine, 1.0f - cosine), alpha);
    return cosine < 0.5f ? fit : 2.0f * charlieLogLambdaFit(0.5f, alpha) - fit;
}

// Masking and shadowing that match Charlie, over 4 nol nov. Estevez and Kulla 2017, section 3, without their softened
// terminator, which is not reciprocal. Lambda grows nearly as fast as the cosine falls, so they are multiplied as
// logarithms: the product fits into 16 bits, lambda does not.
// nov, nol in [0, 1]; the result is too small below kMinSheenCosine; alpha in [kMinAlpha, 1]. Returns 1/sr, finite.
float visibilityCharlie(float nov, float nol, float alpha) {
    float logProduct = log(max(nov, kMinSheenCosine)) + log(max(nol, kMinSheenCosine));
    float masking = exp(charlieLogLambda(nov, alpha) + logProduct);
    float shadowing = exp(charlieLogLambda(nol, alpha) + logProduct);
    return 0.25f / (nov * nol + masking + shadowing);
}

// Scales a sheen to conserve energy. albedo: the table's third channel; smooth fibres with Neubelt's visibility reach 6
// at grazing angles, more than the incident light. Values above 1 are divided out. If light and view have different
// albedos, using the smaller result preserves reciprocity. albedo >= 0. Returns (0, 1].
float sheenLimit(float albedo) { return 1.0f / max(albedo, 1.0f); }

// The fraction left to the layer below a sheen. Estevez and Kulla 2017, section 5, as in KHR_materials_sheen: the
// brightest component decides, otherwise the base would be tinted with the complement of the sheen's colour. albedo:
// the table's third channel for one direction; using the smaller result of view and light preserves reciprocity.
// sheenColor in [0, 1]. Returns [0, 1].
float sheenAlbedoScaling(vec3 sheenColor, float albedo) {
    return 1.0f - max(sheenColor.x, max(sheenColor.y, sheenColor.z)) * min(albedo, 1.0f);
}

// The mean direction of the light that a sheen reflects, weighted by ndfCharlie() * visibilityNeubelt() * nol. Fibres
// reflect towards the side that light comes from: the mirror direction says nothing. A fit of the integral for
// perceptual roughness 0.25 to 1, within 0.03, beyond nov 0.9 within 0.13; smoother sheens take the values of 0.2.
// nov in [0, 1]. Returns the part along the view, as a multiple of view - n nov, and the part along the normal n.
vec2 sheenMeanDirection(float nov, float perceptualRoughness) {
    float r = max(perceptualRoughness, 0.2f);
    float ofView = -0.7639f + nov * (1.7284f + nov * (3.6368f + nov * (8.3682f * nov - 10.4052f)));
    float ofRoughness = r * (0.2311f * r - 3.7867f + nov * (3.3264f - 3.5316f * nov));
    float normal = 0.0934f + nov * (0.1229f - 0.2765f * nov) + r * (0.9477f - 0.5624f * r + 0.2682f * nov);
    return vec2(exp2(ofView + ofRoughness), normal);
}

// The perceptual roughness for looking up the environment around that direction: a pre-filtered GGX lobe whose mean
// direction is as long. A lobe as wide as the cosine's, 2/3 long, has roughness 1; sheens are often wider.
// mean: the result of sheenMeanDirection(). A fit, within 0.02. Returns [0, 1].
float sheenLookUpRoughness(vec2 mean, float nov) {
    float length2 = mean.x * mean.x * max((1.0f - nov) * (1.0f + nov), 0.0f) + mean.y * mean.y;
    float width = saturate(3.0f - 3.0f * sqrt(length2));
    float width2 = width * width;
    return sqrt(width * (0.62f + 0.38f * width2 * width2));
}

// Half vector distributed as ndfCharlie() noh: sine = u^(alpha / (1 + 2 alpha)) inverts its integral. Estevez and Kulla
// 2017, section 4. u in [0, 1)^2, alpha in [kMinAlpha, 1]. fp32 only: 16 bits cannot represent the smallest u.
vec3 importanceSampleCharlie(vec2 u, float alpha) {
    float power = alpha / (1.0f + 2.0f * alpha);
    float minusLog = -2.0f * power * log(max(u.y, 1e-30f));
    float phi = kTwoPi * u.x;
    float cosTheta = sqrt(oneMinusExp(minusLog));
    float sinTheta = exp(-0.5f * minusLog);
    return vec3(cos(phi) * sinTheta, sin(phi) * sinTheta, cosTheta);
}
