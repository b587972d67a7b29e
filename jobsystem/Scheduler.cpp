// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Scheduler.h"

#include "jobsystem/FreshStack.h"
#include "jobsystem/JobFault.h"

#include <algorithm>

namespace filament::jobs {
namespace {

// About what it costs to fall asleep; longer would heat idle cores, shorter would sleep between two loops of a frame.
constexpr int64_t kWorkerSpinNanoseconds = 20'000;

uint32_t workersFromOption(JobSystemOptions const& options) {
    const int workers = options.workers;
    FILAMENT_ASSERT(workers >= -1 && workers <= static_cast<int>(Scheduler::kMaxWorkers),
                    "JobSystemOptions::workers is -1 (one less than the cores) or 0 to 256");
    if (workers >= 0) return static_cast<uint32_t>(workers);
    return std::min(defaultWorkerCount(options.affinity), Scheduler::kMaxWorkers);
}

/// What the calling thread is doing while this lives.
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

void callUntraced(Job& job, Priority priority) {
    JobType const& type = *job.type;
    const RunningJob running(type.name, priority);
    try {
        type.call(job);
    } catch (...) {
        reportThrow(type.name);
    }
}

} // namespace

namespace detail {

void runInline(Scheduler& scheduler, const char* name, void (*function)(void*), void* argument) {
    auto run = [&] {
        const RunningJob running(name, tThread.priority);
        const int64_t begin = scheduler.trace() ? nanosecondsNow() : 0;
        try {
            function(argument);
        } catch (...) {
            reportThrow(name);
        }
        if (scheduler.trace()) scheduler.record(tThread.seatOf(scheduler), name, begin, false);
    };
    if (isStackLow()) {
        callOnFreshStack(run);
    } else {
        run();
    }
}

} // namespace detail

// ---------------------------------------------------------------------------------------------- life

Scheduler::Scheduler(JobSystemOptions const& options)
        : mSeats(*this, workersFromOption(options)), mPlacement(options.affinity, mSeats.workers(), options.threadName),
          mTrace(options.trace ? std::make_unique<JobTrace>(mSeats.workers() + SeatTable::kGuestSeats) : nullptr),
          mStorage(4096 + (mSeats.workers() + SeatTable::kGuestSeats) * 2 * JobStorage::kBatch) {
    const uint32_t workers = mSeats.workers();
    if (workers == 0) return;
    mBackground = std::make_unique<BackgroundThreads>(*this, std::max(1u, workers / 2), options.threadName + " bg");
    mThreads.reserve(workers);
    for (uint32_t i = 0; i < workers; ++i) {
        const std::string name = options.threadName + ' ' + std::to_string(i);
        if (mTrace) mTrace->nameSeat(i, name);
        mThreads.emplace_back(&Scheduler::runWorker, this, i, name);
    }
}

Scheduler::~Scheduler() {
    if (mBackground) mBackground->stop(); // its jobs may still need workers, and the system as it is
    mStopping.store(true, std::memory_order_seq_cst);
    mIdle.wakeAll();
    for (std::thread& thread : mThreads) thread.join();
}

uint64_t Scheduler::busyNanoseconds() {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < mSeats.workers(); ++i) sum += mSeats[i].busyNanoseconds.load(std::memory_order_relaxed);
    return sum;
}

Seat* Scheduler::adoptThread() {
    if (workerCount() == 0 || tThread.seatOf(*this) || tThread.background == mBackground.get()) return nullptr;
    Seat* seat = mSeats.sitDown();
    if (!seat) return nullptr;
    seat->outer = tThread.seat;
    tThread.seat = seat;
    if (mTrace) mTrace->nameSeat(mSeats.indexOf(*seat), nameOfThisThread());
    return seat;
}

void Scheduler::releaseThread(Seat& seat) {
    FILAMENT_ASSERT(tThread.seat == &seat, "AdoptedThread ends on the thread it began on, the last one first");
    tThread.seat = seat.outer;
    mSeats.getUp(seat);
}

