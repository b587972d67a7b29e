// SPDX-License-Identifier: Apache-2.0
// Where the operating system refuses every thread, jobs run on the threads that wait for them.
#include "tests/jobsystem/JobSystemFixture.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

namespace filament_core::jobs {
namespace {

/// For a process of its own: from here on, pthread_create() fails. Root is exempt from the limit, so it becomes nobody.
bool refuseThreads() {
    constexpr uid_t kNobody = 65534;
    const rlimit none{ 0, 0 };
    if (setrlimit(RLIMIT_NPROC, &none) != 0) return false;
    if (geteuid() == 0 && setuid(kNobody) != 0) return false;
    try {
        std::thread([] {}).join();
        return false;
    } catch (std::system_error const&) {
        return true;
    }
}

/// Ends with status 0 if `work` gives `expected` without any thread, or if threads cannot be refused here.
template <class Work>
[[noreturn]] void runWithoutThreads(int expected, Work&& work) {
    if (!refuseThreads()) {
        std::fputs("threads cannot be refused here\n", stderr);
        std::_Exit(0);
    }
    const int result = work();
    std::_Exit(result == expected ? 0 : 1);
}

TEST(NoThreads, AllKindsOfJobsRunAndTheSystemSaysThatItHasNoWorkers) {
    const auto work = [] {
        JobSystem jobs({ .workers = 3 });
        if (jobs.workerCount() != 0) return -1;
        std::atomic<int> sum = 0;
        JobGroup group(jobs), critical(jobs, Priority::FrameCritical);
        group.run<"one">([&] { sum += 1; });
        group.runBackground([&] { sum += 10; });
        critical.run<"two">([&] { sum += 100; });
        parallelFor(jobs, 1000, 1, [&](size_t begin, size_t end) { sum += int(end - begin) * 1000; });
        const AdoptedThread seat(jobs);
        group.wait();
        critical.wait();
        return sum.load();
    };
    EXPECT_EXIT(runWithoutThreads(1'000'111, work), testing::ExitedWithCode(0), "0 of 3 workers|cannot be refused");
}

#if !defined(__SANITIZE_THREAD__) // it does not know switched stacks
TEST(NoThreads, WaitsNestDeeplyWithoutHelperThreads) {
    const auto work = [] {
        JobSystem jobs({ .workers = 0 });
        return nest(jobs, 20'000);
    };
    EXPECT_EXIT(runWithoutThreads(20'000, work), testing::ExitedWithCode(0), "");
}
#endif

} // namespace
} // namespace filament_core::jobs
