// SPDX-License-Identifier: Apache-2.0
#include "base/math/Elementary.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::elementary {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

// Constants as sums of doubles: what the first lacks, the next has.
constexpr double kLn2High = 0x1.62e42fefa38p-1, kLn2Low = 0x1.ef35793c7673p-45;
constexpr double kHalfPi = 0x1.921fb54442d18p0, kHalfPiMiddle = 0x1.1a62633145c07p-54,
                 kHalfPiLow = -0x1.f1976b7ed8fbcp-110;

constexpr double kSmallest = std::numeric_limits<double>::min();

/// The sum of coefficients[k] * x^k (Horner).
template <size_t N>
double polynomial(std::array<double, N> const& coefficients, double x) {
    double sum = coefficients[N - 1];
    for (size_t k = N - 1; k-- > 0;) sum = sum * x + coefficients[k];
    return sum;
}

/// 1 / (first + step k)! with alternating signs if step is 2.
template <size_t N>
constexpr std::array<double, N> reciprocalFactorials(int first, int step) {
    std::array<double, N> values{};
    double factorial = 1;
    for (int i = 2; i <= first; ++i) factorial *= i;
    for (size_t k = 0; k < N; ++k) {
        values[k] = (step == 2 && k % 2 == 1 ? -1 : 1) / factorial;
        for (int i = 1; i <= step; ++i) factorial *= first + step * static_cast<int>(k) + i;
    }
    return values;
}

/// 1 / (2 k + 1), with alternating signs or without.
template <size_t N>
constexpr std::array<double, N> oddReciprocals(bool alternates) {
    std::array<double, N> values{};
    for (size_t k = 0; k < N; ++k) values[k] = (alternates && k % 2 == 1 ? -1.0 : 1.0) / static_cast<double>(2 * k + 1);
    return values;
}

/// e^x for |x| <= ln(2) / 2.
double expNearZero(double x) {
    static constexpr auto kTerms = reciprocalFactorials<13>(2, 1); // 0.35^15 / 15! = 1e-19
    return 1 + (x + x * x * polynomial(kTerms, x));
}

/// x = mantissa * 2^exponent, with the mantissa from sqrt(1/2) to sqrt(2). x > 0, finite.
struct Parts {
    double mantissa;
    int exponent;
};

Parts partsOf(double x) {
    Parts parts{};
    parts.mantissa = std::frexp(x, &parts.exponent);
    if (parts.mantissa < std::numbers::sqrt2 / 2) parts.mantissa *= 2, --parts.exponent;
    return parts;
}

/// ln(m) for m from sqrt(1/2) to sqrt(2): 2 artanh(s) with s = (m - 1) / (m + 1), |s| < 0.172. The difference
/// d = m - 1 is exact, and 2 s = d - s d, so that ln(m) = d - s d + 2 (artanh(s) - s) has its largest term exactly.
double logOfMantissa(double m) {
    static constexpr auto kTerms = oddReciprocals<12>(false); // 0.172^25 / 25 = 3e-21
    const double d = m - 1, s = d / (m + 1), square = s * s;
    const double rest = 2 * s * (polynomial(kTerms, square) - 1);
    return d - s * d + rest;
}

/// What log(), log2() and log10() give without calculation; NaN: nothing.
double specialLog(double x) {
    if (x == 0) return -kInfinity;
    return x == kInfinity ? kInfinity : kNan;
}

bool isPositiveAndFinite(double x) { return x > 0 && x < kInfinity; }

/// x^n by squaring: pow(x, 1) is x, and a square is correctly rounded.
double integerPower(double x, int n) {
    double power = 1;
    for (; n > 0; n /= 2, x *= x) {
        if (n % 2 == 1) power *= x;
    }
    return power;
}
constexpr double kLargestInteger = 32;

// ---------------------------------------------------------------------------------------------- angles

/// x = quadrant * pi/2 + rest, |rest| <= pi/4; the quadrant modulo 4.
struct Reduced {
    double rest;
    int quadrant;
};

Reduced reduced(double x) {
    const double turns = std::rint(x * (2 / kPi));
    double rest = std::fma(-turns, kHalfPi, x);
    rest = std::fma(-turns, kHalfPiMiddle, rest);
    rest = std::fma(-turns, kHalfPiLow, rest);
    const double quadrant = turns - 4 * std::floor(turns / 4);
    return { rest, static_cast<int>(quadrant) };
}

double sinNearZero(double x) {
    static constexpr auto kTerms = reciprocalFactorials<8>(3, 2); // x^19 / 19! = 8e-20
    const double square = x * x;
    return x - x * square * polynomial(kTerms, square);
}

double cosNearZero(double x) {
    static constexpr auto kTerms = reciprocalFactorials<8>(4, 2); // x^20 / 20! = 3e-21
    const double square = x * x, half = square / 2, head = 1 - half;
    return head + ((1 - head) - half + square * square * polynomial(kTerms, square));
}

double sineOf(Reduced const& angle) {
    const double value = angle.quadrant % 2 == 0 ? sinNearZero(angle.rest) : cosNearZero(angle.rest);
    return angle.quadrant >= 2 ? -value : value;
}

