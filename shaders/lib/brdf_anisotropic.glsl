// SPDX-License-Identifier: Apache-2.0
// The GGX lobe of brushed and woven surfaces: D, V, and the direction of image-based light. Vectors named *Local are in
// the frame of tangent x, bitangent y and normal z; alpha.x is the roughness along the tangent, alpha.y along the
// bitangent. If alpha.x = alpha.y, every function equals its isotropic counterpart in brdf.glsl.

// Weight of the shading normal in a bent one: if the view runs along the grooves, the square of the remainder is still
// a normal number in 16 bits.
const float kMinShadingNormalWeight = 0.03125f;
// A view from behind the shading normal may cancel it: the result is then short, but valid.
const float kMinBentLength2 = 6.103515625e-5f;

// Look-ups along the grain: the width of a look-up over that of the lobe across the grain (a sum of lobes along a line has a
// wider tail than one of them), and over the gap to its neighbour. They measured best for 3 to 9 look-ups under random lamps
// and in three environments.
const float kGrainWidth = 0.75f;
const float kGrainOverlap = 0.3125f;

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

// One of several look-ups of image-based light along the grain. Half vectors in the plane of the normal z and of the direction
// x along which the lobe is wider; where that plane is stretched until the lobe is round, they are as frequent as the view sees
// them (Heitz 2018, "Sampling the GGX Distribution of Visible Normals", in two dimensions): evenly across the view, from the one
// at a right angle to it down to the horizon.
// viewLocal: y across the grain, z in (0, 1]. alpha.x >= alpha.y in [kMinAlpha, 2]. share in (0, 1): of the way to the horizon.
// Returns x and z of a stretched half vector, a unit vector; the cosine between it and the stretched view; the length of the way,
// [1, 2].
vec4 grainHalfVector(vec3 viewLocal, vec2 alpha, float share) {
    vec2 view = vec2(alpha.x * viewLocal.x, viewLocal.z);
    view = view / sqrt(dot(view, view));
    float way = 1.0f + view.y, p = way * share - 1.0f;
    float cosine = sqrt(max((1.0f - p) * (1.0f + p), 0.0f));
    vec2 down = view.x < 0.0f ? vec2(-view.y, view.x) : vec2(view.y, -view.x);
    return vec4(down * p + view * cosine, cosine, way);
}

// The mirrored view, which may lie below the surface, and as w its weight: the share of visible facets that are not shadowed,
// as in visibilitySmithGgxAnisotropic(). halfVector: from grainHalfVector().
vec4 grainLookUp(vec3 viewLocal, vec2 alpha, vec4 halfVector) {
    vec3 h = vec3(alpha.x * halfVector.x, 0.0f, halfVector.y);
    h = h / sqrt(dot(h, h));
    vec3 light = h * (2.0f * (viewLocal.x * h.x + viewLocal.z * h.z)) - viewLocal;
    vec3 stretchedView = vec3(alpha.x * viewLocal.x, alpha.y * viewLocal.y, viewLocal.z);
    vec3 stretchedLight = vec3(alpha.x * light.x, alpha.y * light.y, light.z);
    float masking = light.z * sqrt(dot(stretchedView, stretchedView));
    float shadowing = viewLocal.z * sqrt(dot(stretchedLight, stretchedLight));
    float lit = light.z / max(masking + shadowing, kMinVisibilityDenominator);
    return vec4(light, light.z > 0.0f ? lit : 0.0f);
}

// The roughness of that look-up, of `count`: as wide as the lobe across the grain there and as the gap to its neighbours, as if
// one lobe blurred the other. Where a half vector h turns by a small angle, the mirrored view l turns by twice that times
// sqrt(dot(v, t)^2 + dot(v, h)^2), where t is the direction in which h moves: dl = 2 (dot(v, t) h + dot(v, h) t). The cube's lobes,
// of a view along the normal, are of half vectors that turn it by twice their angle. Returns (0, 1].
float grainLookUpRoughness(vec3 viewLocal, vec2 alpha, vec4 halfVector, float count) {
    float along = alpha.x * halfVector.x, up = halfVector.y;
    float length2 = along * along + up * up;
    float voh = viewLocal.x * along + viewLocal.z * up; // times the length
    float turnAcross2 = viewLocal.y * viewLocal.y + voh * voh / length2;
    float turnAlong2 = viewLocal.x * viewLocal.x + viewLocal.z * viewLocal.z;
    float across = kGrainWidth * alpha.y, gap = kGrainOverlap * alpha.x * halfVector.w / (count * max(halfVector.z, 0.125f));
    float alpha2 = (across * across * turnAcross2 + gap * gap * turnAlong2 / length2) / length2;
    return sqrt(min(sqrt(alpha2), 1.0f));
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
