// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Contenders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

namespace filament_core::bench {
namespace {

using enum RuntimeKind;

/// Pools whose waiting is written in this folder; with 0, 1 and 4 workers.
class Runtimes : public ::testing::TestWithParam<std::tuple<RuntimeKind, unsigned>> {
protected:
    RuntimeKind kind() const { return std::get<0>(GetParam()); }
    unsigned threads() const { return std::get<1>(GetParam()); }
    void SetUp() override {
        if (!isBuilt(kind())) GTEST_SKIP() << toString(kind()) << " was not found when this program was configured";
        mRuntime = makeRuntime(kind(), { .threads = threads() });
        mRuntime->enter();
    }
    void TearDown() override {
        if (mRuntime) mRuntime->leave();
    }
    std::unique_ptr<Runtime> mRuntime;
};

TEST_P(Runtimes, VisitAllLeavesOfATree) {
    if (whyLeftOut(kind(), Work::Tree)) GTEST_SKIP() << whyLeftOut(kind(), Work::Tree);
    for (uint32_t depth = 0; depth <= 10; ++depth) EXPECT_EQ(mRuntime->tree(depth), 1u << depth);
}

TEST_P(Runtimes, EndEachWorkThatTheyAreNotLeftOutOf) {
    mRuntime->emptyJobs(1, 100);
    mRuntime->emptyJobs(5000, 3); // more than a queue of Eigen's pool holds
    mRuntime->loop(SpinWork{ 1, 1 }, 100'000, 3);
    mRuntime->loop(SpinWork{ 1, 1 }, 1, 3);
    for (uint32_t links : { 1u, 2u, 500u }) {
        if (!whyLeftOut(kind(), Work::Chain)) mRuntime->chain(links, 2);
        if (!whyLeftOut(kind(), Work::Graph)) mRuntime->graph(links, 2);
        mRuntime->relay(links, 2);
    }
    mRuntime->spinJobs(std::vector<uint32_t>(300, 10));
}

TEST_P(Runtimes, WakeAnotherThreadIfThereIsOne) {
    mRuntime->emptyJobs(8, 1); // now the threads exist
    std::optional<int64_t> shortest;
    for (int i = 0; i < 5; ++i) {
        const std::optional<int64_t> latency = mRuntime->wakeUp(10'000);
        ASSERT_EQ(latency.has_value(), threads() > 1);
        if (latency) shortest = std::min(*latency, shortest.value_or(*latency));
    }
    EXPECT_LT(shortest.value_or(0), 1'000'000'000) << "each time, no thread came for a second";
}

INSTANTIATE_TEST_SUITE_P(Peers, Runtimes,
                         ::testing::Combine(::testing::Values(Ours, Eigen, Asio), ::testing::Values(1u, 2u, 5u)),
                         [](auto const& parameter) {
                             return std::string(toString(std::get<0>(parameter.param))) + "_" +
                                    std::to_string(std::get<1>(parameter.param));
                         });

TEST(LeftOut, OneReasonForEachWorkThatALibraryCannotExpress) {
    EXPECT_EQ(whyLeftOut(Asio, Work::Tree), nullptr);
    EXPECT_EQ(whyLeftOut(Eigen, Work::Relay), nullptr);
    for (const Work work : { Work::Tree, Work::Chain, Work::Graph })
        EXPECT_THAT(whyLeftOut(Eigen, work), ::testing::NotNull());
}

TEST(LeftOut, HaveAReasonInsteadOfFigures) {
    Workload workload{ .name = "tree", .contenders = {}, .targets = {} };
    const auto make = [](RuntimeKind kind) -> Contender {
        return { toString(kind), [](std::vector<double>& figures) { figures.push_back(1); } };
    };
    addRuntimes(workload, std::array{ Ours, Eigen, Serial }, Work::Tree, make);
    Rounds rounds(workload);
    rounds.runOne();
    const Measured measured = std::move(rounds).finish();
    EXPECT_NE(measured.find("ours"), nullptr);
    EXPECT_NE(measured.find("serial"), nullptr);
    EXPECT_EQ(measured.find("eigen"), nullptr);
    ASSERT_EQ(measured.leftOut.size(), isBuilt(Eigen) ? 1u : 0u);
    for (LeftOut const& leftOut : measured.leftOut) EXPECT_EQ(leftOut.name, "eigen");
}

} // namespace
} // namespace filament_core::bench
