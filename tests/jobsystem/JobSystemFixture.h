// SPDX-License-Identifier: Apache-2.0
/// Shared by the tests of the job system: a fixture over numbers of workers, a gate, a recursive workload.
#pragma once

#include "jobsystem/JobSystem.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

namespace filament_core::jobs {

/// Every promise of the job system holds for any number of workers.
class JobSystemFixture : public testing::TestWithParam<int> {
protected:
    JobSystem jobs{ { .workers = GetParam() } };
    uint32_t workers() const { return static_cast<uint32_t>(GetParam()); }
};

inline std::string workersName(testing::TestParamInfo<int> const& parameter) { return std::to_string(parameter.param); }

/// False if `condition` does not become true within a minute, so that a hanging test fails instead.
template <class Condition>
bool becomesTrue(Condition&& condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::yield();
    }
    return true;
}

/// Waits for a job that waits for a job ..., `depth` times. Returns `depth`.
inline int nest(JobSystem& jobs, int depth) {
    if (depth == 0) return 0;
    int below = -1;
    JobGroup group(jobs);
    group.run<"nest">([&] { below = nest(jobs, depth - 1); });
    group.wait();
    return below + 1;
}

/// Keeps every worker of a system inside a job until opened.
class WorkersHeld {
public:
    explicit WorkersHeld(JobSystem& jobs, Priority priority = Priority::Normal) : mGroup(jobs, priority) {
        for (uint32_t i = 0; i < jobs.workerCount(); ++i) {
            mGroup.run<"held">([this] {
                mInside.fetch_add(1);
                while (!mOpen.load()) std::this_thread::yield();
            });
        }
        EXPECT_TRUE(becomesTrue([&] { return mInside.load() == jobs.workerCount(); }));
    }
    ~WorkersHeld() { open(); }

    void open() {
        mOpen = true;
        mGroup.wait();
    }
    void openWithoutWaiting() { mOpen = true; }

private:
    std::atomic<uint32_t> mInside{ 0 };
    std::atomic<bool> mOpen{ false };
    JobGroup mGroup;
};

inline int64_t fibonacci(JobSystem& jobs, int n) {
    if (n < 2) return n;
    int64_t left = 0;
    JobGroup group(jobs);
    group.run([&] { left = fibonacci(jobs, n - 1); });
    const int64_t right = fibonacci(jobs, n - 2);
    group.wait();
    return left + right;
}

} // namespace filament_core::jobs
