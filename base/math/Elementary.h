// SPDX-License-Identifier: Apache-2.0
/// Elementary functions with the same bits on every machine. Those of the C++ library differ from release to release:
/// glibc 2.41 rounds sinf() and its like correctly where 2.36 did not, and chooses code by the CPU. A rotation of
/// texture coordinates then differs in its last bit, and an image with it.
///   Method  sums, products, quotients, square roots, fma() and exact functions (rint, frexp, ldexp), which IEEE 754
///           defines to the bit: argument reduction and Taylor series (J.-M. Muller, Elementary Functions, 3rd edition,
///           chapters 3 and 11), in double precision without contraction.
///   Error   double: at most 4 units in the last place, pow(): 2 (2 + |y log2(x)|), or |y| for an integer
///           up to 32. float: that of double, rounded, so nearly always correctly. tests/base/math/ElementaryTest.cpp
///           measures both.
///   Limits  sin(), cos(), tan(): full accuracy for |x| < 2^30. Not for NaN payloads: a NaN gives a NaN.
///   Special values are those of the C++ library (C17, annex F.10), without floating-point exceptions.
///   Thread  any; pure functions. Cost: 10 to 40 ns, 1.2 to 5 times glibc 2.36: not for inner loops over pixels.
#pragma once

#include <concepts>

namespace filament_core::elementary {

double exp(double x);
double exp2(double x);
double log(double x);
double log2(double x);
double log10(double x);
double pow(double x, double y);
double cbrt(double x);
double hypot(double x, double y);
double sin(double x);
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);

// clang-format off
inline float exp(float x) { return static_cast<float>(exp(static_cast<double>(x))); }
inline float exp2(float x) { return static_cast<float>(exp2(static_cast<double>(x))); }
inline float log(float x) { return static_cast<float>(log(static_cast<double>(x))); }
inline float log2(float x) { return static_cast<float>(log2(static_cast<double>(x))); }
inline float log10(float x) { return static_cast<float>(log10(static_cast<double>(x))); }
inline float cbrt(float x) { return static_cast<float>(cbrt(static_cast<double>(x))); }
inline float sin(float x) { return static_cast<float>(sin(static_cast<double>(x))); }
inline float cos(float x) { return static_cast<float>(cos(static_cast<double>(x))); }
inline float tan(float x) { return static_cast<float>(tan(static_cast<double>(x))); }
inline float asin(float x) { return static_cast<float>(asin(static_cast<double>(x))); }
inline float acos(float x) { return static_cast<float>(acos(static_cast<double>(x))); }
inline float atan(float x) { return static_cast<float>(atan(static_cast<double>(x))); }
inline float pow(float x, float y) { return static_cast<float>(pow(static_cast<double>(x), static_cast<double>(y))); }
inline float hypot(float x, float y) { return static_cast<float>(hypot(static_cast<double>(x), static_cast<double>(y))); }
inline float atan2(float y, float x) { return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x))); }
// clang-format on

// An integer would be ambiguous: write 10.0.
void pow(std::integral auto x, auto y) = delete;

} // namespace filament_core::elementary