void Scheduler::runWorker(uint32_t index, std::string const& name) {
    nameThisThread(name);
    mPlacement.placeWorker(index);
    Seat& seat = mSeats[index];
    tThread.seat = &seat;
    for (;;) {
        if (const Found found = spin(&seat, Priority::Normal, nullptr, kWorkerSpinNanoseconds)) {
            work(seat, found);
        } else if (mStopping.load(std::memory_order_seq_cst)) {
            return;
        } else {
            sleepUntilWork(seat);
        }
    }
}

// Two clock reads for a stretch of jobs, not for each.
void Scheduler::work(Seat& seat, Found found) {
    const int64_t begin = nanosecondsNow();
    for (; found; found = takeOwn(&seat, Priority::Normal)) execute(&seat, found);
    const int64_t busy = nanosecondsNow() - begin;
    seat.busyNanoseconds.store(seat.busyNanoseconds.load(std::memory_order_relaxed) + static_cast<uint64_t>(busy),
                               std::memory_order_relaxed);
    seat.patience.learn(busy);
}

void Scheduler::sleepUntilWork(Seat& seat) {
    const ParkingLot::Ticket ticket = mIdle.prepare();
    Found found = searchOthersThoroughly(&seat, Priority::Normal);
    if (found || visibleWork(Priority::Normal) || mStopping.load(std::memory_order_seq_cst)) {
        mIdle.cancel();
    } else {
        mIdle.park(ticket);
        found = searchOthersThoroughly(&seat, Priority::Normal);
    }
    if (!found) return;
    passOnWakeUp();
    work(seat, found);
}

// ---------------------------------------------------------------------------------------------- submitting

Job* Scheduler::allocate(Priority priority) {
    if (workerCount() == 0) return nullptr;
    if (priority == Priority::Background) return allocateBackground();
    Seat* seat = tThread.seatOf(*this);
    return mStorage.allocate(seat ? &seat->cache : nullptr);
}

void Scheduler::submit(Job& job) {
    Completion& completion = *job.completion;
    const Priority priority = completion.priority();
    if (priority == Priority::Background) return submitBackground(job);
    Seat* seat = tThread.seatOf(*this);
    completion.add(seat ? seat->occupant : 0);
    enqueue(seat, job, priority);
}

void Scheduler::enqueue(Seat* seat, Job& job, Priority priority) {
    const bool queued = seat ? seat->push(priority, job) : mInjected[static_cast<int>(priority)].push(job);
    if (!queued) return executeInline(seat, job, priority);
    if (priority == Priority::FrameCritical && !mCriticalHint.load(std::memory_order_seq_cst))
        mCriticalHint.store(true, std::memory_order_seq_cst);
    notifyWork(priority);
}

void Scheduler::notifyWork(Priority priority) {
    if (mIdle.hasSleepers()) {
        mIdle.wakeOne();
    } else if (mSleepingWaiters.load(std::memory_order_seq_cst) != 0) {
        wakeAWaiter(priority);
    }
}

void Scheduler::wakeAWaiter(Priority priority) {
    const auto level = static_cast<uint8_t>(priority);
    for (uint32_t i = 0, end = mSeats.inUse(); i < end; ++i) {
        Seat& seat = mSeats[i];
        if (!seat.bell.hasSleepers() || seat.waitsFor.load(std::memory_order_relaxed) < level) continue;
        seat.bell.wakeOne();
        return;
    }
}

Job* Scheduler::allocateBackground() { return mBackground ? new Job : nullptr; }

void Scheduler::submitBackground(Job& job) {
    Seat* seat = tThread.seatOf(*this);
    job.completion->add(seat ? seat->occupant : 0);
    mBackground->push(job);
}

void Scheduler::executeBackground(Job& job) {
    Completion& completion = *job.completion;
    call(nullptr, { &job, Priority::Background, false });
    delete &job;
    finish(nullptr, completion, true);
}

