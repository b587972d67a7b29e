// SPDX-License-Identifier: Apache-2.0
// Running a job once a thread has taken it: call it, release its memory, report to its group.
#include "jobsystem/FreshStack.h"
#include "jobsystem/JobFault.h"
#include "jobsystem/Scheduler.h"

#include <new>

namespace filament_core::jobs {
namespace {

/// Sets what the calling thread is doing, for the lifetime of this object.
class RunningJob {
public:
    RunningJob(const char* name, Priority priority) : mOuterName(tAssertContext), mOuterPriority(tThread.priority) {
        tAssertContext = name;
        tThread.priority = priority;
    }
    ~RunningJob() {
        tAssertContext = mOuterName;
        tThread.priority = mOuterPriority;
    }
    RunningJob(RunningJob const&) = delete;
    RunningJob& operator=(RunningJob const&) = delete;

private:
    const char* mOuterName;
    Priority mOuterPriority;
};

template <class F>
void onEnoughStack(F&& function) {
    if (isStackLow()) [[unlikely]] {
        callOnFreshStack(function);
    } else {
        function();
    }
}

} // namespace

namespace detail {

bool runInline(Scheduler& scheduler, const char* name, void (*function)(void*), void* argument) {
    bool isComplete = true;
    onEnoughStack([&] { // possibly on another thread, so no exception may leave this
        const RunningJob running(name, tThread.priority);
        const int64_t begin = scheduler.trace() ? nanosecondsNow() : 0;
        try {
            function(argument);
        } catch (std::bad_alloc const&) {
            isComplete = false;
        } catch (...) {
            reportThrow(tAssertContext);
        }
        if (scheduler.trace()) scheduler.record(tThread.seatOf(scheduler), name, begin, false);
    });
    return isComplete;
}

void throwOutOfMemory() { throw std::bad_alloc(); }

void endUnattended(const char* name) {
    const std::bad_alloc nobodyWaits;
    reportThrow(name, nobodyWaits);
}

} // namespace detail

/// The jobs of one group that this thread has run but not yet reported. While the thread continues with jobs of the
/// same group, the group cannot be done, so the count is unused: a run of thefts touches the group's cache line only
/// once.
class Scheduler::Report {
public:
    Report(Scheduler& scheduler, Seat const& seat) : mScheduler(scheduler), mSeat(seat) {}

    void add(Completion& completion, bool stolen) {
        if (!stolen && completion.finishLocal(mSeat.occupant)) return;
        mGroup = &completion;
        ++mJobs;
    }
    void sendUnlessNextIs(Found const& next) {
        if (!mGroup || (next && next.job->completion == mGroup)) return;
        if (mGroup->finishShared(mJobs)) mScheduler.close(*mGroup);
        mGroup = nullptr;
        mJobs = 0;
    }

private:
    Scheduler& mScheduler;
    Seat const& mSeat;
    Completion* mGroup = nullptr;
    int64_t mJobs = 0;
};

void Scheduler::work(Seat& seat, Found found, Hunt& hunt) {
    const int64_t begin = hunt.now;
    Report report(*this, seat);
    while (found) {
        // Read first: run() returns the job to the pool, where another thread may fill it at once.
        Completion& completion = *found.job->completion;
        const bool stolen = found.stolen;
        run(&seat, found);
        report.add(completion, stolen);
        found = takeOwn(&seat, Priority::Normal);
        if (!found) found = stealAgain(seat, hunt);
        report.sendUnlessNextIs(found);
    }
    const auto busy = static_cast<uint64_t>(hunt.now - begin);
    seat.busyNanoseconds.store(seat.busyNanoseconds.load(std::memory_order_relaxed) + busy, std::memory_order_relaxed);
}

// Reads the clock once per stretch of jobs, not once per job; the stretch begins at the search that found its first
// job.
Scheduler::Found Scheduler::stealAgain(Seat& seat, Hunt& hunt) {
    const int64_t begin = hunt.now;
    hunt.now = nanosecondsNow();
    return seat.patience.learn(hunt.now - begin) ? searchOthers(&seat, Priority::Normal, seat.patience) : Found{};
}

void Scheduler::run(Seat* seat, Found const& found) {
    while (call(seat, found)) {
    }
    // Before the group counts the job as done: the thread that waits for it may end the whole system.
    mStorage.release(seat ? &seat->cache : nullptr, *found.job);
}

void Scheduler::execute(Seat* seat, Found const& found) {
    // As in work(): the job may belong to another thread after run().
    Completion& completion = *found.job->completion;
    run(seat, found);
    finish(seat, completion, found.stolen);
}

void Scheduler::executeInline(Seat* seat, Job& job, Priority priority) {
    onEnoughStack([&] { execute(seat, { &job, priority, false }); });
}

void Scheduler::executeBackground(Job& job) {
    Completion& completion = *job.completion;
    while (call(nullptr, { &job, Priority::Background, false })) {
    }
    delete &job;
    finish(nullptr, completion, true);
}

/// Whether the job's successor must be called, too.
bool Scheduler::callUntraced(Job& job, Priority priority) {
    JobType const& type = *job.type;
    const RunningJob running(type.name, priority);
    try {
        return type.call(job);
    } catch (std::bad_alloc const& exception) {
        if (job.completion == &mBackgroundCompletion) reportThrow(type.name, exception); // nobody waits for it
        job.completion->markOutOfMemory();
        return false;
    } catch (...) {
        reportThrow(type.name);
    }
}

bool Scheduler::call(Seat const* seat, Found const& found) {
    if (!mTrace) [[likely]]
        return callUntraced(*found.job, found.priority);
    const char* name = found.job->type->name;
    const int64_t begin = nanosecondsNow();
    const bool again = callUntraced(*found.job, found.priority);
    record(seat, name, begin, found.stolen); // before the group is done, so that waiting threads find it in the trace
    return again;
}

void Scheduler::record(Seat const* seat, const char* name, int64_t begin, bool stolen) {
    const int64_t end = nanosecondsNow();
    if (seat) {
        mTrace->recordJob(mSeats.indexOf(*seat), name, begin, end, stolen);
    } else {
        mTrace->recordJobHere(name, begin, end, stolen);
    }
}

// For a stolen job, the shared count is changed even if this thread owns the group: it then need not read the cache
// line before writing it, which would move the line between cores twice.
void Scheduler::finish(Seat const* seat, Completion& completion, bool stolen) {
    if (!stolen && seat && completion.finishLocal(seat->occupant)) return;
    if (completion.finishShared()) close(completion);
}

void Scheduler::close(Completion& completion) {
    const bool isOutOfMemory = completion.isOutOfMemory();
    const auto [continuation, sleeper] = completion.close(); // the group's memory may be gone from here on
    if (continuation && isOutOfMemory) continuation->completion->markOutOfMemory();
    if (continuation) enqueue(tThread.seatOf(*this), *continuation, continuation->completion->priority());
    if (sleeper) sleeper->wakeAll();
}

} // namespace filament_core::jobs
