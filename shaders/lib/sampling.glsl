// SPDX-License-Identifier: Apache-2.0
// Low-discrepancy points, and their mapping to directions. z is the normal; u in [0, 1)^2.

// Van der Corput's sequence in base 2: the bits of i mirrored at the binary point. [0, 1); the low 8 bits, which do not
// fit a float and would round up to 1, are dropped. fp32 only, like hammersley(): indices and steps of 2^-24 need 24
// bits.
float radicalInverse(uint i) {
    uint bits = (i << 16u) | (i >> 16u);
    bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xAAAAAAAAu) >> 1u);
    bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xCCCCCCCCu) >> 2u);
    bits = ((bits & 0x0F0F0F0Fu) << 4u) | ((bits & 0xF0F0F0F0u) >> 4u);
    bits = ((bits & 0x00FF00FFu) << 8u) | ((bits & 0xFF00FF00u) >> 8u);
    return float(bits >> 8u) * 5.9604645e-8f; // 2^-24
}

// Point i of a Hammersley set of 1 / inverseCount points. Hammersley 1960, "Monte Carlo Methods for Solving
// Multivariable Problems".
vec2 hammersley(uint i, float inverseCount) { return vec2(float(i) * inverseCount, radicalInverse(i)); }

// A direction at azimuth 2 pi u around z and the given angle with it. Takes both sine and cosine: near the pole a sine
// computed from the cosine would be a multiple of 2^-12, coarser than the narrowest lobes.
vec3 directionFromAngles(float u, float cosTheta, float sinTheta) {
    float phi = kTwoPi * u;
    return vec3(cos(phi) * sinTheta, sin(phi) * sinTheta, cosTheta);
}

// Half vector distributed as D(h) noh. Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces",
// eq. 35, with a denominator that is a sum of positive terms: the cosine stays below 1 for the smallest alpha.
// alpha in [0, 1].
vec3 importanceSampleGgx(vec2 u, float alpha) {
    float cosTheta2 = 1.0f - u.y;
    float sinTheta2 = alpha * alpha * u.y;
    float length2 = cosTheta2 + sinTheta2;
    return directionFromAngles(u.x, sqrt(cosTheta2 / length2), sqrt(sinTheta2 / length2));
}

// Density cos / pi. Malley's method: Pharr et al. 2016, "Physically Based Rendering", section 13.6.3.
vec3 hemisphereCosineSample(vec2 u) { return directionFromAngles(u.x, sqrt(1.0f - u.y), sqrt(u.y)); }

// Density 1 / (2 pi).
vec3 hemisphereUniformSample(vec2 u) { return directionFromAngles(u.x, 1.0f - u.y, sqrt(u.y * (2.0f - u.y))); }
