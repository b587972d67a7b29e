// SPDX-License-Identifier: Apache-2.0
// Normal maps: decoding a texel, blending two maps, and specular anti-aliasing: the roughness that replaces the detail lost
// in mip levels. All in tangent space, with z along the surface's own normal.

// A texel [0, 1]^3 as a unit vector; scale exaggerates the slopes, like glTF's normalTexture.scale. Returns +z for an
// invalid normal.
vec3 normalFromTexel(vec3 texel, float scale) {
    vec3 n = (texel * 2.0f - 1.0f) * vec3(scale, scale, 1.0f);
    float length2 = dot(n, n);
    return length2 > 6.103515625e-5f ? n / sqrt(length2) : vec3(0.0f, 0.0f, 1.0f);
}

// The detail rotated by the rotation that takes +z to the base: Barre-Brisebois and Hill 2012, "Blending in Detail",
// the reoriented method. base, detail unit; base not straight down. Returns a unit vector: detail if base is +z, base
// if detail is +z.
vec3 blendNormalsReoriented(vec3 base, vec3 detail) {
    vec3 t = vec3(base.x, base.y, base.z + 1.0f);
    vec3 u = vec3(-detail.x, -detail.y, detail.z);
    return t * (dot(t, u) / max(t.z, 0.0009765625f)) - u;
}

// Adds the slopes and keeps z of the base, like the Unreal Development Kit; cheaper, and flatter where the base is
// steep.
// base, detail unit, base.z >= 0. Returns a unit vector, shorter where both slopes cancel at the horizon.
vec3 blendNormalsUdn(vec3 base, vec3 detail) {
    vec3 n = vec3(base.x + detail.x, base.y + detail.y, base.z);
    return n / sqrt(max(dot(n, n), 6.103515625e-5f));
}

// How far unit normals spread that have a mean of this length: alpha of a lobe that is as wide. Toksvig 2005, "Mipmapping
// Normal Maps", measures it by that length; Neubelt and Pettineo 2013, "Crafting a Next-Gen Material Pipeline for The
// Order: 1886", take the normals for a von Mises-Fisher distribution, whose concentration kappa is about
// (3 r - r^3) / (1 - r^2) (Banerjee et al. 2005). Slopes have the variance 1 / kappa along each axis then, and those of
// a lobe alpha^2 / 2. meanLength: 0..1. Returns 0 (all are alike) to 1; 1 if they cancel out.
float normalWidth(float meanLength) {
    float r = saturate(meanLength);
    float alphaSquared = 2.0f * (1.0f - r) * (1.0f + r) / max(r * (3.0f - r * r), 0.0009765625f);
    return sqrt(min(alphaSquared, 1.0f));
}

// Roughness of a surface whose normals spread: both lobes convolved, so the variances of their slopes add up. width: of
// normalWidth(), times the scale of the normal map. Returns [perceptualRoughness, 1].
float widenedPerceptualRoughness(float perceptualRoughness, float width) {
    float alpha = perceptualRoughness * perceptualRoughness;
    return sqrt(sqrt(saturate(alpha * alpha + width * width)));
}
