// SPDX-License-Identifier: Apache-2.0
// Fresnel's equations, more exact than Schlick's term (brdf.glsl): dielectrics and metals in one formula.
// All fp32 only: n^2 k^2 of mirrors exceeds 16 bits.

// 1 - 2^-10: keeps n and k^2 of a perfect mirror finite, and their squares within fp32.
const float kMaxExactF0 = 0.9990234375f;

// Unpolarised reflectance of a boundary between air and a medium of complex index n + ik, one component.
// Born and Wolf, "Principles of Optics", section 14.2, in the real form of Lagarde 2013, "Memo on Fresnel Equations".
// n^2 - sin^2 and a^2 = (root + t0) / 2 are written so that n = 1, n = 0 and large k do not cancel.
// cosine in [0, 1] to the normal of the facet; n >= 0, k2 = k^2 >= 0. Returns [0, 1].
float fresnelComplex(float cosine, float n, float k2) {
    float c2 = cosine * cosine;
    float s2 = (1.0f - cosine) * (1.0f + cosine);
    float n2 = n * n;
    float t0 = (n < 0.5f ? n2 - s2 : (n - 1.0f) * (n + 1.0f) + c2) - k2;
    float a2b2 = sqrt(t0 * t0 + 4.0f * n2 * k2);
    float sum = a2b2 + max(t0, -t0);
    float a2 = t0 < 0.0f ? 2.0f * n2 * k2 / sum : 0.5f * sum;
    float t1 = a2b2 + c2;
    float t2 = 2.0f * cosine * sqrt(a2);
    float s = (t1 - t2) / max(t1 + t2, 1e-10f);
    float t3 = c2 * a2b2 + s2 * s2;
    float t4 = t2 * s2;
    return clamp(0.5f * s * (1.0f + (t3 - t4) / max(t3 + t4, 1e-10f)), 0.0f, 1.0f);
}

// n and k from the artist's parameters: the reflectance r at normal incidence and the edge tint. Gulbrandsen 2014,
// "Artist Friendly Metallic Fresnel", eq. 5 to 7. A tint of 0 gives k = 0, a dielectric of reflectance r; a tint of 1
// gives a metal with the brightest edge. k^2 = (high - n) (n - 1 / high), where the two n with k = 0 are roots of the
// same equation; both factors are sums of positive terms. Returns (n, k^2).
vec2 complexIorFromTint(float f0, float edgeTint) {
    float r = min(f0, kMaxExactF0);
    float root = sqrt(r);
    float high = (1.0f + root) * (1.0f + root) / (1.0f - r);
    float low = (1.0f - r) / (1.0f + r);
    float q = 2.0f * root / (1.0f + r);
    float n = high * (1.0f - edgeTint) + low * edgeTint;
    float k2 = high * q * edgeTint * (high * q * (1.0f - edgeTint) + q / high);
    return vec2(n, max(k2, 0.0f));
}

float fresnelExact(float f0, float edgeTint, float voh) {
    vec2 ior = complexIorFromTint(f0, edgeTint);
    return fresnelComplex(voh, ior.x, ior.y);
}

// The exact counterpart of fresnelSchlick(). edgeTint: 0 for dielectrics, 1 for metals; all in [0, 1].
vec3 fresnelExact(vec3 f0, float edgeTint, float voh) {
    return vec3(fresnelExact(f0.x, edgeTint, voh), fresnelExact(f0.y, edgeTint, voh),
            fresnelExact(f0.z, edgeTint, voh));
}
