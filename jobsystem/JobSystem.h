// SPDX-License-Identifier: Apache-2.0
/// JobSystem: a pool of worker threads that steal work from each other. JobGroup: fork and join.
///   In      callables without arguments, captures up to 48 bytes.
///   Out     nothing of its own: a job writes where its captures point, and wait() makes it visible to the waiter.
///   Thread  everything here may be called from any thread, also from inside jobs; several systems may coexist.
///   Memory  fixed after construction: about 300 KiB and 8 KiB a thread. Background jobs cost one heap block each.
///   Limits  a thread queues 1024 jobs; beyond that, or with no workers, run() runs the job before it returns.
///   Fails   never for jobs. A core that refuses to be pinned to is reported in the log and left out.
///   Cost    bench/jobsystem/ForkJoinBench.cpp
///
///   JobGroup group(jobs);                       parallelFor(jobs, lights.size(), 64, [&](size_t begin, size_t end) {
///   group.run([&] { cull(scene, visible); });       for (size_t i = begin; i < end; ++i) fit(lights[i]);
///   group.run([&] { skin(scene, bones); });     });
///   group.wait();
///
/// A job must not block on anything but wait() of a group: it may have been started inside somebody else's wait().
#pragma once

#include "filament_core/base/Assert.h"
#include "jobsystem/Job.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace filament::jobs {

class Scheduler;

enum class Affinity : uint8_t {
    None, ///< the operating system moves threads as it likes
    Pin,  ///< worker i stays on core i + 1 of the process's cpuset (modulo its size); the first core is the caller's
};

struct JobSystemOptions {
    int workers = -1; ///< threads besides the caller; -1: one less than the cores of the process's cpuset; at most 255
    Affinity affinity = Affinity::None;
    std::string threadName = "worker"; ///< debuggers show "worker 0", "worker 1", ...
};

class JobSystem {
public:
    explicit JobSystem(JobSystemOptions options = {});
    /// Runs all queued background jobs, then ends the workers. Every JobGroup has ended before.
    ~JobSystem();
    JobSystem(JobSystem const&) = delete;
    JobSystem& operator=(JobSystem const&) = delete;

    uint32_t workerCount() const;
    /// Time that all workers together spent in frame jobs since the start; background jobs do not count.
    uint64_t busyNanoseconds() const;

    /// Runs `function` once, some time, on a worker that has nothing else to do; for long work such as decoding files.
    /// wait() never picks up a background job, and at most half of the workers (at least one) run them at a time.
    /// Without workers it runs before this returns. What it forks are ordinary jobs: keep those short.
    template <class F>
    void runBackground(F&& function);

    Scheduler& scheduler() { return *mScheduler; }

private:
    std::unique_ptr<Scheduler> mScheduler;
};

/// Jobs to be waited for together. A group may be reused after wait(); one thread or job waits for it at a time.
class JobGroup {
public:
    explicit JobGroup(JobSystem& jobs) : mJobs(jobs) {}
    ~JobGroup() { wait(); }
    JobGroup(JobGroup const&) = delete;
    JobGroup& operator=(JobGroup const&) = delete;

    /// Queues `function`; it may also run at once, inside this call.
    template <class F>
    void run(F&& function);

    /// JobSystem::runBackground() as a member of this group.
    template <class F>
    void runBackground(F&& function);

    /// True when every job finished; what they wrote is visible. To poll background jobs once a frame.
    bool isDone() const { return mCompletion.isDone(); }

    /// Runs jobs, of this group or of others, until every job of this group has finished.
    void wait();

private:
    JobSystem& mJobs;
    Completion mCompletion;
};

/// Calls body(begin, end) once for each of the ranges [0, grain), [grain, 2 grain), ..., the last one ends at `count`.
/// The ranges do not depend on the workers, so a body that reduces over its range gives the same bits everywhere.
/// Pick the grain so that one range takes 5 to 50 microseconds. Returns when all are done.
template <class Body>
void parallelFor(JobSystem& jobs, size_t count, size_t grain, Body&& body);

} // namespace filament::jobs

#include "jobsystem/JobSystem.inl"