bool Scheduler::isHungry(Seat* seat, Priority priority) const {
    switch (priority) {
    case Priority::Background:
        return mBackground && mBackground->wantsMore();
    case Priority::FrameCritical:
        return seat ? seat->critical.isEmpty() : mInjected[0].isEmpty();
    case Priority::Normal:
        break;
    }
    return seat ? seat->normal.isEmpty() : mInjected[1].isEmpty();
}

// ---------------------------------------------------------------------------------------------- running

void Scheduler::call(Seat const* seat, Found const& found) {
    if (!mTrace) [[likely]]
        return callUntraced(*found.job, found.priority);
    const char* name = found.job->type->name;
    const int64_t begin = nanosecondsNow();
    callUntraced(*found.job, found.priority);
    record(seat, name, begin, found.stolen); // before the group is done: whoever waited finds it in the trace
}

void Scheduler::record(Seat const* seat, const char* name, int64_t begin, bool stolen) {
    const int64_t end = nanosecondsNow();
    if (seat) {
        mTrace->recordJob(mSeats.indexOf(*seat), name, begin, end, stolen);
    } else {
        mTrace->recordJobHere(name, begin, end, stolen);
    }
}

void Scheduler::execute(Seat* seat, Found const& found) {
    Job& job = *found.job;
    Completion& completion = *job.completion;
    call(seat, found);
    mStorage.release(seat ? &seat->cache : nullptr, job);
    finish(seat, completion, found.stolen);
}

void Scheduler::executeInline(Seat* seat, Job& job, Priority priority) {
    auto run = [&] { execute(seat, { &job, priority, false }); };
    if (isStackLow()) {
        callOnFreshStack(run);
    } else {
        run();
    }
}

// A thief leaves the owner's part of the count alone even if it is the owner: so it need not read the line before it
// changes it, which would move it between the cores twice.
void Scheduler::finish(Seat const* seat, Completion& completion, bool stolen) {
    if (!stolen && seat && completion.finishLocal(seat->occupant)) return;
    if (completion.finishShared()) close(completion);
}

void Scheduler::close(Completion& completion) {
    const auto [continuation, sleeper] = completion.close(); // the memory may be gone
    if (continuation) enqueueCounted(*continuation);
    if (sleeper) sleeper->wakeAll();
}

// The group of the job counts it already.
void Scheduler::enqueueCounted(Job& job) {
    const Priority priority = job.completion->priority();
    if (priority == Priority::Background) return mBackground->push(job);
    enqueue(tThread.seatOf(*this), job, priority);
}

void Scheduler::continueWith(Completion& before, Job& job) {
    FILAMENT_ASSERT(!before.hasContinuation(), "JobGroup::then: a group has one continuation until it is done");
    Seat* seat = tThread.seatOf(*this);
    job.completion->add(seat ? seat->occupant : 0);
    if (!before.setContinuation(job)) enqueueCounted(job);
}

// ---------------------------------------------------------------------------------------------- the templates' doors

namespace detail {

Job* allocate(Scheduler& scheduler, Priority priority) { return scheduler.allocate(priority); }
void submit(Scheduler& scheduler, Job& job) { scheduler.submit(job); }
Job* allocateBackground(Scheduler& scheduler) { return scheduler.allocateBackground(); }
void submitBackground(Scheduler& scheduler, Job& job) { scheduler.submitBackground(job); }
Completion& backgroundCompletion(Scheduler& scheduler) { return scheduler.backgroundCompletion(); }
void continueWith(Scheduler& scheduler, Completion& before, Job& job) { scheduler.continueWith(before, job); }
Seat* seatHere(Scheduler& scheduler) { return tThread.seatOf(scheduler); }
Priority inheritedPriority() { return tThread.priority; }
bool isHungry(Scheduler& scheduler, Seat* seat, Priority priority) { return scheduler.isHungry(seat, priority); }

} // namespace detail
} // namespace filament::jobs
