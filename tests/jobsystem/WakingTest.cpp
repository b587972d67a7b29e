// SPDX-License-Identifier: Apache-2.0
// The cost of sleeping: nothing while there is no work, and one wake-up for one job.
#include "tests/jobsystem/JobSystemFixture.h"

#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace filament_core::jobs {
namespace {

using namespace std::chrono_literals;

double processorSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](timeval time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// How often the threads with this name have gone to sleep voluntarily.
int64_t timesAsleep(std::string const& threadName) {
    int64_t sum = 0;
    for (auto const& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream file(task.path() / "status");
        bool isOurs = false;
        for (std::string line; std::getline(file, line);) {
            if (line.starts_with("Name:")) isOurs = line.find(threadName) != line.npos;
            if (isOurs && line.starts_with("voluntary_ctxt_switches:")) sum += std::stoll(line.substr(24));
        }
    }
    return sum;
}

constexpr int kWorkers = 16;

class WakingTest : public testing::Test {
protected:
    WakingTest() {
        parallelFor(jobs, 1000, 1, [](size_t, size_t) {});
        std::this_thread::sleep_for(200ms); // the workers fall asleep
    }

    JobSystem jobs{ { .workers = kWorkers, .threadName = "herd" } };
};

TEST_F(WakingTest, SixteenIdleWorkersUseLessThanAThousandthOfACore) {
#if defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the thread sanitizer has a thread of its own that works";
#endif
    const double before = processorSeconds();
    std::this_thread::sleep_for(1s);
    const double used = processorSeconds() - before;
    printf("[ MEASURED ] %d idle workers: %.3f ms of processor time in a second\n", kWorkers, used * 1e3);
    EXPECT_LT(used, 0.001);
}

TEST_F(WakingTest, AJobWakesOneWorkerNotTheHerd) {
    constexpr int kJobs = 100;
    const AdoptedThread seat(jobs);
    const int64_t before = timesAsleep("herd");
    for (int i = 0; i < kJobs; ++i) {
        JobGroup group(jobs);
        group.run([] {});
        ASSERT_TRUE(becomesTrue([&] { return group.isDone(); })); // without helping
        std::this_thread::sleep_for(1ms);
    }
    std::this_thread::sleep_for(50ms); // who woke up has fallen asleep again
    const int64_t wakeUps = timesAsleep("herd") - before;
    printf("[ MEASURED ] %d jobs, %d sleepers: %lld wake-ups\n", kJobs, kWorkers, static_cast<long long>(wakeUps));
    EXPECT_GE(wakeUps, kJobs / 2) << "the count does not count";
    EXPECT_LE(wakeUps, kJobs * 2);
}

TEST_F(WakingTest, ABurstWakesNoMoreOftenThanItHasJobs) {
    constexpr int kBursts = 30, kJobs = 64;
    const AdoptedThread seat(jobs);
    const int64_t before = timesAsleep("herd");
    for (int burst = 0; burst < kBursts; ++burst) {
        JobGroup group(jobs);
        for (int i = 0; i < kJobs; ++i) group.run([] {});
        group.wait();
        std::this_thread::sleep_for(2ms);
    }
    std::this_thread::sleep_for(50ms);
    const int64_t wakeUps = timesAsleep("herd") - before;
    printf("[ MEASURED ] %d bursts of %d empty jobs: %lld wake-ups\n", kBursts, kJobs, static_cast<long long>(wakeUps));
    EXPECT_LE(wakeUps, kBursts * kJobs); // a herd would be sixteen times that
}

} // namespace
} // namespace filament_core::jobs
