// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Scheduler.h"

#include "jobsystem/CpuSet.h"

#include <algorithm>
#include <chrono>

namespace filament::jobs {
namespace {

// A sweep over all seats costs about 10 ns a seat; with the pauses a thread looks for 5 to 10 microseconds, about what
// going to sleep and being woken costs, before it gives its core back.
constexpr uint32_t kSpinSweeps = 48;
constexpr uint32_t kPausesPerSweep = 4;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

uint32_t workersFromOption(int workers) {
    FILAMENT_ASSERT(workers >= -1 && workers <= static_cast<int>(Scheduler::kMaxWorkers),
                    "JobSystemOptions::workers is -1 (one less than the cores) or 0 to 255");
    if (workers >= 0) return static_cast<uint32_t>(workers);
    return std::min(static_cast<uint32_t>(coresOfProcess().size()) - 1, Scheduler::kMaxWorkers);
}

// Marsaglia 2003, "Xorshift RNGs": period 2^32 - 1. Which victim is tried first only affects speed.
uint32_t nextRandom(uint32_t& state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

} // namespace

thread_local Scheduler::Seat* Scheduler::tSeat = nullptr;

/// The calling thread's seat while this lives; a foreign thread gets up again afterwards. May be none.
class Scheduler::Seating {
public:
    explicit Seating(Scheduler& scheduler) : mPrevious(tSeat) {
        if (mPrevious && mPrevious->scheduler == &scheduler) return;
        mGuest = scheduler.takeGuestSeat();
        tSeat = mGuest;
    }
    ~Seating() {
        tSeat = mPrevious;
        if (mGuest) mGuest->taken.store(false, std::memory_order_release);
    }
    Seating(Seating const&) = delete;
    Seating& operator=(Seating const&) = delete;

