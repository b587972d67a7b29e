// SPDX-License-Identifier: Apache-2.0
// Storms: many threads use a job system at once, with 1, 2 and 16 workers on any number of cores. Meant for the thread
// sanitizer. FILAMENT_STRESS=N makes every storm N times as long.
#include "tests/jobsystem/JobSystemFixture.h"
#include "tests/jobsystem/Storm.h"

#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <unistd.h>
#include <vector>

namespace filament_core::jobs {
namespace {

using test::onThreads;
using test::scaled;

void add(std::atomic<int64_t>& to, int64_t value = 1) { to.fetch_add(value, std::memory_order_relaxed); }

/// Work that the compiler does not remove: about `count` nanoseconds.
void spend(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) asm volatile("" ::: "memory");
}

class StressTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, StressTest, testing::Values(1, 2, 16), workersName);

// ---------------------------------------------------------------------------------------------- threads come and go

TEST_P(StressTest, ThreadsThatSitDownAndGetUpInAStormLoseNoJob) {
    constexpr int kThreads = 24; // more than there are seats for
    const int rounds = scaled(1000);
    std::atomic<int64_t> ran = 0;
    onThreads(kThreads, [&](int thread) {
        for (int round = 0; round < rounds; ++round) {
            const AdoptedThread seat(jobs);
            JobGroup group(jobs);
            for (int i = 0; i < 8; ++i) group.run([&] { add(ran); });
            if ((round + thread) % 3 != 0) group.wait();
        }
    });
    EXPECT_EQ(ran.load(), int64_t{ kThreads } * rounds * 8);
}

TEST_P(StressTest, AGroupOutlivesTheSeatThatItWasMadeOn) {
    const int rounds = scaled(1500);
    std::atomic<int64_t> ran = 0;
    onThreads(6, [&](int) {
        for (int round = 0; round < rounds; ++round) {
            auto seat = std::make_unique<AdoptedThread>(jobs);
            JobGroup group(jobs);
            for (int i = 0; i < 5; ++i) group.run([&] { add(ran); });
            seat.reset(); // its jobs stay behind, the owner's part of the count with them
            for (int i = 0; i < 5; ++i) group.run([&] { add(ran); });
            seat = std::make_unique<AdoptedThread>(jobs);
            group.wait();
        }
    });
    EXPECT_EQ(ran.load(), int64_t{ 6 } * rounds * 10);
}

TEST_P(StressTest, ThreadsWithoutSeatsForkThroughTheSharedQueue) {
    const int rounds = scaled(300);
    std::atomic<int64_t> ran = 0;
    onThreads(8, [&](int) {
        for (int round = 0; round < rounds; ++round) {
            JobGroup group(jobs);
            for (int i = 0; i < 16; ++i) {
                group.run([&] {
                    JobGroup nested(jobs);
                    nested.run([&] { add(ran); });
                    add(ran);
                });
            }
        }
    });
    EXPECT_EQ(ran.load(), int64_t{ 8 } * rounds * 32);
}

// ---------------------------------------------------------------------------------------------- theft

/// A tree of groups whose branches differ in length, so that thieves find work at every depth. Returns its leaves.
int64_t growTree(JobSystem& jobs, uint32_t seed, int depth) {
    if (depth == 0) {
        spend(seed % 512);
        return 1;
    }
    const uint32_t children = 1 + seed % 4;
    int64_t leaves[4] = {};
    JobGroup group(jobs);
    for (uint32_t i = 0; i < children; ++i) {
        const uint32_t next = seed * 1'664'525u + 1'013'904'223u * (i + 1);
        group.run([&jobs, &leaves, next, i, depth] { leaves[i] = growTree(jobs, next >> 3, depth - 1); });
    }
    group.wait();
    return leaves[0] + leaves[1] + leaves[2] + leaves[3];
}

TEST_P(StressTest, GroupsNestedUnderTheftCountTheSameLeavesAsASerialWalk) {
    JobSystem serial({ .workers = 0 });
    for (int round = 0; round < scaled(60); ++round) {
        const auto seed = static_cast<uint32_t>(round * 7 + 5);
        const int64_t expected = growTree(serial, seed, 7);
        onThreads(3, [&](int thread) {
            const std::unique_ptr<AdoptedThread> seat = thread == 0 ? nullptr : std::make_unique<AdoptedThread>(jobs);
            EXPECT_EQ(growTree(jobs, seed, 7), expected);
        });
    }
}

TEST_P(StressTest, ContinuationsUnderTheftSeeTheWholeGroupBeforeThem) {
    constexpr int kLinks = 12;
    const int rounds = scaled(1500);
    onThreads(3, [&](int thread) {
        const AdoptedThread seat(jobs);
        std::mt19937 random(static_cast<uint32_t>(thread) + 1);
        for (int round = 0; round < rounds; ++round) {
            int sums[kLinks] = {}; // plain: a continuation that comes early is a race
            std::array<std::unique_ptr<JobGroup>, kLinks + 1> groups;
            for (auto& group : groups) group = std::make_unique<JobGroup>(jobs);
            for (int link = 0; link < kLinks; ++link) {
                const uint32_t work = random() % 8 == 0 ? 3'000 : 50; // long enough to be stolen from, now and then
                groups[link]->run([&sums, link, work] {
                    spend(work);
                    ++sums[link];
                });
                groups[link]->then(*groups[link + 1], [&sums, link] {
                    sums[link] = sums[link] * 10 + (link == 0 ? 1 : sums[link - 1] > 0);
                });
            }
            groups[kLinks]->wait();
            for (int link = 0; link < kLinks; ++link) ASSERT_EQ(sums[link], 11) << "link " << link;
        }
    });
}

