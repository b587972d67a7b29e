// SPDX-License-Identifier: Apache-2.0
// Basic arithmetic that every other file of shaders/lib uses: include it first.
// Literals have the suffix f because this text is also compiled as C++ (LibCpp.h), where 1.0 would be a double.

// An output parameter in both languages: void f(OUT(vec3) result).
#ifdef __cplusplus
#define OUT(type) type&
#else
#define OUT(type) out type
#endif

const float kPi = 3.14159265358979f;
const float kTwoPi = 6.28318530717959f;
const float kInversePi = 0.318309886183791f;

float sq(float x) { return x * x; }

// x^5 with three multiplications; pow() would cost a logarithm and an exponential.
float pow5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

float saturate(float x) { return clamp(x, 0.0f, 1.0f); }
vec3 saturate(vec3 x) { return clamp(x, 0.0f, 1.0f); }

// 1 - e^-x without cancellation, for x >= 0: below 1/8 the series, whose remainder is at most 5e-8 of the result.
float oneMinusExp(float x) {
    float series = x * (1.0f - x * (0.5f - x * (0.16666667f - x * (0.041666667f - x * 0.0083333333f))));
    return x < 0.125f ? series : 1.0f - exp(-x);
}
