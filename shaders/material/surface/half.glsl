// SPDX-License-Identifier: Apache-2.0
// From here on, floats without a qualifier are half floats: float16_t on Vulkan, mediump on OpenGL ES. Included before
// the lighting of variants with kVariantHalf; all code before it stays in 32 bits. So does everything marked highp:
// sums of light, and texture coordinates (see halfFromRelaxed() of the compiler).

precision mediump float;

// Functions of math.glsl in this precision: a 32-bit result would convert everything it is combined with to 32 bits.
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
