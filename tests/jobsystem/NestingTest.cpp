// SPDX-License-Identifier: Apache-2.0
// Nested waits, on large and small stacks, and the storage that they exhaust.
#include "tests/jobsystem/JobSystemFixture.h"

#include <pthread.h>
#include <unistd.h>

#include <vector>

namespace filament_core::jobs {
namespace {

class NestingTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, NestingTest, testing::Values(0, 1, 2, 7), workersName);

/// Runs `function` on a thread with a stack of `bytes`.
template <class F>
void onStackOf(size_t bytes, F&& function) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    ASSERT_EQ(pthread_attr_setstacksize(&attributes, bytes), 0);
    pthread_t thread{};
    const auto run = [](void* erased) -> void* {
        (*static_cast<std::remove_reference_t<F>*>(erased))();
        return nullptr;
    };
    ASSERT_EQ(pthread_create(&thread, &attributes, run, &function), 0);
    pthread_attr_destroy(&attributes);
    pthread_join(thread, nullptr);
}

TEST_P(NestingTest, TwentyThousandWaitsInsideEachOtherEnd) {
    EXPECT_EQ(nest(jobs, 20'000), 20'000);
    const AdoptedThread seat(jobs);
    EXPECT_EQ(nest(jobs, 20'000), 20'000);
}

TEST_P(NestingTest, WaitsNestBeyondASmallStack) {
    int depth = 0;
    onStackOf(size_t(512) << 10, [&] { depth = nest(jobs, 6'000); });
    EXPECT_EQ(depth, 6'000);
}

TEST_P(NestingTest, SeveralThreadsNestDeeplyAtATime) {
    std::vector<int> depths(3);
    std::vector<std::thread> threads;
    for (int& depth : depths) {
        threads.emplace_back([&] {
            const AdoptedThread seat(jobs);
            depth = nest(jobs, 8'000);
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const int depth : depths) EXPECT_EQ(depth, 8'000);
}

int nestLoops(JobSystem& jobs, int depth) {
    if (depth == 0) return 0;
    std::atomic<int> deepest = 0;
    parallelFor(jobs, 2, 1, [&](size_t begin, size_t) {
        if (begin == 0) deepest = nestLoops(jobs, depth - 1) + 1;
    });
    return deepest.load();
}

TEST_P(NestingTest, ParallelLoopsNestDeeply) { EXPECT_EQ(nestLoops(jobs, 5'000), 5'000); }

TEST_P(NestingTest, BackgroundJobsNestDeeply) {
    int depth = 0;
    JobGroup loads(jobs);
    loads.runBackground([&] { depth = nest(jobs, 5'000); });
    loads.wait();
    EXPECT_EQ(depth, 5'000);
}

/// More jobs than the storage has room for, and no other thread to run them.
TEST_P(NestingTest, ExhaustedStorageRunsJobsAtOnce) {
    constexpr int kJobs = 30'000;
    for (const bool adopted : { false, true }) {
        std::unique_ptr<AdoptedThread> seat = adopted ? std::make_unique<AdoptedThread>(jobs) : nullptr;
        WorkersHeld held(jobs);
        std::atomic<int> ran = 0;
        JobGroup group(jobs);
        for (int i = 0; i < kJobs; ++i) group.run([&] { ran.fetch_add(1, std::memory_order_relaxed); });
        const int early = ran.load();
        EXPECT_GT(early, kJobs / 2) << "what does not fit runs inside run()";
        if (workers() > 0) {
            EXPECT_LT(early, kJobs) << "what fits is queued";
        }
        held.open();
        group.wait();
        EXPECT_EQ(ran.load(), kJobs);
    }
}

TEST_P(NestingTest, ExhaustedStorageRunsContinuationsToo) {
    const AdoptedThread seat(jobs);
    constexpr int kGroups = 12'000;
    std::atomic<int> ran = 0, continued = 0;
    std::vector<std::unique_ptr<JobGroup>> groups;
    JobGroup next(jobs);
    for (int i = 0; i < kGroups; ++i) {
        groups.push_back(std::make_unique<JobGroup>(jobs));
        groups.back()->run([&] { ran.fetch_add(1); });
        groups.back()->then(next, [&] { continued.fetch_add(1); });
    }
    next.wait();
    EXPECT_EQ(ran.load(), kGroups);
    EXPECT_EQ(continued.load(), kGroups);
}

} // namespace
} // namespace filament_core::jobs
