// SPDX-License-Identifier: Apache-2.0
// Time modulo a period after hours and years, in the precision of the shaders.
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace filament_core::shader::lib {
namespace {

double circularDistance(double a, double b, double period) {
    const double apart = std::abs(std::remainder(a - b, period));
    return std::min(apart, period - apart);
}

struct SplitTime {
    float seconds, rest;
};
SplitTime split(double time) {
    const auto seconds = static_cast<float>(time);
    return { seconds, static_cast<float>(time - seconds) };
}

TEST(TimeModulo, IsWithinAFewRoundingsOfThePeriodForTenYears) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> logTime(-3, 8.5), logPeriod(-2, 4);
    for (int i = 0; i < 200'000; ++i) {
        const double time = std::pow(10.0, logTime(random));
        const auto period = static_cast<float>(std::pow(10.0, logPeriod(random)));
        const auto [seconds, rest] = split(time);
        const float found = timeModulo(seconds, rest, period);
        ASSERT_GE(found, 0.0f) << time << " " << period;
        ASSERT_LT(found, period) << time << " " << period;
        const double exact = std::fmod(static_cast<double>(seconds) + rest, period);
        const double quotientBeyondFloat = std::max(1.0, time / period / 0x1p24);
        ASSERT_LE(circularDistance(found, exact, period), 2e-7 * period * quotientBeyondFloat) << time << " " << period;
    }
}

TEST(TimeModulo, PlainFloatsStutterWhereItDoesNot) {
    const double day = 86'400, frame = 1.0 / 60;
    const auto plain = [](double time) {
        const auto seconds = static_cast<float>(time);
        return seconds - 3.0f * std::floor(seconds / 3.0f);
    };
    const auto exact = [](double time) {
        const auto [seconds, rest] = split(time);
        return timeModulo(seconds, rest, 3.0f);
    };
    double plainJitter = 0, jitter = 0;
    for (int i = 0; i < 100; ++i) {
        const double time = day + i * frame;
        plainJitter = std::max(plainJitter, std::abs(plain(time + frame) - plain(time) - frame));
        jitter = std::max(jitter, std::abs(exact(time + frame) - exact(time) - frame));
    }
    EXPECT_GT(plainJitter, 1e-3);
    EXPECT_LT(jitter, 1e-6);
}

TEST(TimeModulo, MultiplesOfThePeriodAreZero) {
    for (float period : { 0.1f, 1.0f, 3.0f, 7.5f, 60.0f }) {
        for (float count : { 0.0f, 1.0f, 2.0f, 1000.0f, 65536.0f }) {
            const double time = static_cast<double>(period) * count;
            const auto [seconds, rest] = split(time);
            EXPECT_EQ(timeModulo(seconds, rest, period), 0.0f) << period << " x " << count;
        }
    }
}

} // namespace
} // namespace filament_core::shader::lib
