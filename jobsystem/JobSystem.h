// SPDX-License-Identifier: Apache-2.0
/// JobSystem: a pool of worker threads that steal work from each other. JobGroup: fork, join, continue.
///   In      callables without arguments, captures up to 48 bytes; names are text known at compile time.
///   Out     nothing of its own: a job writes where its captures point, and wait() makes it visible to the waiter.
///   Thread  any, also from inside jobs; several systems may coexist. wait(), isDone() and then() of a group belong to
///           the thread that made it. A thread that is no worker forks fast after AdoptedThread; without, its jobs go
///           through a shared queue.
///   Memory  fixed after construction: about 550 KiB and 16 KiB a worker. Background jobs cost one heap block each.
///   Limits  a thread queues 1024 jobs (256 critical ones); beyond that, or with no workers, run() runs the job before
///           it returns. Waits nest as deep as the machine has memory for stacks.
///   Fails   a job that throws or breaks a rule ends the process with a message that names the job. Workers that the
///           operating system refuses are done without, with a warning.
///   Cost    bench/threading
///
///   AdoptedThread seat(jobs);
///   JobGroup group(jobs);                               parallelFor<"fit">(jobs, lights.size(), 64,
///   group.run<"cull">([&] { cull(scene, visible); });       [&](size_t begin, size_t end) {
///   group.run<"skin">([&] { skin(scene, bones); });             for (size_t i = begin; i < end; ++i) fit(lights[i]);
///   group.wait();                                           });
///
/// A job must not block on anything but wait() of a group: it may have been started inside somebody else's wait().
/// Background jobs may block.
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

namespace filament::jobs {

class JobTrace;
class Scheduler;
struct Seat;

struct JobSystemOptions {
    int workers = -1; ///< threads besides the caller; -1: defaultWorkerCount(affinity); at most 256
    AffinityPolicy affinity{};
    std::string threadName = "worker"; ///< debuggers show "worker 0", "worker 1", ...
    bool trace = false;                ///< record which thread ran which job when
};

class JobSystem {
public:
    explicit JobSystem(JobSystemOptions options = {});
    /// Runs all queued background jobs, then ends the threads. Every JobGroup has ended before.
    ~JobSystem();
    JobSystem(JobSystem const&) = delete;
    JobSystem& operator=(JobSystem const&) = delete;

    uint32_t workerCount() const;
    /// Time that all workers together spent in frame jobs since the start; background jobs do not count.
    uint64_t busyNanoseconds() const;

    /// Runs `function` once, some time, on a thread for long work: it may wait for files and locks. Half as many such
    /// threads as workers (at least one), of a lower priority for the operating system, start when first needed.
    /// Groups made inside are of Priority::Background unless they say otherwise. Without workers it runs before this
    /// returns.
    template <JobName kName = "job", class F>
    void runBackground(F&& function);
    /// The same, unless `cancellation` is requested before it starts; captures up to 40 bytes.
    template <JobName kName = "job", class F>
    void runBackground(Cancellation const& cancellation, F&& function);

    /// The timeline; null unless the options asked for it.
    JobTrace* trace() const;

    Scheduler& scheduler() { return *mScheduler; }

private:
    std::unique_ptr<Scheduler> mScheduler;
};

/// While this lives, the calling thread has a place among the workers: a deque of its own. Ends on the thread it began
/// on, in reverse order; nested ones for the same system cost nothing. 16 threads at a time get a place; more work too,
/// through the shared queue.
class AdoptedThread {
public:
    explicit AdoptedThread(JobSystem& jobs) : AdoptedThread(jobs.scheduler()) {}
    explicit AdoptedThread(Scheduler& scheduler);
    ~AdoptedThread();
    AdoptedThread(AdoptedThread const&) = delete;
    AdoptedThread& operator=(AdoptedThread const&) = delete;

private:
    Seat* mSeat; // null: the thread sits already, or there was no place
};

namespace detail {
[[noreturn]] void throwOutOfMemory();
}

/// Jobs to be waited for together. A group may be reused after wait().
class alignas(kCacheLineBytes) JobGroup {
public:
    /// Of the priority of the job that makes it; Normal outside of jobs.
    explicit JobGroup(JobSystem& jobs);
    JobGroup(JobSystem& jobs, Priority priority);
    /// Waits; what its jobs ran out of is not told.
    ~JobGroup() { waitForEnd(); }
    JobGroup(JobGroup const&) = delete;
    JobGroup& operator=(JobGroup const&) = delete;

    /// Queues `function`; it may also run at once, inside this call. From the thread that made the group and from its
    /// jobs at any time, from others while the group cannot end meanwhile.
    /// A job that returns a callable, an optional one, or next<"name">(callable) is followed by it: at once, on the
    /// same thread, as the same member of the group.
    template <JobName kName = "job", class F>
    void run(F&& function);

    /// JobSystem::runBackground() as a member of this group.
    template <JobName kName = "job", class F>
    void runBackground(F&& function);
    template <JobName kName = "job", class F>
    void runBackground(Cancellation const& cancellation, F&& function);

    /// When every job of this group has finished, `function` runs as a member of `next`, next to the thread that
    /// finished last. Call it after the last run(), once until this group is done; it may be done by then. `next` is
    /// not more urgent than this group: whoever waits for it must be allowed to help here.
    template <JobName kName = "job", class F>
    void then(JobGroup& next, F&& function);

    Priority priority() const { return mCompletion.priority(); }

    /// True when every job finished; what they wrote is visible. To poll background jobs once a frame.
    bool isDone() const { return mCompletion.isDone(); }

    /// Runs jobs, of this group or of others, but none that is less urgent than this group, until all of it is done.
    /// Throws std::bad_alloc if one of its jobs did, or one of a group that it continues: what they wrote is
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

/// Calls body(begin, end) once for each of the ranges [0, grain), [grain, 2 grain), ..., the last one ends at `count`.
/// The ranges do not depend on the workers, so a body that reduces over its range gives the same bits everywhere.
/// Pick the grain so that one range takes 1 to 50 microseconds. Returns when all are done; throws std::bad_alloc if a
/// range did, and then not every index has been visited.
template <JobName kName = "loop", class Body>
void parallelFor(JobSystem& jobs, size_t count, size_t grain, Body&& body);
template <JobName kName = "loop", class Body>
void parallelFor(JobSystem& jobs, Priority priority, size_t count, size_t grain, Body&& body);

} // namespace filament::jobs

#include "jobsystem/JobSystem.inl"