/// atan(x) for x from 0 to 1: the angle of the nearest quarter, and the series of what is left (|t| <= 1/8).
double atanOfPart(double x) {
    static constexpr std::array<double, 5> kAngles{ 0, 0x1.f5b75f92c80ddp-3, 0x1.dac670561bb4fp-2, 0x1.4978fa3269ee1p-1,
                                                    0x1.921fb54442d18p-1 };
    static constexpr auto kTerms = oddReciprocals<9>(true); // 0.125^19 / 19 = 4e-19
    const double quarter = std::rint(x * 4), c = quarter / 4;
    const double t = (x - c) / (1 + x * c), square = t * t;
    return kAngles[static_cast<size_t>(quarter)] + (t + t * (polynomial(kTerms, square) - 1));
}

} // namespace

double exp2(double x) {
    if (!(std::abs(x) < 1100)) return std::isnan(x) ? x : x > 0 ? kInfinity : 0;
    const double whole = std::rint(x), part = x - whole;
    return std::ldexp(expNearZero(part * std::numbers::ln2), static_cast<int>(whole));
}

double exp(double x) {
    if (!(std::abs(x) < 760)) return std::isnan(x) ? x : x > 0 ? kInfinity : 0;
    const double whole = std::rint(x * std::numbers::log2e);
    return std::ldexp(expNearZero((x - whole * kLn2High) - whole * kLn2Low), static_cast<int>(whole));
}

double log(double x) {
    if (!isPositiveAndFinite(x)) return specialLog(x);
    const Parts parts = partsOf(x);
    return parts.exponent * kLn2High + (logOfMantissa(parts.mantissa) + parts.exponent * kLn2Low);
}

double log2(double x) {
    if (!isPositiveAndFinite(x)) return specialLog(x);
    const Parts parts = partsOf(x);
    return parts.exponent + logOfMantissa(parts.mantissa) * std::numbers::log2e;
}

double log10(double x) { return log(x) * std::numbers::log10e; }

double pow(double x, double y) {
    if (y == 0 || x == 1) return 1;
    if (std::isnan(x) || std::isnan(y)) return kNan;
    const bool isInteger = std::isinf(y) || std::floor(y) == y;
    const bool isOdd = isInteger && !std::isinf(y) && std::floor(y / 2) * 2 != y;
    if (x < 0 && !isInteger && !std::isinf(x)) return kNan;
    const double sign = std::signbit(x) && isOdd ? -1 : 1;
    if (std::abs(x) == 1) return sign;
    if (isInteger && std::abs(y) <= kLargestInteger) {
        const double power = integerPower(x, static_cast<int>(std::abs(y)));
        if (y > 0) return power;
        if (std::isnormal(power)) return 1 / power;
    }
    return sign * exp2(y * log2(std::abs(x)));
}

/// A first value and a step of Newton's method.
double cbrt(double x) {
    if (x == 0 || !std::isfinite(x)) return x;
    const double size = std::abs(x), root = exp2(log2(size) / 3);
    const double better = root - (root - size / (root * root)) / 3;
    return std::copysign(better, x);
}

/// Scaled by a power of two, so that nothing overflows or vanishes.
double hypot(double x, double y) {
    x = std::abs(x), y = std::abs(y);
    if (std::isinf(x) || std::isinf(y)) return kInfinity;
    const double larger = x < y ? y : x;
    if (!(larger > 0)) return x + y;
    const int exponent = std::ilogb(larger);
    const double a = std::ldexp(x, -exponent), b = std::ldexp(y, -exponent);
    return std::ldexp(std::sqrt(a * a + b * b), exponent);
}

double sin(double x) {
    if (!std::isfinite(x)) return kNan;
    return std::abs(x) < kSmallest ? x : sineOf(reduced(x));
}

double cos(double x) {
    if (!std::isfinite(x)) return kNan;
    Reduced angle = reduced(x);
    angle.quadrant = (angle.quadrant + 1) % 4;
    return sineOf(angle);
}

double tan(double x) { return std::abs(x) < kSmallest ? x : sin(x) / cos(x); }

double atan(double x) {
    const double size = std::abs(x);
    if (!(size > 0)) return x;
    const double angle = size <= 1 ? atanOfPart(size) : kHalfPi - atanOfPart(1 / size);
    return std::copysign(angle, x);
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return kNan;
    const double height = std::abs(y), width = std::abs(x);
    double angle = 0; // of the first quadrant
    if (std::isinf(height))
        angle = std::isinf(width) ? kPi / 4 : kHalfPi;
    else if (height > width)
        angle = kHalfPi - atanOfPart(width / height);
    else if (height > 0)
        angle = atanOfPart(height / width);
    return std::copysign(std::signbit(x) ? kPi - angle : angle, y);
}

double asin(double x) { return std::abs(x) <= 1 ? atan2(x, std::sqrt((1 - x) * (1 + x))) : kNan; }

double acos(double x) { return std::abs(x) <= 1 ? atan2(std::sqrt((1 - x) * (1 + x)), x) : kNan; }

} // namespace filament_core::elementary
