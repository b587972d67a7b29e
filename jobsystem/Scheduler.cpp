// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Scheduler.h"

#include "base/Log.h"

#include <algorithm>
#include <system_error>

namespace filament_core::jobs {
namespace {

// About the cost of falling asleep. Longer spinning would heat idle cores; with less, workers would sleep between two
// loops of a frame.
constexpr int64_t kWorkerSpinNanoseconds = 20'000;

uint32_t workersFromOption(JobSystemOptions const& options) {
    const int workers = options.workers;
    FILAMENT_ASSERT(workers >= -1 && workers <= static_cast<int>(Scheduler::kMaxWorkers),
                    "JobSystemOptions::workers is -1 (one less than the cores) or 0 to 256");
    if (workers >= 0) return static_cast<uint32_t>(workers);
    return std::min(defaultWorkerCount(options.affinity), Scheduler::kMaxWorkers);
}

} // namespace

// ---------------------------------------------------------------------------------------------- life

Scheduler::Scheduler(JobSystemOptions const& options)
        : mSeats(*this, workersFromOption(options)), mPlacement(options.affinity, mSeats.workers(), options.threadName),
          mTrace(options.trace ? std::make_unique<JobTrace>(mSeats.workers() + SeatTable::kGuestSeats) : nullptr),
          mStorage(4096 + (mSeats.workers() + SeatTable::kGuestSeats) * 2 * JobStorage::kBatch) {
    const uint32_t workers = mSeats.workers();
    if (workers == 0) return;
    mHasWorkers = true;
    mBackground = std::make_unique<BackgroundThreads>(*this, std::max(1u, workers / 2), options.threadName + " bg");
    startWorkers(options.threadName);
}

void Scheduler::startWorkers(std::string const& threadName) {
    const uint32_t workers = mSeats.workers();
    mThreads.reserve(workers);
    for (uint32_t i = 0; i < workers; ++i) {
        const std::string name = threadName + ' ' + std::to_string(i);
        if (mTrace) mTrace->nameSeat(i, name);
        try {
            mThreads.emplace_back(&Scheduler::runWorker, this, i, name);
        } catch (std::system_error const& error) {
            log(Severity::Warning, "{} starts with only {} of {} workers: {}", threadName, i, workers, error.what());
            if (i > 0) return;
            mHasWorkers = false; // as with JobSystemOptions::workers 0: all work runs on the threads that wait for it
            mBackground.reset();
            return;
        }
    }
}

void Scheduler::endThreads() {
    if (mBackground) mBackground->stop(); // background jobs may still need the workers and the whole system
    // Before the bell rings: a worker that is about to sleep sees one or the other (ParkingLot.h).
    mStopping.store(true, std::memory_order_seq_cst);
    mWaking.idle().wakeAll();
    for (std::thread& thread : mThreads) thread.join();
}

uint64_t Scheduler::busyNanoseconds() {
    uint64_t sum = 0;
    for (uint32_t i = 0; i < mSeats.workers(); ++i) sum += mSeats[i].busyNanoseconds.load(std::memory_order_relaxed);
    return sum;
}

ContentionCounts Scheduler::contention() {
    ContentionCounts sum;
    for (uint32_t seat = 0, end = mSeats.inUse(); seat < end; ++seat) {
        for (size_t kind = 0; kind < kContentionKinds; ++kind)
            sum.by[kind] += mSeats[seat].contention.by[kind].load(std::memory_order_relaxed);
    }
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
    Hunt hunt{ .now = nanosecondsNow() };
    for (;;) {
        if (const Found found = spin(&seat, Priority::Normal, nullptr, kWorkerSpinNanoseconds, hunt)) {
            endHunt(hunt);
            work(seat, found, hunt);
        } else if (mStopping.load(std::memory_order_seq_cst)) {
            return;
        } else {
            sleepUntilWork(hunt);
            mPlacement.placeWorkerAfterWait(index);
        }
    }
}

void Scheduler::sleepUntilWork(Hunt& hunt) {
    stopWatching(hunt);
    mWaking.sleepUnless([this] { return visibleWork(Priority::Normal) || mStopping.load(std::memory_order_seq_cst); });
    hunt.now = nanosecondsNow();
    watch(hunt);
}

// ---------------------------------------------------------------------------------------------- submitting

Job* Scheduler::allocate(Priority priority) {
    if (Seat* seat = tThread.seatOf(*this); seat && priority != Priority::Background) [[likely]]
        return mStorage.allocate(&seat->cache);
    if (workerCount() == 0) return nullptr;
    return priority == Priority::Background ? allocateBackground() : mStorage.allocate(nullptr);
}

void Scheduler::submit(Job& job) {
    Completion& completion = *job.completion;
    const Priority priority = completion.priority();
    Seat* seat = tThread.seatOf(*this);
    completion.add(seat ? seat->occupant : 0);
    enqueue(seat, job, priority);
}

// The job's group already counts it.
void Scheduler::enqueue(Seat* seat, Job& job, Priority priority) {
    if (seat && priority == Priority::Normal) [[likely]] {
        if (!seat->normal.push(&job)) [[unlikely]]
            return executeInline(seat, job, priority);
    } else if (priority == Priority::Background) {
        return pushBackground(job);
    } else if (seat ? !seat->critical.push(&job) : !mInjected[static_cast<int>(priority)].push(job)) {
        return executeInline(seat, job, priority);
    }
    // After the push, so that a search that the hint calls finds the job. Read first: a store takes the cache line from
    // every thread that searches.
    if (priority == Priority::FrameCritical && !mCriticalHint.load(std::memory_order_seq_cst))
        mCriticalHint.store(true, std::memory_order_seq_cst);
    notifyWork(priority);
}

void Scheduler::wakeSomebody(Priority priority) {
    mWaking.wakeSomebody([&] { wakeAWaiter(priority); });
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

Job* Scheduler::allocateBackground() { return mBackground ? new (std::nothrow) Job : nullptr; }

void Scheduler::submitBackground(Job& job) {
    Seat* seat = tThread.seatOf(*this);
    job.completion->add(seat ? seat->occupant : 0);
    pushBackground(job);
}

// Runs the job in place if there is no thread or no memory for it.
void Scheduler::pushBackground(Job& job) {
    if (!mBackground->push(job)) executeBackground(job);
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

void Scheduler::continueWith(Completion& before, Job& job) {
    FILAMENT_ASSERT(!before.hasContinuation(), "JobGroup::then: a group has one continuation until it is done");
    Seat* seat = tThread.seatOf(*this);
    job.completion->add(seat ? seat->occupant : 0);
    if (before.setContinuation(job)) return;
    if (before.isOutOfMemory()) job.completion->markOutOfMemory();
    enqueue(seat, job, job.completion->priority());
}

// ---------------------------------------------------------------------------------------------- used by the templates

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
} // namespace filament_core::jobs
