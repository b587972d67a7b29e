// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Topology.h"
#include "tests/jobsystem/JobSystemFixture.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

namespace filament_core::jobs {
namespace {

class JobSystemTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, JobSystemTest, testing::Values(0, 1, 2, 7), workersName);

TEST_P(JobSystemTest, HasAsManyWorkersAsAskedFor) { EXPECT_EQ(jobs.workerCount(), static_cast<uint32_t>(GetParam())); }

TEST_P(JobSystemTest, WaitReturnsAfterEveryJobOfTheGroupRanOnce) {
    constexpr size_t kJobs = 20'000; // more than all deques and the storage hold
    std::vector<std::atomic<int>> runs(kJobs);
    JobGroup group(jobs);
    for (size_t i = 0; i < kJobs; ++i) {
        group.run([&runs, i] { runs[i].fetch_add(1, std::memory_order_relaxed); });
    }
    group.wait();
    EXPECT_TRUE(group.isDone());
    for (size_t i = 0; i < kJobs; ++i) ASSERT_EQ(runs[i].load(), 1) << "job " << i;
}

TEST_P(JobSystemTest, WhatAJobWroteIsVisibleAfterWait) {
    for (int round = 0; round < 500; ++round) {
        int plain[4] = {}; // not atomic on purpose: a missing happens-before is a finding of the thread sanitizer
        JobGroup group(jobs);
        for (int i = 0; i < 4; ++i) group.run([&plain, i, round] { plain[i] = round + i; });
        group.wait();
        for (int i = 0; i < 4; ++i) ASSERT_EQ(plain[i], round + i);
    }
}

TEST_P(JobSystemTest, AGroupCanBeReusedAfterWait) {
    std::atomic<int> sum = 0;
    JobGroup group(jobs);
    for (int round = 1; round <= 200; ++round) {
        for (int i = 0; i < 5; ++i) group.run([&] { sum.fetch_add(1); });
        group.wait();
        ASSERT_EQ(sum.load(), round * 5);
    }
}

TEST_P(JobSystemTest, TheDestructorOfAGroupWaits) {
    std::atomic<int> ran = 0;
    {
        JobGroup group(jobs);
        for (int i = 0; i < 100; ++i) group.run([&] { ran.fetch_add(1); });
    }
    EXPECT_EQ(ran.load(), 100);
}

TEST_P(JobSystemTest, NestedGroupsForkAndJoinRecursively) { EXPECT_EQ(fibonacci(jobs, 18), 2584); }

TEST_P(JobSystemTest, ARecursionThatForksWithoutEndOverflowsIntoInlineRuns) {
    std::atomic<int> leaves = 0;
    JobGroup group(jobs);
    for (int i = 0; i < 4; ++i) {
        group.run([&] {
            for (int j = 0; j < 5'000; ++j) group.run([&] { leaves.fetch_add(1, std::memory_order_relaxed); });
        });
    }
    group.wait();
    EXPECT_EQ(leaves.load(), 20'000);
}

TEST_P(JobSystemTest, ForeignThreadsForkAndWaitAtTheSameTime) {
    constexpr int kThreads = 12; // more than there are guest seats
    std::vector<int64_t> results(kThreads);
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) threads.emplace_back([&, i] { results[i] = fibonacci(jobs, 12 + i % 3); });
    for (std::thread& thread : threads) thread.join();
    constexpr int64_t kExpected[] = { 144, 233, 377 };
    for (int i = 0; i < kThreads; ++i) EXPECT_EQ(results[i], kExpected[i % 3]);
}

TEST_P(JobSystemTest, AJobMayUseAnotherSystem) {
    JobSystem other({ .workers = 2 });
    std::atomic<int64_t> sum = 0;
    parallelFor(jobs, 8, 1, [&](size_t begin, size_t) {
        sum.fetch_add(fibonacci(other, 10) + fibonacci(jobs, 8) + static_cast<int64_t>(begin));
    });
    EXPECT_EQ(sum.load(), 8 * (55 + 21) + 28);
}

TEST_P(JobSystemTest, CapturesAreDestroyedOnceAndBeforeWaitReturns) {
    auto shared = std::make_shared<int>(7);
    {
        JobGroup group(jobs);
        for (int i = 0; i < 100; ++i) group.run([shared] { ASSERT_EQ(*shared, 7); });
        group.wait();
        EXPECT_EQ(shared.use_count(), 1);
    }
}

TEST_P(JobSystemTest, AMoveOnlyCaptureOf48BytesFits) {
    auto owned = std::make_unique<int>(3);
    int64_t result = 0;
    int64_t* to = &result;
    auto job = [owned = std::move(owned), rest = std::array<int64_t, 4>{ 1, 2, 3, 4 }, to] {
        *to = *owned + std::accumulate(rest.begin(), rest.end(), int64_t{ 0 });
    };
    static_assert(sizeof(job) == kJobCaptureBytes);
    JobGroup group(jobs);
    group.run(std::move(job));
    group.wait();
    EXPECT_EQ(result, 13);
}

// ---------------------------------------------------------------------------------------------- parallelFor

TEST_P(JobSystemTest, ParallelForVisitsEveryIndexExactlyOnce) {
    for (const size_t count : { 0, 1, 2, 63, 64, 65, 1000, 4097 }) {
        for (const size_t grain : { 1, 7, 64, 5000 }) {
            std::vector<std::atomic<int>> visits(count);
            parallelFor(jobs, count, grain, [&](size_t begin, size_t end) {
                for (size_t i = begin; i < end; ++i) visits[i].fetch_add(1, std::memory_order_relaxed);
            });
            for (size_t i = 0; i < count; ++i)
                ASSERT_EQ(visits[i].load(), 1) << i << " of " << count << " by " << grain;
        }
    }
}

TEST_P(JobSystemTest, ParallelForHandsOutTheSameRangesForAnyNumberOfWorkers) {
    constexpr size_t kCount = 1003, kGrain = 10;
    std::vector<size_t> endOf(kCount, 0);
    parallelFor(jobs, kCount, kGrain, [&](size_t begin, size_t end) { endOf[begin] = end; });
    for (size_t i = 0; i < kCount; ++i) {
        const size_t expected = i % kGrain != 0 ? 0 : std::min(i + kGrain, kCount);
        ASSERT_EQ(endOf[i], expected) << "range that begins at " << i;
    }
}

TEST_P(JobSystemTest, AFloatReductionPerRangeHasTheSameBitsAsTheSerialOne) {
    constexpr size_t kCount = 10'000, kGrain = 128, kRanges = (kCount + kGrain - 1) / kGrain;
    const auto value = [](size_t i) { return 1.0f / static_cast<float>(i + 1); };
    std::vector<float> partial(kRanges);
    parallelFor(jobs, kCount, kGrain, [&](size_t begin, size_t end) {
        float sum = 0;
        for (size_t i = begin; i < end; ++i) sum += value(i);
        partial[begin / kGrain] = sum;
    });
    for (size_t range = 0; range < kRanges; ++range) {
        float sum = 0;
        for (size_t i = range * kGrain; i < std::min(kCount, (range + 1) * kGrain); ++i) sum += value(i);
        ASSERT_EQ(partial[range], sum);
    }
}

TEST_P(JobSystemTest, ParallelForNests) {
    std::atomic<int> visits = 0;
    parallelFor(jobs, 20, 1, [&](size_t, size_t) {
        parallelFor(jobs, 50, 3, [&](size_t begin, size_t end) { visits.fetch_add(static_cast<int>(end - begin)); });
    });
    EXPECT_EQ(visits.load(), 1000);
}

TEST_P(JobSystemTest, ParallelForSpreadsSlowRangesOverTheWorkers) {
    if (GetParam() == 0) GTEST_SKIP() << "nobody to spread to";
    std::atomic<int> inside = 0, most = 0;
    parallelFor(jobs, 500, 1, [&](size_t, size_t) { // a busy machine may take seconds to start a thread
        int now = inside.fetch_add(1) + 1, seen = most.load();
        while (seen < now && !most.compare_exchange_weak(seen, now)) {
        }
        if (most.load() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        inside.fetch_sub(1);
    });
    EXPECT_GE(most.load(), 2);
    EXPECT_LE(most.load(), GetParam() + 1);
}

// ---------------------------------------------------------------------------------------------- background

TEST_P(JobSystemTest, BackgroundJobsOfAGroupFinishBeforeItsWaitReturns) {
    std::atomic<int> ran = 0;
    JobGroup loads(jobs);
    for (int i = 0; i < 50; ++i) loads.runBackground([&] { ran.fetch_add(1); });
    loads.wait();
    EXPECT_EQ(ran.load(), 50);
}

TEST_P(JobSystemTest, AFrameDoesNotWaitForABackgroundJob) {
    if (GetParam() == 0) GTEST_SKIP() << "without workers a background job runs inside runBackground()";
    std::atomic<bool> release = false, finished = false;
    JobGroup loads(jobs);
    for (int i = 0; i < 2 * GetParam(); ++i) { // more than may run at a time: some stay queued
        loads.runBackground([&] {
            while (!release.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            finished = true;
        });
    }
    const std::thread::id self = std::this_thread::get_id();
    std::atomic<int> visits = 0, byCaller = 0;
    for (int frame = 0; frame < 20; ++frame) {
        parallelFor(jobs, 64, 1, [&](size_t, size_t) {
            visits.fetch_add(1);
            byCaller.fetch_add(std::this_thread::get_id() == self);
        });
    }
    EXPECT_EQ(visits.load(), 20 * 64);
    EXPECT_FALSE(finished.load()); // a wait() that had picked one up would not have come back
    EXPECT_FALSE(loads.isDone());
    release = true;
    loads.wait();
    EXPECT_TRUE(finished.load());
}

// ---------------------------------------------------------------------------------------------- life

TEST_P(JobSystemTest, DestroyingASystemRunsItsQueuedBackgroundJobs) {
    std::atomic<int> ran = 0;
    {
        JobSystem brief({ .workers = GetParam() });
        for (int i = 0; i < 30; ++i) brief.runBackground([&] { ran.fetch_add(1); });
    }
    EXPECT_EQ(ran.load(), 30);
}

TEST_P(JobSystemTest, StartsAndStopsManyTimesWithWorkInFlight) {
    for (int round = 0; round < 60; ++round) {
        std::atomic<int> ran = 0;
        {
            JobSystem brief({ .workers = GetParam() });
            if (round % 3 == 0) continue; // never used
            JobGroup group(brief);
            for (int i = 0; i < round; ++i) group.run([&] { ran.fetch_add(1); });
        }
        ASSERT_EQ(ran.load(), round);
    }
}

TEST_P(JobSystemTest, WorkersThatFellAsleepWakeUpForNewWork) {
    for (int round = 0; round < 30; ++round) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // long after the workers stopped spinning
        std::atomic<bool> ran = false;
        JobGroup group(jobs);
        group.run([&] { ran = true; });
        if (GetParam() > 0) {
            const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
            while (!ran && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
        }
        ASSERT_TRUE(ran.load()) << "no worker woke up in round " << round;
    }
}

TEST_P(JobSystemTest, AWaiterThatFellAsleepWakesUpWhenTheLastJobEnds) {
    for (int round = 0; round < 30; ++round) {
        std::atomic<bool> finished{ false }, otherFinished{ false };
        JobGroup group(jobs);
        group.run([&] {
            std::this_thread::sleep_for(std::chrono::microseconds(500));
            finished = true;
        });
        std::thread other([&] {
            JobGroup nested(jobs);
            nested.run([&] {
                std::this_thread::sleep_for(std::chrono::microseconds(300));
                otherFinished = true;
            });
        });
        group.wait();
        EXPECT_TRUE(finished) << "wait() returns after the job, not before";
        other.join();
        EXPECT_TRUE(otherFinished);
    }
}

TEST_P(JobSystemTest, PinnedWorkersGiveTheSameResults) {
    JobSystem pinned({ .workers = GetParam(),
                       .affinity = AffinityPolicy::pin(),
                       .threadName = "a name beyond fifteen letters" });
    EXPECT_EQ(fibonacci(pinned, 15), 610);
}

TEST(JobSystemOptions, ByDefaultLeaveOneCoreOfTheProcessToTheCaller) {
    const JobSystem jobs;
    EXPECT_EQ(jobs.workerCount(), readCpuBudget().usableThreads - 1);
}

TEST(JobSystemDeathTest, RefusesAnAbsurdNumberOfWorkers) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(JobSystem({ .workers = 100'000 }), "0 to 256");
}

TEST(JobSystemDeathTest, RefusesAnEmptyGrain) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = 0 });
                parallelFor(jobs, 10, 0, [](size_t, size_t) {});
            },
            "at least one index");
}

} // namespace
} // namespace filament_core::jobs
