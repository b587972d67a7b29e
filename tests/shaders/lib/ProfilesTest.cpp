// SPDX-License-Identifier: Apache-2.0
// Where directions lie in the tables of light profiles: against the arc tangent of the C++ library.
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

namespace filament_core::shader {
namespace {

using std::numbers::pi;

TEST(Profiles, TheArcTangentIsRightToItsLastDigits) {
    const uint32_t one = std::bit_cast<uint32_t>(1.0f);
    float last = 0;
    for (uint32_t bits = 0; bits <= one; bits += 101) { // every exponent
        const float x = std::bit_cast<float>(bits);
        const float angle = lib::arcTangentOfUnit(x);
        ASSERT_NEAR(angle, std::atan(static_cast<double>(x)), 1.5e-7) << x;
        ASSERT_GE(angle, last - 1.2e-7f) << x;
        last = angle;
    }
    EXPECT_EQ(lib::arcTangentOfUnit(0), 0);
}

TEST(Profiles, AnglesAreThoseOfAtan2AtAnyLength) {
    for (const float length : { 1e-18f, 1e-3f, 1.0f, 1e18f }) {
        for (int i = 0; i <= 100'000; ++i) {
            const double angle = pi * i / 100'000;
            const auto along = static_cast<float>(static_cast<double>(length) * std::cos(angle));
            const auto across = static_cast<float>(static_cast<double>(length) * std::abs(std::sin(angle)));
            ASSERT_NEAR(lib::angleFrom(along, across), std::atan2(double{ across }, double{ along }), 4e-7) << angle;
        }
    }
    EXPECT_EQ(lib::angleFrom(0, 0), 0) << "no direction";
    EXPECT_EQ(lib::angleFrom(1, 0), 0);
    EXPECT_FLOAT_EQ(lib::angleFrom(-1, 0), static_cast<float>(pi));
}

TEST(Profiles, PlacesAreInsideOfTheTableInEveryDirection) {
    constexpr float kRows = 360 / 3.14159265f, kColumns = 144;
    for (int i = 0; i <= 720; ++i) {
        for (int j = 0; j <= 1440; ++j) {
            const double polar = pi * i / 720, around = 2 * pi * j / 1440;
            const glm::vec3 direction(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                                      std::cos(polar));
            const glm::vec2 at = lib::profilePlace(direction, kRows, kColumns);
            ASSERT_TRUE(at.x >= 0 && at.x <= 360.0005f) << at.x;
            ASSERT_TRUE(at.y >= 0 && at.y <= kColumns) << at.y;
            ASSERT_NEAR(at.x, i * 0.5, 1e-4);
            if (i == 0 || i == 720) continue; // any column
            const double turns = std::abs(static_cast<double>(at.y) - j * 0.1);
            ASSERT_NEAR(std::min(turns, 144 - turns), 0, 1e-4 / std::sin(polar) + 1e-4) << i << ' ' << j;
        }
    }
}

} // namespace
} // namespace filament_core::shader