    Seat* seat() const { return tSeat; }

private:
    Seat* mPrevious;
    Seat* mGuest = nullptr;
};

// ---------------------------------------------------------------------------------------------- life

Scheduler::Scheduler(JobSystemOptions const& options)
        : mWorkerCount(workersFromOption(options.workers)), mSeatCount(mWorkerCount + kGuestSeats),
          mBackgroundLimit(std::max(1u, mWorkerCount / 2)), mSeats(std::make_unique<Seat[]>(mSeatCount)),
          mStorage(4096 + mSeatCount * 2 * JobStorage::kBatch) {
    for (uint32_t i = 0; i < mSeatCount; ++i) {
        mSeats[i].scheduler = this;
        mSeats[i].random = 0x9E3779B9u * (i + 1) | 1u;
        mSeats[i].taken.store(i < mWorkerCount, std::memory_order_relaxed);
    }
    const std::vector<int> cores = coresOfProcess();
    mThreads.reserve(mWorkerCount);
    for (uint32_t i = 0; i < mWorkerCount; ++i) {
        const int core = options.affinity == Affinity::Pin ? cores[(i + 1) % cores.size()] : -1;
        mThreads.emplace_back(&Scheduler::runWorker, this, i, options.threadName + ' ' + std::to_string(i), core);
    }
}

Scheduler::~Scheduler() {
    wait(mBackgroundCompletion);
    mStopping.store(true, std::memory_order_seq_cst);
    mIdle.wakeAll();
    for (std::thread& thread : mThreads) thread.join();
}

void Scheduler::runWorker(uint32_t index, std::string const& name, int core) {
    nameThisThread(name);
    if (core >= 0) pinThisThread(core);
    Seat& seat = mSeats[index];
    tSeat = &seat;
    for (;;) {
        if (Job* job = spinForWork(&seat, nullptr)) {
            workUntilIdle(seat, job);
        } else if (runBackgroundJob()) {
            continue;
        } else if (mStopping.load(std::memory_order_seq_cst)) {
            return;
        } else {
            sleepUntilWork(seat);
        }
    }
}

// Two clock reads for a stretch of jobs, not for each.
void Scheduler::workUntilIdle(Seat& seat, Job* job) {
    const auto begin = std::chrono::steady_clock::now();
    for (; job; job = findWork(&seat)) execute(&seat, *job);
    const auto busy = std::chrono::steady_clock::now() - begin;
    mBusyNanoseconds.fetch_add(static_cast<uint64_t>(std::chrono::nanoseconds(busy).count()),
                               std::memory_order_relaxed);
}

void Scheduler::sleepUntilWork(Seat& seat) {
    const ParkingLot::Ticket ticket = mIdle.prepare();
    Job* job = findWork(&seat);
    if (job || !mInjected.isEmpty() || mayRunBackground() || mStopping.load(std::memory_order_seq_cst)) {
        mIdle.cancel();
    } else {
        mIdle.park(ticket);
        job = findWork(&seat);
    }
    if (!job) return;
    notifyWork();
    workUntilIdle(seat, job);
}

// ---------------------------------------------------------------------------------------------- queues

bool Scheduler::SharedQueue::push(Job* job) {
    if (!queue.enqueue(job)) return false;
    count.fetch_add(1, std::memory_order_seq_cst); // the point that prepare() of a sleeper is ordered against
    return true;
}

Job* Scheduler::SharedQueue::pop() {
    Job* job = nullptr;
    if (isEmpty() || !queue.try_dequeue(job)) return nullptr;
    count.fetch_sub(1, std::memory_order_seq_cst);
    return job;
}

Scheduler::Seat* Scheduler::takeGuestSeat() {
    for (uint32_t i = mWorkerCount; i < mSeatCount; ++i) {
        std::atomic<bool>& taken = mSeats[i].taken;
        if (!taken.load(std::memory_order_relaxed) && !taken.exchange(true, std::memory_order_acquire))
            return &mSeats[i];
    }
    return nullptr;
}

Job* Scheduler::tryAllocate() {
    if (mWorkerCount == 0) return nullptr;
    const Seating seating(*this);
    Seat* seat = seating.seat();
    return mStorage.allocate(seat ? &seat->cache : nullptr);
}

void Scheduler::submit(Job& job) {
    const Seating seating(*this);
    Seat* seat = seating.seat();
    if (seat ? seat->deque.push(&job) : mInjected.push(&job)) {
        notifyWork();
    } else {
        execute(seat, job);
    }
}

bool Scheduler::isHungry() {
    const Seating seating(*this);
    Seat* seat = seating.seat();
    return seat ? seat->deque.isEmpty() : mInjected.isEmpty();
}

void Scheduler::notifyWork() {
    if (mIdle.hasSleepers()) {
        mIdle.wakeOne();
    } else {
        mWaiting.wakeOne();
    }
}

// ---------------------------------------------------------------------------------------------- finding and running

Job* Scheduler::findWork(Seat* seat) {
    if (Job* job = seat ? seat->deque.take() : nullptr) return job;
    if (Job* job = mInjected.pop()) return job;
    return steal(seat);
}

Job* Scheduler::steal(Seat* thief) {
    const uint32_t start = thief ? nextRandom(thief->random) % mSeatCount : 0;
    for (uint32_t i = 0; i < mSeatCount; ++i) {
        const uint32_t victim = start + i < mSeatCount ? start + i : start + i - mSeatCount;
        if (&mSeats[victim] == thief) continue;
        if (Job* job = mSeats[victim].deque.steal()) return job;
    }
    return nullptr;
}

Job* Scheduler::spinForWork(Seat* seat, Completion const* until) {
    for (uint32_t sweep = 0; sweep < kSpinSweeps; ++sweep) {
        if (Job* job = findWork(seat)) return job;
        if (until && until->isDone()) return nullptr;
        for (uint32_t i = 0; i < kPausesPerSweep; ++i) pause();
    }
    return nullptr;
}

void Scheduler::execute(Seat* seat, Job& job) {
    Completion& completion = *job.completion;
    job.call(job);
    mStorage.release(seat ? &seat->cache : nullptr, job);
    finish(completion);
}

void Scheduler::finish(Completion& completion) {
    if (completion.finishOne()) mWaiting.wakeAll();
}

// ---------------------------------------------------------------------------------------------- waiting

void Scheduler::wait(Completion& completion) {
    if (completion.isDone()) return;
    const Seating seating(*this);
    Seat* seat = seating.seat();
    bool slept = false;
    while (!completion.isDone()) {
        if (Job* job = spinForWork(seat, &completion)) {
            execute(seat, *job);
        } else if (!completion.isDone()) {
            sleepUntilWorkOr(seat, completion);
            slept = true;
        }
    }
    if (!slept) return;
    completion.forgetSleepers();
    notifyWork(); // a wake-up meant for new work may have been answered by this thread, which leaves
}

void Scheduler::sleepUntilWorkOr(Seat* seat, Completion& completion) {
    const ParkingLot::Ticket ticket = mWaiting.prepare();
    Job* job = nullptr;
    const bool unfinished = completion.announceSleeper();
    if (unfinished) job = findWork(seat);
    if (!unfinished || job || !mInjected.isEmpty()) {
        mWaiting.cancel();
    } else {
        mWaiting.park(ticket);
        if (!completion.isDone()) job = findWork(seat);
    }
    if (!job) return;
    notifyWork();
    execute(seat, *job);
}

// ---------------------------------------------------------------------------------------------- background

void Scheduler::submitBackground(std::unique_ptr<Job> job) {
    const bool queued = mBackground.push(job.get());
    FILAMENT_ASSERT(queued, "out of memory for the queue of background jobs");
    (void)job.release();
    mIdle.wakeOne();
}

bool Scheduler::mayRunBackground() const {
    return !mBackground.isEmpty() && mBackgroundRunning.load(std::memory_order_seq_cst) < mBackgroundLimit;
}

bool Scheduler::runBackgroundJob() {
    if (mBackground.isEmpty()) return false;
    std::unique_ptr<Job> job;
    if (mBackgroundRunning.fetch_add(1, std::memory_order_seq_cst) < mBackgroundLimit) job.reset(mBackground.pop());
    Completion* completion = job ? job->completion : nullptr;
    if (job) {
        if (mayRunBackground()) mIdle.wakeOne(); // two quick submissions may have made one wake-up
        job->call(*job);
    }
    job.reset();
    mBackgroundRunning.fetch_sub(1, std::memory_order_seq_cst);
    if (!completion) return false;
    finish(*completion);
    return true;
}

} // namespace filament::jobs
