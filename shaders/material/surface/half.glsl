// SPDX-License-Identifier: Apache-2.0
// From here on floats are half floats where nothing says otherwise: float16_t on Vulkan, mediump on OpenGL ES. Put
// before the lighting of variants with kVariantHalf; all that came before keeps 32 bits. So does what says highp: sums of
// light, and coordinates of textures (see halfFromRelaxed() of the compiler).

precision mediump float;

// What math.glsl computes, in this precision: a result of 32 bits would draw all that it meets into 32 bits.
float sqMedium(float x) { return x * x; }
float pow5Medium(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}
float saturateMedium(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturateMedium(vec3 x) { return clamp(x, 0.0, 1.0); }

#define sq sqMedium
#define pow5 pow5Medium
#define saturate saturateMedium
