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

// What a * b has beyond the rounded product, without a fused multiply-add (Dekker 1971, "A floating-point technique for
// extending the available precision", with Veltkamp's split). Exact for factors from 1e-15 to 1e15. fp32 only.
float productError(float a, float b) {
    float aSplit = 4097.0f * a;
    float bSplit = 4097.0f * b;
    float aHigh = aSplit - (aSplit - a);
    float bHigh = bSplit - (bSplit - b);
    float aLow = a - aHigh;
    float bLow = b - bHigh;
    return ((aHigh * bHigh - a * b) + aHigh * bLow + aLow * bHigh) + aLow * bLow;
}

// x - modulus * floor(x / modulus), where a large quotient costs no digits of the rest. The rounded quotient may miss
// the floor, so the result may be outside of [0, modulus) by as much. fp32 only.
float moduloStep(float x, float modulus) {
    float quotient = floor(x / modulus);
    return (x - quotient * modulus) - productError(quotient, modulus);
}

// (seconds + rest) modulo `modulus`, in [0, modulus) for modulus > 0: to the last bits of `rest` although `seconds` may
// be years. The second step corrects a missed floor, the third the sum. The error is a few roundings of `modulus`; beyond
// 2^24 periods it grows with their number. fp32 only.
float timeModulo(float seconds, float rest, float modulus) {
    float x = moduloStep(moduloStep(seconds, modulus), modulus);
    x = moduloStep(x + rest, modulus);
    return x < modulus ? x : 0.0f; // a rest of less than half a digit below 0 rounds to the modulus
}
