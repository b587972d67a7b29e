// SPDX-License-Identifier: Apache-2.0
// A job that runs out of memory: waits for its group report it, and nothing else is affected.
#include "tests/jobsystem/JobSystemFixture.h"

#include <atomic>
#include <memory>
#include <new>

namespace filament_core::jobs {
namespace {

class JobMemoryTest : public testing::TestWithParam<int> {
protected:
    JobSystem jobs{ { .workers = GetParam() } };
};
INSTANTIATE_TEST_SUITE_P(Workers, JobMemoryTest, testing::Values(0, 1, 2, 8), workersName);

[[noreturn]] void runOut() { throw std::bad_alloc(); }

TEST_P(JobMemoryTest, WaitThrowsWhatAJobOfTheGroupThrew) {
    JobGroup group(jobs);
    std::atomic<int> ran{ 0 };
    for (int i = 0; i < 20; ++i) {
        group.run([&, i] {
            ++ran;
            if (i == 7) runOut();
        });
    }
    EXPECT_THROW(group.wait(), std::bad_alloc);
    EXPECT_EQ(ran, 20) << "the other jobs of the group run all the same";
}

TEST_P(JobMemoryTest, AGroupIsAsGoodAsNewAfterItWasToldOnce) {
    JobGroup group(jobs);
    group.run([] { runOut(); });
    EXPECT_THROW(group.wait(), std::bad_alloc);
    EXPECT_NO_THROW(group.wait());
    bool ran = false;
    group.run([&] { ran = true; });
    EXPECT_NO_THROW(group.wait());
    EXPECT_TRUE(ran);
}

TEST_P(JobMemoryTest, OtherGroupsAreNotTold) {
    JobGroup poor(jobs), rich(jobs);
    poor.run([] { runOut(); });
    rich.run([] {});
    EXPECT_NO_THROW(rich.wait());
    EXPECT_THROW(poor.wait(), std::bad_alloc);
}

TEST_P(JobMemoryTest, AGroupMayEndWithoutBeingAsked) {
    JobGroup group(jobs);
    group.run([] { runOut(); });
}

TEST_P(JobMemoryTest, ALoopThrowsWhatARangeThrew) {
    for (size_t bad : { 0, 5, 99 }) {
        EXPECT_THROW(parallelFor(jobs, 100, 1,
                                 [&](size_t begin, size_t) {
                                     if (begin == bad) runOut();
                                 }),
                     std::bad_alloc);
    }
    std::atomic<int> visited{ 0 };
    parallelFor(jobs, 100, 1, [&](size_t, size_t) { ++visited; });
    EXPECT_EQ(visited, 100);
}

TEST_P(JobMemoryTest, FromAnInnerLoopItReachesTheOuterGroup) {
    JobGroup group(jobs);
    group.run([&] {
        parallelFor(jobs, 16, 1, [](size_t begin, size_t) {
            if (begin == 11) runOut();
        });
    });
    EXPECT_THROW(group.wait(), std::bad_alloc);
}

TEST_P(JobMemoryTest, WhatAJobCapturedIsDestroyed) {
    const auto counted = std::make_shared<int>(0);
    JobGroup group(jobs);
    for (int i = 0; i < 10; ++i) group.run([counted] { runOut(); });
    EXPECT_THROW(group.wait(), std::bad_alloc);
    EXPECT_EQ(counted.use_count(), 1);
}

TEST_P(JobMemoryTest, ASuccessorThatRunsOutCountsForItsGroup) {
    JobGroup group(jobs);
    group.run([] { return next<"second">([] { runOut(); }); });
    EXPECT_THROW(group.wait(), std::bad_alloc);
}

TEST_P(JobMemoryTest, AContinuationRunsAndItsGroupIsToldOfTheOneBefore) {
    JobGroup before(jobs), after(jobs);
    bool continued = false;
    before.run([] { runOut(); });
    before.then(after, [&] { continued = true; });
    EXPECT_THROW(after.wait(), std::bad_alloc);
    EXPECT_TRUE(continued);
    EXPECT_THROW(before.wait(), std::bad_alloc);
}

TEST_P(JobMemoryTest, ABackgroundJobTellsItsGroup) {
    JobGroup group(jobs);
    group.runBackground([] { runOut(); });
    EXPECT_THROW(group.wait(), std::bad_alloc);
}

class JobMemoryDeathTest : public testing::TestWithParam<int> {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};
INSTANTIATE_TEST_SUITE_P(Workers, JobMemoryDeathTest, testing::Values(0, 2), workersName);

TEST_P(JobMemoryDeathTest, ABackgroundJobWithoutAGroupHasNobodyToTellAndEndsTheProcess) {
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = GetParam() });
                jobs.runBackground<"decode">([] { runOut(); });
            },
            "job \"decode\" threw \"std::bad_alloc\"");
}

} // namespace
} // namespace filament_core::jobs
