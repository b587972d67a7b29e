// SPDX-License-Identifier: Apache-2.0
#include "base/math/Elementary.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace filament_core {
namespace {

using Unary = double (*)(double);
using UnaryFloat = float (*)(float);
using Truth = long double (*)(long double);

struct Function {
    const char* name;
    Unary ours;
    UnaryFloat rounded;
    Truth truth;
    double from, to;    ///< arguments, or their exponents of two
    bool isExponential; ///< evenly spread exponents instead of values
    uint64_t bits;      ///< digest of the results, the same on every machine
};

/// 64-bit FNV-1a, by whole results.
uint64_t digested(uint64_t digest, double value) { return (digest ^ std::bit_cast<uint64_t>(value)) * 0x100000001B3u; }

/// The k-th of evenly spread arguments, made without a function of the C++ library.
double argument(Function const& f, uint64_t k, uint64_t count) {
    const double part = (static_cast<double>(k) + 0.37) / static_cast<double>(count);
    const double x = f.from + (f.to - f.from) * part;
    return f.isExponential ? std::ldexp(1 + (x - std::floor(x)), static_cast<int>(std::floor(x))) : x;
}

double unitsOff(double got, long double want) {
    int exponent = 0;
    std::frexp(static_cast<double>(want), &exponent);
    return std::abs(static_cast<double>(static_cast<long double>(got) - want)) / std::ldexp(1.0, exponent - 53);
}

#define FILAMENT_FUNCTION(name, from, to, isExponential, bits)                                                         \
    { #name, elementary::name, elementary::name, Truth(std::name), from, to, isExponential, bits }

const std::array<Function, 20> kFunctions{ {
        FILAMENT_FUNCTION(exp, -700, 700, false, 0xAA5D4593A4375BB4),
        FILAMENT_FUNCTION(exp, -1, 1, false, 0x4985519520985A44),
        FILAMENT_FUNCTION(exp2, -1000, 1000, false, 0x73DE9F6A5922586E),
        FILAMENT_FUNCTION(exp2, -1, 1, false, 0x818856BCA2095756),
        FILAMENT_FUNCTION(log, -1000, 1000, true, 0x79766B27FCEAA43C),
        FILAMENT_FUNCTION(log, 0.5, 2, false, 0xDECB7C40639D4CEE),
        FILAMENT_FUNCTION(log2, -1000, 1000, true, 0x6CD2DDBD7AF37C57),
        FILAMENT_FUNCTION(log2, 0.5, 2, false, 0xCBF48B5983311DDA),
        FILAMENT_FUNCTION(log10, -1000, 1000, true, 0x8C5F1D07858F64E5),
        FILAMENT_FUNCTION(cbrt, -300, 300, true, 0xA79EF472C3C7602E),
        FILAMENT_FUNCTION(sin, -4, 4, false, 0x9CF1170A48DC834B),
        FILAMENT_FUNCTION(sin, -1e9, 1e9, false, 0x2BB4F79F9CC5C519),
        FILAMENT_FUNCTION(cos, -4, 4, false, 0xCD62CB0D78502CBC),
        FILAMENT_FUNCTION(cos, -1e9, 1e9, false, 0xC75F4AEFA259596F),
        FILAMENT_FUNCTION(tan, -7, 7, false, 0x59B37FEF72DC6C05),
        FILAMENT_FUNCTION(asin, -1, 1, false, 0x72D875A5CCA5D9AD),
        FILAMENT_FUNCTION(acos, -1, 1, false, 0x996060B77EF8C3B8),
        FILAMENT_FUNCTION(atan, -3, 3, false, 0x2639F0B2B8F5FBB4),
        FILAMENT_FUNCTION(atan, -100, 100, true, 0x1DB98827E4B7A7F0),
        FILAMENT_FUNCTION(tan, -100, -1, true, 0xCFDCCD65282ED53F),
} };
constexpr uint64_t kArguments = 50'000;

TEST(Elementary, StaysWithinItsErrorAndRoundsFloatsCorrectly) {
    for (Function const& f : kFunctions) {
        SCOPED_TRACE(testing::Message() << f.name << " from " << f.from);
        double worst = 0;
        uint64_t wrongFloats = 0;
        for (uint64_t k = 0; k < kArguments; ++k) {
            const double x = argument(f, k, kArguments);
            worst = std::max(worst, unitsOff(f.ours(x), f.truth(x)));
            const auto single = static_cast<float>(x);
            if (!std::isnormal(single)) continue;
            const auto correct = static_cast<float>(f.truth(single));
            if (std::isnormal(correct) && f.rounded(single) != correct) ++wrongFloats;
        }
        EXPECT_LT(worst, 4);
        EXPECT_EQ(wrongFloats, 0u);
    }
}

TEST(Elementary, HasTheSameBitsOnEveryMachine) {
    for (Function const& f : kFunctions) {
        uint64_t digest = 0xCBF29CE484222325u;
        for (uint64_t k = 0; k < kArguments; ++k) digest = digested(digest, f.ours(argument(f, k, kArguments)));
        EXPECT_EQ(digest, f.bits) << f.name << " from " << f.from;
    }
}

TEST(Elementary, OfTwoArgumentsStaysWithinItsError) {
    std::mt19937_64 random(5);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    for (int i = 0; i < 100'000; ++i) {
        const double x = uniform(-3, 3), y = uniform(-3, 3), base = std::exp2(uniform(-20, 20)),
                     power = uniform(-20, 20);
        ASSERT_LT(unitsOff(elementary::atan2(y, x), std::atan2(static_cast<long double>(y), x)), 4) << y << ' ' << x;
        ASSERT_LT(unitsOff(elementary::hypot(x, y), std::hypot(static_cast<long double>(x), y)), 2) << x << ' ' << y;
        ASSERT_LT(unitsOff(elementary::pow(base, power), std::pow(static_cast<long double>(base), power)),
                  2 * (2 + std::abs(power * std::log2(base))))
                << base << ' ' << power;
    }
}

/// Equal, or both not numbers; zeros with the same sign.
bool agree(double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    if (a == 0 || b == 0 || std::isinf(b)) return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
    return std::abs(a - b) <= 1e-14 * std::abs(b);
}

TEST(Elementary, OfSpecialValuesIsWhatTheStandardSays) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::array values{ 0.0,  -0.0,  1.0,        -1.0,      2.0,    -2.0,    3.0,          -3.0, 0.5,  -0.5, 2.5,
                             -2.5, 1e300, -kInfinity, kInfinity, 5e-324, -1e-310, std::nan(""), 1e15, -7.0, 8.0 };
    for (const double x : values) {
        for (Function const& f : kFunctions) {
            const bool isAngle = f.ours == static_cast<Unary>(elementary::sin) ||
                                 f.ours == static_cast<Unary>(elementary::cos) ||
                                 f.ours == static_cast<Unary>(elementary::tan);
            if (isAngle && std::isfinite(x) && std::abs(x) > 0x1p30) continue; // beyond the limits
            EXPECT_PRED2(agree, f.ours(x), static_cast<double>(f.truth(x))) << f.name << ' ' << x;
        }
        for (const double y : values) {
            EXPECT_PRED2(agree, elementary::pow(x, y), std::pow(x, y)) << x << ' ' << y;
            EXPECT_PRED2(agree, elementary::atan2(x, y), std::atan2(x, y)) << x << ' ' << y;
            EXPECT_PRED2(agree, elementary::hypot(x, y), std::hypot(x, y)) << x << ' ' << y;
        }
    }
}

} // namespace
} // namespace filament_core
