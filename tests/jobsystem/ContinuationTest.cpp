// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/JobSystemFixture.h"

#include <memory>
#include <numeric>
#include <optional>
#include <vector>

namespace filament_core::jobs {
namespace {

class ContinuationTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, ContinuationTest, testing::Values(0, 1, 2, 7), workersName);

TEST_P(ContinuationTest, SeesWhatEveryJobOfItsGroupWrote) {
    const AdoptedThread seat(jobs);
    for (int round = 0; round < 2'000; ++round) {
        int written[3] = {}; // plain: a continuation that started too early would be a race
        int sum = 0;
        JobGroup group(jobs), next(jobs);
        for (int i = 0; i < 3; ++i) group.run([&written, i] { written[i] = i + 1; });
        group.then<"sum">(next, [&] { sum = std::accumulate(written, written + 3, 0); });
        next.wait();
        ASSERT_EQ(sum, 6) << "round " << round;
    }
}

TEST_P(ContinuationTest, RunsExactlyOnceWhetherOrNotItsGroupIsDoneWhenItIsAttached) {
    for (int round = 0; round < 1'000; ++round) {
        std::atomic<int> ran = 0;
        JobGroup group(jobs), next(jobs);
        group.run([] {});
        if (round % 3 == 0) group.wait();
        if (round % 3 == 1) std::this_thread::yield();
        group.then(next, [&] { ran.fetch_add(1); });
        group.wait();
        next.wait();
        ASSERT_EQ(ran.load(), 1) << "round " << round;
    }
}

TEST_P(ContinuationTest, OfAnEmptyGroupRuns) {
    bool ran = false;
    JobGroup group(jobs), next(jobs);
    group.then(next, [&] { ran = true; });
    next.wait();
    EXPECT_TRUE(ran);
}

TEST_P(ContinuationTest, KeepsTheGroupItBelongsToUnfinishedUntilItRan) {
    if (workers() == 0) GTEST_SKIP() << "nothing is ever pending";
    const AdoptedThread seat(jobs);
    WorkersHeld held(jobs);
    std::atomic<bool> ran = false;
    JobGroup group(jobs), next(jobs);
    group.run([] {});
    group.then(next, [&] { ran = true; });
    EXPECT_FALSE(next.isDone());
    next.wait(); // this thread does both
    EXPECT_TRUE(ran.load());
    EXPECT_TRUE(group.isDone());
}

TEST_P(ContinuationTest, TenThousandInARowRunInOrder) {
    constexpr int kLinks = 10'000;
    const AdoptedThread seat(jobs);
    std::vector<int> order; // plain: consecutive links happen one after the other, on whatever threads
    std::vector<std::unique_ptr<JobGroup>> groups;
    for (int i = 0; i <= kLinks; ++i) groups.push_back(std::make_unique<JobGroup>(jobs));
    groups[0]->run([&] { order.push_back(0); });
    for (int i = 0; i < kLinks; ++i) groups[i]->then<"link">(*groups[i + 1], [&order, i] { order.push_back(i + 1); });
    groups[kLinks]->wait();
    ASSERT_EQ(order.size(), size_t(kLinks) + 1);
    for (int i = 0; i <= kLinks; ++i) ASSERT_EQ(order[i], i);
}

TEST_P(ContinuationTest, MayForkIntoItsOwnGroup) {
    std::atomic<int> leaves = 0;
    JobGroup group(jobs), next(jobs);
    for (int i = 0; i < 4; ++i) group.run([] {});
    group.then(next, [&] {
        for (int i = 0; i < 100; ++i) next.run([&] { leaves.fetch_add(1); });
    });
    next.wait();
    EXPECT_EQ(leaves.load(), 100);
}

TEST_P(ContinuationTest, JoinsSeveralGroupsIntoOne) {
    for (int round = 0; round < 300; ++round) {
        std::atomic<int> ran = 0;
        JobGroup a(jobs), b(jobs), c(jobs), next(jobs);
        for (JobGroup* group : { &a, &b, &c }) {
            for (int i = 0; i < 5; ++i) group->run([] {});
            group->then(next, [&] { ran.fetch_add(1); });
        }
        next.wait();
        ASSERT_EQ(ran.load(), 3);
    }
}

TEST_P(ContinuationTest, AGroupCanBeReusedAfterItsContinuation) {
    std::atomic<int> jobsRan = 0, continuationsRan = 0;
    JobGroup group(jobs), next(jobs);
    for (int round = 1; round <= 200; ++round) {
        for (int i = 0; i < 3; ++i) group.run([&] { jobsRan.fetch_add(1); });
        group.then(next, [&] { continuationsRan.fetch_add(1); });
        group.wait();
        next.wait();
        ASSERT_EQ(jobsRan.load(), 3 * round);
        ASSERT_EQ(continuationsRan.load(), round);
    }
}

TEST_P(ContinuationTest, OfBackgroundWorkRunsOnAFrameThread) {
    std::thread::id background, after;
    JobGroup frame(jobs);
    JobGroup decode(jobs, Priority::Normal);
    decode.runBackground([&] { background = std::this_thread::get_id(); });
    decode.then(frame, [&] { after = std::this_thread::get_id(); });
    frame.wait();
    EXPECT_NE(after, std::thread::id{});
    EXPECT_EQ(after == background, workers() == 0);
}

// ---------------------------------------------------------------------------------------------- successors

/// Counts down by returning itself.
struct Countdown {
    int left;
    std::vector<int>& seen;
    std::optional<Countdown> operator()() const {
        seen.push_back(left);
        return left > 0 ? std::optional<Countdown>({ left - 1, seen }) : std::nullopt;
    }
};

TEST_P(ContinuationTest, AJobIsFollowedByTheCallableThatItReturns) {
    std::vector<int> seen; // plain: one thread after the other
    JobGroup group(jobs);
    group.run([&seen] {
        seen.push_back(1);
        return [&seen] {
            seen.push_back(2);
            return next<"third">([&seen] { seen.push_back(3); });
        };
    });
    group.wait();
    EXPECT_EQ(seen, (std::vector{ 1, 2, 3 }));
}

TEST_P(ContinuationTest, AChainOfAHundredThousandSuccessorsNeedsNoStack) {
    constexpr int kLinks = 100'000;
    std::vector<int> seen;
    JobGroup group(jobs);
    group.run(Countdown{ kLinks, seen });
    group.wait();
    ASSERT_EQ(seen.size(), size_t(kLinks) + 1);
    for (int i = 0; i <= kLinks; ++i) ASSERT_EQ(seen[i], kLinks - i);
}

TEST_P(ContinuationTest, AGroupIsNotDoneBeforeItsSuccessors) {
    for (int round = 0; round < 200; ++round) {
        std::atomic<int> finished = 0;
        JobGroup group(jobs);
        for (int i = 0; i < 8; ++i) {
            group.run([&finished] { return [&finished] { return [&finished] { finished.fetch_add(1); }; }; });
        }
        group.wait();
        ASSERT_EQ(finished.load(), 8);
    }
}

TEST_P(ContinuationTest, WhatAJobReturnsThatCannotBeCalledIsIgnored) {
    std::atomic<int> ran = 0;
    JobGroup group(jobs);
    group.run([&] { return ran.fetch_add(1); });
    group.run([&]() -> std::optional<int> { return ran.fetch_add(1); });
    group.wait();
    EXPECT_EQ(ran.load(), 2);
}

TEST_P(ContinuationTest, CapturesOfSuccessorsAreDestroyedOnce) {
    auto shared = std::make_shared<int>(7);
    JobGroup group(jobs);
    for (int i = 0; i < 50; ++i) {
        group.run([shared] { return [shared] { return std::optional([shared] { EXPECT_EQ(*shared, 7); }); }; });
    }
    group.wait();
    EXPECT_EQ(shared.use_count(), 1);
}

TEST_P(ContinuationTest, BackgroundJobsHaveSuccessorsToo) {
    std::vector<int> seen;
    JobGroup loads(jobs);
    loads.runBackground(Countdown{ 100, seen });
    loads.wait();
    EXPECT_EQ(seen.size(), 101u);
}

// ---------------------------------------------------------------------------------------------- rules

TEST(ContinuationDeathTest, RefusesToMakeUrgentWorkWaitForLessUrgentWork) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = 1 });
                JobGroup normal(jobs);
                JobGroup critical(jobs, Priority::FrameCritical);
                normal.then(critical, [] {});
            },
            "not more urgent");
}

TEST(ContinuationDeathTest, RefusesASecondContinuationWhileTheFirstIsPending) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = 1 });
                const WorkersHeld held(jobs);
                JobGroup group(jobs);
                JobGroup next(jobs);
                group.run([] {});
                group.then(next, [] {});
                group.then(next, [] {});
            },
            "one continuation");
}

TEST(ContinuationDeathTest, RefusesGroupsOfTwoSystems) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
            {
                JobSystem one({ .workers = 0 });
                JobSystem other({ .workers = 0 });
                JobGroup group(one);
                JobGroup next(other);
                group.then(next, [] {});
            },
            "of one system");
}

} // namespace
} // namespace filament_core::jobs
