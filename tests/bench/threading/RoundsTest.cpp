// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Workload.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filament_core::bench {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

/// Returns given figures, round after round.
Sampler playing(std::vector<std::vector<double>> rounds) {
    return [rounds = std::move(rounds), next = size_t{ 0 }](std::vector<double>& figures) mutable {
        figures = rounds[next++];
    };
}

Measured measure(Workload workload, int rounds) {
    Rounds running(std::move(workload));
    for (int i = 0; i < rounds; ++i) running.runOne();
    return std::move(running).finish();
}

TEST(Rounds, CompareFiguresOfTheSameRoundOnly) {
    // The machine is a hundred times slower in the second round: every ratio is still 1/2, and so is the ratio of the
    // medians, but ratios across rounds would not be.
    const Measured measured = measure({ .contenders = { { "ours", playing({ { 1 }, { 100 }, { 3 } }) },
                                                        { "tbb", playing({ { 2 }, { 200 }, { 6 } }) } } },
                                      3);
    EXPECT_DOUBLE_EQ(measured.ratio("ours", "tbb").value(), 0.5);
    EXPECT_FALSE(measured.ratio("ours", "openmp").has_value());
}

TEST(Rounds, TakeTheMedianOfARoundButKeepAllLatencies) {
    const Measured measured = measure({ .contenders = { { "ours", playing({ { 1, 2, 90 }, { 3, 4, 5 } }) } } }, 2);
    EXPECT_THAT(measured.find("ours")->rounds, ElementsAre(2, 4));
    EXPECT_THAT(measured.find("ours")->all, ElementsAre(1, 2, 90, 3, 4, 5));
}

TEST(Rounds, RunTheContendersInTurns) {
    std::string order;
    const auto named = [&order](char name) {
        return [&order, name](std::vector<double>& figures) {
            order += name;
            figures.push_back(1);
        };
    };
    measure({ .contenders = { { "a", named('A') }, { "b", named('B') }, { "c", named('C') } } }, 3);
    EXPECT_EQ(order, "ABCABCABC");
}

TEST(Targets, AreJudgedByTheFigureThatTheyName) {
    const Measured measured =
            measure({ .contenders = { { "ours", playing({ { 10, 10, 300 } }) }, { "serial", playing({ { 25 } }) } },
                      .targets = { { .limit = 10 },
                                   { .limit = 9.9 },
                                   { .figure = Figure::P99, .limit = 200 },
                                   { .contender = "serial",
                                     .figure = Figure::Ratio,
                                     .other = "ours",
                                     .limit = 2.5,
                                     .atLeast = true },
                                   { .contender = "serial",
                                     .figure = Figure::Ratio,
                                     .other = "ours",
                                     .limit = 2.6,
                                     .atLeast = true } } },
                    1);
    std::vector<bool> met;
    for (Verdict const& verdict : measured.verdicts) met.push_back(verdict.isMet);
    EXPECT_THAT(met, ElementsAre(true, false, false, true, false));
    EXPECT_THAT(measured.verdicts[2].value, DoubleNear(294.2, 1e-9)); // 10 + 0.98 * (300 - 10)
}

TEST(Targets, WithoutMeasurementsAreMissed) {
    const Measured measured = measure({ .contenders = { { "ours", playing({ { 1 } }) } },
                                        .targets = { { .contender = "absent", .limit = 5 },
                                                     { .figure = Figure::Ratio, .other = "tbb", .limit = 5 } } },
                                      1);
    EXPECT_FALSE(measured.verdicts[0].isMet);
    EXPECT_FALSE(measured.verdicts[1].isMet);
}

TEST(Targets, SayWhatTheyAskFor) {
    EXPECT_EQ(describe({ .limit = 75 }, "ns/job"), "ours <= 75 ns/job");
    EXPECT_EQ(describe({ .figure = Figure::P99, .limit = 200 }, "us"), "ours p99 <= 200 us");
    EXPECT_EQ(describe({ .figure = Figure::Ratio, .other = "tbb", .limit = 0.75 }, "ns/job"), "ours / tbb <= 0.75");
}

} // namespace
} // namespace filament_core::bench