// Nobody helps the workers here, and they have time to fall asleep, so a lost wake-up stays lost.
TEST_P(StressTest, EveryJobReachesAWorkerAlthoughNobodyWaits) {
    std::mt19937 random(1);
    const AdoptedThread seat(jobs);
    for (int round = 0; round < scaled(1000); ++round) {
        JobGroup group(jobs);
        const int count = 1 + static_cast<int>(random() % 3);
        for (int i = 0; i < count; ++i) group.run([] { spend(200); });
        ASSERT_TRUE(becomesTrue([&] { return group.isDone(); })) << "nobody woke up in round " << round;
        if (round % 2 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 200));
    }
}

// ---------------------------------------------------------------------------------------------- ends

TEST_P(StressTest, ASystemThatEndsWithBackgroundWorkQueuedRunsItAll) {
    for (int round = 0; round < scaled(30); ++round) {
        std::atomic<int64_t> ran = 0;
        {
            JobSystem brief({ .workers = GetParam() });
            for (int i = 0; i < 12; ++i) {
                brief.runBackground([&brief, &ran] {
                    parallelFor(brief, Priority::Normal, 8, 1, [&](size_t, size_t) { add(ran); });
                    JobGroup parts(brief); // of background jobs: pushed while the system ends
                    for (int part = 0; part < 3; ++part) parts.run([&ran] { add(ran); });
                });
            }
            JobGroup frame(brief);
            for (int i = 0; i < 100; ++i) frame.run([&ran] { add(ran); });
        }
        ASSERT_EQ(ran.load(), 12 * (8 + 3) + 100) << "round " << round;
    }
}

TEST_P(StressTest, BackgroundJobsThatQueueMoreWhileTheSystemEndsAreAllRun) {
    for (int round = 0; round < scaled(40); ++round) {
        std::atomic<int64_t> ran = 0;
        {
            JobSystem brief({ .workers = GetParam() });
            brief.runBackground([&brief, &ran] { // by now the destructor waits
                std::this_thread::sleep_for(std::chrono::microseconds(300));
                for (int i = 0; i < 6; ++i) brief.runBackground([&ran] { add(ran); });
                add(ran);
            });
        }
        ASSERT_EQ(ran.load(), 7) << "round " << round;
    }
}

TEST_P(StressTest, SystemsAreMadeAndEndedInParallel) {
    const int rounds = scaled(20);
    onThreads(4, [&](int thread) {
        for (int round = 0; round < rounds; ++round) {
            JobSystem brief({ .workers = GetParam() });
            const AdoptedThread seat(brief);
            const AdoptedThread shared(jobs);
            std::atomic<int64_t> sum = 0;
            parallelFor(brief, 32, 1, [&](size_t begin, size_t) {
                if (begin % 8 == 0) parallelFor(jobs, 8, 2, [&](size_t from, size_t to) { add(sum, to - from); });
                add(sum);
            });
            if ((round + thread) % 2 == 0) brief.runBackground([&] { add(sum); });
            ASSERT_GE(sum.load(), 32 + 4 * 8);
        }
    });
}

// ---------------------------------------------------------------------------------------------- cancelling

TEST_P(StressTest, ACancelledJobRunsToItsEndOrNotAtAll) {
    for (int round = 0; round < scaled(60); ++round) {
        std::atomic<int64_t> begun = 0, ended = 0;
        std::atomic<bool> gone = false;
        Cancellation cancellation;
        JobGroup loads(jobs);
        std::thread canceller([&, round] {
            spend(static_cast<uint32_t>(round * 5'000));
            cancellation.request();
        });
        for (int i = 0; i < 40; ++i) {
            loads.runBackground(cancellation, [&] {
                EXPECT_FALSE(gone.load()) << "a job of a group that is done";
                add(begun);
                for (int step = 0; step < 50 && !cancellation.isRequested(); ++step) spend(200);
                add(ended);
            });
        }
        loads.wait();
        gone = true;
        EXPECT_EQ(begun.load(), ended.load());
        canceller.join();
        loads.runBackground(cancellation, [&] { add(begun); });
        loads.wait();
        EXPECT_EQ(begun.load(), ended.load()) << "a job that was cancelled before it was queued";
    }
}

// ---------------------------------------------------------------------------------------------- endurance

int64_t residentBytes() {
    std::ifstream file("/proc/self/statm");
    int64_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

TEST_P(StressTest, EmptyJobsByTheMillionLeaveNoMemoryBehind) { // FILAMENT_STRESS=100: ten to the eighth
    constexpr int kJobsPerGroup = 10'000;
    const int groups = scaled(100);
    std::atomic<int64_t> ran = 0;
    int64_t before = 0;
    const AdoptedThread seat(jobs);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < groups; ++i) {
        if (i == groups / 10) before = residentBytes(); // by now every stack and queue was touched
        JobGroup group(jobs);
        for (int job = 0; job < kJobsPerGroup; ++job) group.run([&ran] { add(ran); });
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const int64_t grown = residentBytes() - before;
    EXPECT_EQ(ran.load(), int64_t{ groups } * kJobsPerGroup);
    printf("[ ENDURED  ] %.0e jobs in %.1f s, %lld KiB more resident memory\n",
           static_cast<double>(groups) * kJobsPerGroup, seconds.count(), static_cast<long long>(grown / 1024));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which remember what happened
    EXPECT_LT(grown, 4 << 20);
#endif
}

} // namespace
} // namespace filament_core::jobs
