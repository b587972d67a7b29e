// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/BackgroundThreads.h"
#include "tests/jobsystem/JobSystemFixture.h"

#include <sys/resource.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <set>
#include <vector>

namespace filament_core::jobs {
namespace {

class BackgroundTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, BackgroundTest, testing::Values(0, 1, 2, 7), workersName);

class ThreadSet {
public:
    void addThis() {
        const std::lock_guard lock(mMutex);
        mIds.insert(std::this_thread::get_id());
    }
    std::set<std::thread::id> get() {
        const std::lock_guard lock(mMutex);
        return mIds;
    }

private:
    std::mutex mMutex;
    std::set<std::thread::id> mIds;
};

TEST_P(BackgroundTest, NoThreadRunsBothFrameJobsAndBackgroundJobs) {
    if (workers() == 0) GTEST_SKIP() << "without workers the caller does everything";
    ThreadSet frame, background;
    JobGroup loads(jobs);
    for (int i = 0; i < 200; ++i) loads.runBackground([&] { background.addThis(); });
    for (int i = 0; i < 50; ++i) parallelFor(jobs, 64, 1, [&](size_t, size_t) { frame.addThis(); });
    loads.wait();
    for (std::thread::id id : background.get()) EXPECT_FALSE(frame.get().contains(id));
    EXPECT_FALSE(background.get().contains(std::this_thread::get_id()));
}

TEST_P(BackgroundTest, EveryWorkerIsFreeForFramesWhileBackgroundJobsBlock) {
    if (workers() == 0) GTEST_SKIP() << "without workers the caller does everything";
    std::atomic<bool> release = false;
    JobGroup loads(jobs);
    for (uint32_t i = 0; i < 4 * workers(); ++i) {
        loads.runBackground([&] {
            while (!release.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
    }
    {
        const WorkersHeld all(jobs); // fails unless every worker is there
    }
    EXPECT_FALSE(loads.isDone());
    release = true;
    loads.wait();
}

TEST_P(BackgroundTest, ThreadsAreNicerThanFrameThreads) {
    if (workers() == 0) GTEST_SKIP() << "without workers the caller does everything";
    const auto niceness = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); };
    int background = 0;
    JobGroup loads(jobs);
    loads.runBackground([&] { background = niceness(); });
    loads.wait();
    EXPECT_EQ(background, std::max(niceness(), BackgroundThreads::kNiceness));
}

TEST_P(BackgroundTest, AtMostHalfAsManyJobsAsWorkersRunAtATime) {
    if (workers() == 0) GTEST_SKIP() << "without workers the caller does everything";
    const int limit = std::max(1, GetParam() / 2);
    std::atomic<int> inside = 0, most = 0;
    JobGroup loads(jobs);
    for (int i = 0; i < 20; ++i) {
        loads.runBackground([&] {
            int now = inside.fetch_add(1) + 1, seen = most.load();
            while (seen < now && !most.compare_exchange_weak(seen, now)) {
            }
            EXPECT_TRUE(becomesTrue([&] { return most.load() >= limit; })); // however late a thread comes
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            inside.fetch_sub(1);
        });
    }
    loads.wait();
    EXPECT_EQ(most.load(), limit);
}

TEST_P(BackgroundTest, WhatABackgroundJobForksStaysInTheBackground) {
    if (workers() == 0) GTEST_SKIP() << "without workers the caller does everything";
    ThreadSet forked, frame;
    std::atomic<int> visits = 0;
    JobGroup loads(jobs);
    for (int i = 0; i < 4; ++i) {
        loads.runBackground([&] {
            JobGroup inner(jobs);
            for (int j = 0; j < 10; ++j) inner.run([&] { forked.addThis(); });
            parallelFor(jobs, 32, 1, [&](size_t, size_t) {
                forked.addThis();
                visits.fetch_add(1);
            });
            inner.wait();
        });
    }
    for (int i = 0; i < 20; ++i) parallelFor(jobs, 64, 1, [&](size_t, size_t) { frame.addThis(); });
    loads.wait();
    EXPECT_EQ(visits.load(), 4 * 32);
    for (std::thread::id id : forked.get()) EXPECT_FALSE(frame.get().contains(id));
}

TEST_P(BackgroundTest, AJobMayForkAndJoinRecursively) {
    std::vector<int64_t> results(4);
    JobGroup loads(jobs);
    for (int64_t& result : results) loads.runBackground([&] { result = fibonacci(jobs, 9); });
    loads.wait();
    for (const int64_t result : results) EXPECT_EQ(result, 34);
}

TEST_P(BackgroundTest, AJobMayWaitForFrameWork) {
    std::vector<int64_t> results(4);
    JobGroup loads(jobs);
    for (int64_t& result : results) {
        loads.runBackground([&] {
            for (int round = 0; round < 50; ++round) {
                JobGroup frame(jobs, Priority::Normal);
                frame.run([&] { result = fibonacci(jobs, 7); });
                frame.wait();
            }
        });
    }
    loads.wait();
    for (const int64_t result : results) EXPECT_EQ(result, 13);
}

TEST_P(BackgroundTest, AGroupOfBackgroundPriorityRunsItsJobsInTheBackground) {
    std::thread::id where;
    JobGroup loads(jobs, Priority::Background);
    loads.run([&] { where = std::this_thread::get_id(); });
    loads.wait();
    EXPECT_EQ(where == std::this_thread::get_id(), workers() == 0);
}

// ---------------------------------------------------------------------------------------------- cancellation

TEST_P(BackgroundTest, JobsThatHaveNotStartedWhenTheyAreCancelledNeverDo) {
    if (workers() == 0) GTEST_SKIP() << "without workers a job has run before anybody can cancel it";
    Cancellation gone;
    std::atomic<bool> release = false;
    std::atomic<uint32_t> started = 0;
    const uint32_t threads = std::max(1u, workers() / 2);
    auto alive = std::make_shared<int>(1);
    {
        JobGroup loads(jobs);
        for (int i = 0; i < 50; ++i) {
            loads.runBackground<"decode">(gone, [&, alive] {
                started.fetch_add(1);
                while (!release.load()) std::this_thread::yield();
            });
        }
        ASSERT_TRUE(becomesTrue([&] { return started.load() == threads; }));
        gone.request();
        release = true;
        loads.wait();
    }
    EXPECT_EQ(started.load(), threads);
    EXPECT_EQ(alive.use_count(), 1) << "captures of jobs that never ran are destroyed, too";
}

TEST_P(BackgroundTest, AJobThatRunsSeesTheRequest) {
    if (workers() == 0) GTEST_SKIP() << "without workers a job has run before anybody can cancel it";
    Cancellation gone;
    std::atomic<bool> started = false;
    JobGroup loads(jobs);
    loads.runBackground(gone, [&] {
        started = true;
        while (!gone.isRequested()) std::this_thread::yield();
    });
    ASSERT_TRUE(becomesTrue([&] { return started.load(); }));
    EXPECT_FALSE(loads.isDone());
    gone.request();
    loads.wait();
}

TEST_P(BackgroundTest, AJobThatIsCancelledBeforeItIsQueuedDoesNotRun) {
    Cancellation gone;
    gone.request();
    bool ran = false;
    JobGroup loads(jobs);
    loads.runBackground(gone, [&] { ran = true; });
    loads.wait();
    EXPECT_FALSE(ran);
}

TEST_P(BackgroundTest, WithoutARequestEveryJobRuns) {
    const Cancellation never;
    std::atomic<int> ran = 0;
    JobGroup loads(jobs);
    for (int i = 0; i < 100; ++i) loads.runBackground(never, [&] { ran.fetch_add(1); });
    loads.wait();
    EXPECT_EQ(ran.load(), 100);
}

} // namespace
} // namespace filament_core::jobs
