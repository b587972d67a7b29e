// SPDX-License-Identifier: Apache-2.0
// The GGX lobe of brushed and woven surfaces: D, V, and the direction of image-based light. Vectors named *Local are in
// the frame of tangent x, bitangent y and normal z; alpha.x is the roughness along the tangent, alpha.y along the
// bitangent. If alpha.x = alpha.y, every function equals its isotropic counterpart in brdf.glsl.

// Weight of the shading normal in a bent one: if the view runs along the grooves, the square of the remainder is still
// a normal number in 16 bits.
const float kMinShadingNormalWeight = 0.03125f;
// A view from behind the shading normal may cancel it: the result is then short, but valid.
const float kMinBentLength2 = 6.103515625e-5f;

// Look-ups along the grain: the least cosine of a half vector, and the width of a look-up over the gap to its neighbour,
// which measured best for 3 to 9 of them in three environments.
const float kMinGrainCosine = 0.015625f;
const float kGrainOverlap = 0.6f;

// The roughness along both directions. Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks": one
// is stretched by as much as the other is narrowed. alpha in [0, 1], anisotropy in [-1, 1]; a positive value stretches
// the highlight along the tangent. minAlpha: the minimum for the precision, as for clampPerceptualRoughness(). Returns
// [minAlpha, 2].
vec2 anisotropicAlpha(float alpha, float anisotropy, float minAlpha) {
    return max(alpha * vec2(1.0f + anisotropy, 1.0f - anisotropy), vec2(minAlpha));
}

// The definition of KHR_materials_anisotropy: only the direction along the tangent becomes rougher, up to 1.
// alpha, strength in [0, 1]. Returns [minAlpha, 1].
vec2 anisotropicAlphaFromStrength(float alpha, float strength, float minAlpha) {
    return max(vec2(mix(alpha, 1.0f, strength * strength), alpha), vec2(minAlpha));
}

// Burley 2012, "Physically Based Shading at Disney", eq. 13, with numerator and denominator divided by alpha.x alpha.y:
// alpha occurs at most squared and nothing cancels, which 16 bits require.
// halfLocal unit, alpha in [kMinAlpha, 2]. Returns 1/sr in [0, 1 / (pi alpha.x alpha.y)].
float ndfGgxAnisotropic(vec3 halfLocal, vec2 alpha) {
    float product = alpha.x * alpha.y;
    float x = halfLocal.x * halfLocal.x * (alpha.y / alpha.x);
    float y = halfLocal.y * halfLocal.y * (alpha.x / alpha.y);
    float inverse = 1.0f / (x + y + halfLocal.z * halfLocal.z * product);
    return (product * inverse) * (inverse * kInversePi);
}

// Height-correlated Smith masking and shadowing over 4 nol nov. Heitz 2014, "Understanding the Masking-Shadowing
// Function in Microfacet-Based BRDFs", eq. 99 with the lambda of eq. 86, multiplied by both cosines.
// Directions are unit, above the surface. Returns 1/sr, finite also where both graze.
float visibilitySmithGgxAnisotropic(vec3 viewLocal, vec3 lightLocal, vec2 alpha) {
    vec3 stretchedView = vec3(alpha.x * viewLocal.x, alpha.y * viewLocal.y, viewLocal.z);
    vec3 stretchedLight = vec3(alpha.x * lightLocal.x, alpha.y * lightLocal.y, lightLocal.z);
    float masking = lightLocal.z * sqrt(dot(stretchedView, stretchedView));
    float shadowing = viewLocal.z * sqrt(dot(stretchedLight, stretchedLight));
    return 0.5f / max(masking + shadowing, kMinVisibilityDenominator);
}

// Half vector distributed as D(h) noh: a disc stretched by both roughnesses. Burley 2012, eq. 14, without the quotient
// that is infinite at the rim. u in [0, 1)^2, alpha >= 0. fp32 only: a roughness ratio of 250 multiplies the rounding
// of 2 pi u.
vec3 importanceSampleGgxAnisotropic(vec2 u, vec2 alpha) {
    float phi = kTwoPi * u.x;
    float radius = sqrt(u.y);
    vec3 h = vec3(alpha.x * radius * cos(phi), alpha.y * radius * sin(phi), sqrt(1.0f - u.y));
    return h / sqrt(dot(h, h));
}

// One of several look-ups of image-based light along the grain: half vectors in the plane of the normal z and of the
// direction x along which the lobe is wider, as often as D leans that way if u is uniform in (-1, 1). Its marginal
// density of slopes is that of a disc seen from the side, so no function needs inverting.
// viewLocal: y across the grain. alpha.x >= alpha.y in [kMinAlpha, 2]. Returns the mirrored view, which may lie below
// the surface, and as w its weight: visible and lit facets, as in visibilitySmithGgxAnisotropic().
vec4 grainLookUp(vec3 viewLocal, vec2 alpha, float u) {
    float up = sqrt(max((1.0f - u) * (1.0f + u), 0.0f)), along = alpha.x * u;
    float inverse = 1.0f / sqrt(along * along + up * up);
    vec3 h = vec3(along * inverse, 0.0f, up * inverse);
    float voh = viewLocal.x * h.x + viewLocal.z * h.z;
    vec3 light = h * (2.0f * voh) - viewLocal;
    vec3 stretchedView = vec3(alpha.x * viewLocal.x, alpha.y * viewLocal.y, viewLocal.z);
    vec3 stretchedLight = vec3(alpha.x * light.x, alpha.y * light.y, light.z);
    float masking = light.z * sqrt(dot(stretchedView, stretchedView));
    float shadowing = viewLocal.z * sqrt(dot(stretchedLight, stretchedLight));
    float lit = light.z / max(masking + shadowing, kMinVisibilityDenominator);
    float weight = max(voh, 0.0f) / max(h.z, kMinGrainCosine) * max(lit, 0.0f);
    return vec4(light, light.z > 0.0f ? weight : 0.0f);
}

// The roughness of that look-up: as wide as the lobe across the grain there, or as the gap to its neighbours.
// spacing: half of the difference of their u. Returns (0, 1].
float grainLookUpRoughness(vec2 alpha, float u, float spacing) {
    float up2 = max((1.0f - u) * (1.0f + u), 0.0f), along = alpha.x * u;
    float length2 = along * along + up2;
    float across = alpha.y / sqrt(length2);
    float gap = kGrainOverlap * alpha.x * spacing / (sqrt(up2) * length2);
    return sqrt(min(max(across, gap), 1.0f));
}

// The normal about which image-based light is reflected, since the cube map holds isotropic lobes only: the shading
// normal turned towards the view within the plane across the grooves. Revie 2012, "Implementing Fur Using Deferred
// Shading", GPU Pro 2, as used by McAuley 2015, "Rendering the World of Far Cry 4". The amount vanishes with the
// roughness, where the lobe is that of a mirror.
// n, t, b, view unit, and n is the cross product of t and b; anisotropy in [-1, 1], perceptualRoughness in [0, 1].
// Returns a unit vector; n for anisotropy 0.
vec3 anisotropicNormal(vec3 n, vec3 t, vec3 b, vec3 view, float anisotropy, float perceptualRoughness) {
    vec3 across = anisotropy < 0.0f ? t : b;
    float amount = max(anisotropy, -anisotropy) * saturate(5.0f * perceptualRoughness);
    vec3 bent = (view - across * dot(across, view)) * amount + n * max(1.0f - amount, kMinShadingNormalWeight);
    return bent / sqrt(max(dot(bent, bent), kMinBentLength2));
}
