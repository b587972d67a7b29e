// SPDX-License-Identifier: Apache-2.0
// Normals of normal maps: decoding, and blending two of them. All in tangent space, with z along the surface's own
// normal.

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
