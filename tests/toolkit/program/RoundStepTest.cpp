// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/RoundStep.h"

#include <gtest/gtest.h>

namespace filament_core {
namespace {

TEST(RoundStep, IsOneTwoOrFiveInItsDecade) {
    for (auto const& [least, step] : { std::pair{ 1.0, 1.0 },
                                       { 1.001, 2.0 },
                                       { 2.0, 2.0 },
                                       { 3.0, 5.0 },
                                       { 5.0, 5.0 },
                                       { 5.1, 10.0 },
                                       { 9.99, 10.0 },
                                       { 0.0021, 0.005 },
                                       { 340.0, 500.0 },
                                       { 1e-9, 1e-9 } })
        EXPECT_DOUBLE_EQ(roundStep(least), step) << least;
}

TEST(RoundStep, IsNeverTooSmallAndNeverTwoAndAHalfTimesTooLarge) {
    for (double least = 1e-12; least < 1e12; least *= 1.003) {
        EXPECT_GE(roundStep(least), least);
        EXPECT_LT(roundStep(least), 2.5 * least * (1 + 1e-12)) << least;
    }
}

} // namespace
} // namespace filament_core
