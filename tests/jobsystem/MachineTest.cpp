// SPDX-License-Identifier: Apache-2.0
// Few cores, many workers, and what an idle system costs.
#include "jobsystem/Topology.h"
#include "tests/jobsystem/JobSystemFixture.h"

#include <sched.h>

#include <ctime>

namespace filament_core::jobs {
namespace {

/// Ties the calling thread, and those it starts, to one core.
void tieToOneCore() {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(coresOfThisThread().front(), &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
}

void exercise(JobSystem& jobs) {
    const AdoptedThread seat(jobs);
    EXPECT_EQ(fibonacci(jobs, 16), 987);
    std::atomic<int> visits = 0;
    for (int round = 0; round < 20; ++round) {
        parallelFor(jobs, 1000, 10, [&](size_t begin, size_t end) { visits.fetch_add(static_cast<int>(end - begin)); });
    }
    EXPECT_EQ(visits.load(), 20'000);
    std::atomic<int> loaded = 0;
    JobGroup loads(jobs);
    for (int i = 0; i < 20; ++i) loads.runBackground([&] { loaded.fetch_add(1); });
    loads.wait();
    EXPECT_EQ(loaded.load(), 20);
}

TEST(Machine, OneCoreIsEnoughForAnyNumberOfWorkers) {
    std::thread([] {
        tieToOneCore();
        for (const int workers : { -1, 1, 3, 16 }) {
            JobSystem jobs({ .workers = workers });
            exercise(jobs);
        }
    }).join();
}

TEST(Machine, TwoHundredAndFiftySixWorkersShareWhatCoresThereAre) {
    JobSystem jobs({ .workers = 256 });
    EXPECT_EQ(jobs.workerCount(), 256u);
    exercise(jobs);
}

TEST(Machine, AnIdleSystemUsesNoProcessorTime) {
    JobSystem jobs({ .workers = 7 });
    EXPECT_EQ(fibonacci(jobs, 10), 55);
    std::this_thread::sleep_for(std::chrono::milliseconds(100)); // workers fall asleep
    const clock_t before = std::clock();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, 0.5 * 0.001);
}

TEST(Machine, BusyTimeIsTheTimeThatWorkersSpendInJobs) {
    JobSystem jobs({ .workers = 1 });
    EXPECT_EQ(jobs.busyNanoseconds(), 0u);
    std::atomic<bool> done = false;
    JobGroup group(jobs);
    group.run([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        done = true;
    });
    ASSERT_TRUE(becomesTrue([&] { return done.load(); }));
    group.wait();
    EXPECT_TRUE(becomesTrue([&] { return jobs.busyNanoseconds() >= 20'000'000; }));
}

} // namespace
} // namespace filament_core::jobs
