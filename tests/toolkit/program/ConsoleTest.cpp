// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Console.h"

#include <gtest/gtest.h>

namespace filament_core::tools {
namespace {

using namespace std::chrono_literals;

TEST(ProgressPace, ALogOfShortWorkHasNoLineAndThatOfLongWorkOneEveryFiveMinutes) {
    const ProgressPace::Clock::time_point begin = ProgressPace::Clock::now();
    ProgressPace pace(begin);
    int lines = 0;
    for (auto time = 0s; time < kBetweenProgressLines; time += 1s) lines += pace.isDue(begin + time) ? 1 : 0;
    EXPECT_EQ(lines, 0);
    for (auto time = std::chrono::seconds(kBetweenProgressLines); time < 1h; time += 1s)
        lines += pace.isDue(begin + time) ? 1 : 0;
    EXPECT_EQ(lines, 11);
}

TEST(ProgressPace, WorkThatReportsSeldomHasALineEachTime) {
    const ProgressPace::Clock::time_point begin = ProgressPace::Clock::now();
    ProgressPace pace(begin);
    EXPECT_TRUE(pace.isDue(begin + 20min));
    EXPECT_FALSE(pace.isDue(begin + 24min));
    EXPECT_TRUE(pace.isDue(begin + 40min));
}

} // namespace
} // namespace filament_core::tools
