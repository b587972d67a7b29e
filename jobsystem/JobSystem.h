// SPDX-License-Identifier: Apache-2.0
/// JobSystem: a pool of worker threads that steal work from each other. JobGroup: fork, join, continue.
///   In      callables without arguments, with captures up to 48 bytes; names are compile-time text.
///   Out     none: a job writes through its captures, and wait() makes the result visible to the waiting thread.
///   Thread  any, also inside jobs; several systems may coexist. wait(), isDone() and then() of a group belong to the
///           thread that made it. A thread that is not a worker forks fast after AdoptedThread; otherwise its jobs go
///           through a shared queue.
///   Memory  fixed after construction: about 550 KiB, and 16 KiB per worker. Background jobs cost one heap block each.
///   Limits  a thread queues 1024 jobs (256 critical ones). Beyond that, or without workers, run() runs the job before
///           it returns. Waits nest as deep as there is memory for stacks.
///   Fails   a job that throws or breaks a rule ends the process with a message that names the job. If the operating
///           system refuses workers, the system does without them and warns.
///   Cost    bench/threading
///
///   AdoptedThread seat(jobs);
///   JobGroup group(jobs);                               parallelFor<"fit">(jobs, lights.size(), 64,
///   group.run<"cull">([&] { cull(scene, visible); });       [&](size_t begin, size_t end) {
///   group.run<"skin">([&] { skin(scene, bones); });             for (size_t i = begin; i < end; ++i) fit(lights[i]);
///   group.wait();                                           });
///
/// A job must not block on anything except wait() of a group, because it may have been started inside another job's
/// wait(). Background jobs may block.
#pragma once

#include "base/Assert.h"
#include "jobsystem/AffinityPolicy.h"
#include "jobsystem/Cancellation.h"
#include "jobsystem/Completion.h"
#include "jobsystem/Job.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace filament_core::jobs {

class JobTrace;
class Scheduler;
struct Seat;

struct JobSystemOptions {
    int workers = -1; ///< threads besides the caller; -1: defaultWorkerCount(affinity); at most 256
    AffinityPolicy affinity{};
    std::string threadName = "worker"; ///< debuggers show "worker 0", "worker 1", ...
    bool trace = false;                ///< record which thread ran which job and when
};

class JobSystem {
public:
    explicit JobSystem(JobSystemOptions options = {});
    /// Runs all queued background jobs, then ends the threads. Every JobGroup must have ended before.
    ~JobSystem();
    JobSystem(JobSystem const&) = delete;
    JobSystem& operator=(JobSystem const&) = delete;

    uint32_t workerCount() const;
    /// Time that all workers together have spent in frame jobs; background jobs do not count.
    uint64_t busyNanoseconds() const;

    /// Runs `function` once, eventually, on a thread for long work: it may wait for files and locks. Half as many such
    /// threads as workers (at least one) start when first needed, with a lower priority in the operating system. Groups
    /// created inside have Priority::Background unless they say otherwise. Without workers `function` runs before this
    /// returns.
    template <JobName kName = "job", class F>
    void runBackground(F&& function);
    /// The same, unless `cancellation` is requested before it starts; captures up to 40 bytes.
    template <JobName kName = "job", class F>
    void runBackground(Cancellation const& cancellation, F&& function);

    /// The timeline; null unless requested by the options.
    JobTrace* trace() const;

    Scheduler& scheduler() { return *mScheduler; }

private:
    std::unique_ptr<Scheduler> mScheduler;
};

/// While this lives, the calling thread has a place among the workers, with its own deque. It must end on the thread
/// where it began, in reverse order; nested ones for the same system cost nothing. 16 threads at a time get a place;
/// further threads also work, through the shared queue.
class AdoptedThread {
public:
    explicit AdoptedThread(JobSystem& jobs) : AdoptedThread(jobs.scheduler()) {}
    explicit AdoptedThread(Scheduler& scheduler);
    ~AdoptedThread();
    AdoptedThread(AdoptedThread const&) = delete;
    AdoptedThread& operator=(AdoptedThread const&) = delete;

private:
    Seat* mSeat; // null: the thread already had a place, or none was free
};

namespace detail {
[[noreturn]] void throwOutOfMemory();
}

/// Jobs that are waited for together. A group may be reused after wait().
class alignas(kCacheLineBytes) JobGroup {
public:
    /// With the priority of the job that creates it; Normal outside of jobs.
    explicit JobGroup(JobSystem& jobs);
    JobGroup(JobSystem& jobs, Priority priority);
    /// Waits, but does not report that jobs ran out of memory.
    ~JobGroup() { waitForEnd(); }
    JobGroup(JobGroup const&) = delete;
    JobGroup& operator=(JobGroup const&) = delete;

    /// Queues `function`, or runs it at once inside this call. The thread that made the group and the group's jobs may
    /// call this at any time; other threads only while the group cannot end.
    /// If a job returns a callable, an optional callable, or next<"name">(callable), that runs next, on the same thread
    /// and as the same member of the group.
    template <JobName kName = "job", class F>
    void run(F&& function);

    /// JobSystem::runBackground() as a member of this group.
    template <JobName kName = "job", class F>
    void runBackground(F&& function);
    template <JobName kName = "job", class F>
    void runBackground(Cancellation const& cancellation, F&& function);

    /// When every job of this group has finished, `function` runs as a member of `next`, beside the thread that
    /// finished last. Call it after the last run(), and once until this group is done; it may already be done. `next`
    /// must not be more urgent than this group: a thread that waits for it must be allowed to help here.
    template <JobName kName = "job", class F>
    void then(JobGroup& next, F&& function);

    Priority priority() const { return mCompletion.priority(); }

    /// True when every job has finished; their results are visible. Use it to poll background jobs once per frame.
    bool isDone() const { return mCompletion.isDone(); }

    /// Runs jobs of this group or of others, but none less urgent than this group, until the whole group is done.
    /// Throws std::bad_alloc if one of its jobs did, or a job of a group that it continues; the results are then
    /// incomplete.
    void wait() {
        waitForEnd();
        if (mCompletion.takeOutOfMemory()) [[unlikely]]
            detail::throwOutOfMemory();
    }

private:
    void waitForEnd() {
        if (!mCompletion.isDone()) waitInside();
    }
    void waitInside();

    Scheduler& mScheduler;
    Completion mCompletion;
};

/// Calls body(begin, end) once for each of the ranges [0, grain), [grain, 2 grain), ..., the last of which ends at
/// `count`. The ranges do not depend on the workers, so a body that reduces over its range gives the same bits
/// everywhere. Choose the grain so that one range takes 1 to 50 microseconds. Returns when all are done; throws
/// std::bad_alloc if a range did, in which case not every index has been visited.
template <JobName kName = "loop", class Body>
void parallelFor(JobSystem& jobs, size_t count, size_t grain, Body&& body);
template <JobName kName = "loop", class Body>
void parallelFor(JobSystem& jobs, Priority priority, size_t count, size_t grain, Body&& body);

} // namespace filament_core::jobs

#include "jobsystem/JobSystem.inl"
