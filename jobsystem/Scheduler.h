// SPDX-License-Identifier: Apache-2.0
/// Scheduler: who runs which job when; the inside of JobSystem.
///   Seats   a deque and a cache of free jobs. Every worker owns one for life; a foreign thread sits down on one of
///           kGuestSeats for the duration of a call, so that an app thread forks as cheaply as a worker does. When all
///           guest seats are taken, its jobs go through the injection queue.
///   Search  own deque (newest first), injection queue, then all other deques (oldest first) from a random one on.
///   Sleep   workers sleep in mIdle, threads inside wait() in mWaiting, both after a short spin. New work wakes one
///           thread, a worker before a waiter; a thread that wakes up and finds work wakes the next one before it
///           starts. The last job of a group wakes the waiters, if one said that it sleeps.
///   Thread  all functions: any.
///   Memory  8.5 KiB a seat, 64 jobs of 72 bytes a seat and 4096 more; the queues grow only for threads without a seat.
///   Source  Blumofe and Leiserson 1999, "Scheduling multithreaded computations by work stealing".
#pragma once

#include "jobsystem/Job.h"
#include "jobsystem/JobStorage.h"
#include "jobsystem/JobSystem.h"
#include "jobsystem/ParkingLot.h"
#include "jobsystem/WorkStealingDeque.h"

// The queue has fences that gcc's thread sanitizer ignores; its data is ordered without them.
#if defined(__SANITIZE_THREAD__)
#pragma GCC diagnostic ignored "-Wtsan"
#endif
#include <concurrentqueue.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace filament::jobs {

class Scheduler {
public:
    static constexpr uint32_t kGuestSeats = 8;
    static constexpr uint32_t kMaxWorkers = 255;
    static constexpr uint32_t kDequeSlots = 1024;

    explicit Scheduler(JobSystemOptions const& options);
    ~Scheduler();
    Scheduler(Scheduler const&) = delete;
    Scheduler& operator=(Scheduler const&) = delete;

    uint32_t workerCount() const { return mWorkerCount; }
    uint64_t busyNanoseconds() const { return mBusyNanoseconds.load(std::memory_order_relaxed); }

    /// An unset job, or null: no workers, or no free job.
    Job* tryAllocate();
    /// Queues a set job from tryAllocate(), or runs it if there is no room.
    void submit(Job& job);
    void submitBackground(std::unique_ptr<Job> job);
    Completion& backgroundCompletion() { return mBackgroundCompletion; }
    /// The calling thread has no job left that others could steal.
    bool isHungry();
    void wait(Completion& completion);

private:
    struct alignas(kCacheLineBytes) Seat {
        WorkStealingDeque<Job, kDequeSlots> deque;
        JobStorage::Cache cache;
        Scheduler* scheduler = nullptr;
        uint32_t random = 0; // state of the victim generator, not 0
        std::atomic<bool> taken{ false };
    };
    class Seating;

    /// A queue of jobs from anywhere. `count` is raised after an item is in. The queue may look empty to a thread that
    /// races with others although an item is left; nobody sleeps while the count is positive, so it is not forgotten.
    struct SharedQueue {
        moodycamel::ConcurrentQueue<Job*> queue;
        alignas(kCacheLineBytes) std::atomic<int64_t> count{ 0 };

        bool push(Job* job);
        Job* pop();
        bool isEmpty() const { return count.load(std::memory_order_seq_cst) <= 0; }
    };

    Seat* takeGuestSeat();
    void runWorker(uint32_t index, std::string const& name, int core);
    void workUntilIdle(Seat& seat, Job* job);
    void sleepUntilWork(Seat& seat);
    bool runBackgroundJob();
    bool mayRunBackground() const;
    Job* findWork(Seat* seat);
    Job* steal(Seat* thief);
    Job* spinForWork(Seat* seat, Completion const* until);
    void sleepUntilWorkOr(Seat* seat, Completion& completion);
    void execute(Seat* seat, Job& job);
    void finish(Completion& completion);
    void notifyWork();

    static thread_local Seat* tSeat; // of the thread's innermost scheduler

    const uint32_t mWorkerCount;
    const uint32_t mSeatCount;
    const uint32_t mBackgroundLimit;
    std::unique_ptr<Seat[]> mSeats; // workers, then guests
    JobStorage mStorage;
    SharedQueue mInjected;
    SharedQueue mBackground;
    std::atomic<uint32_t> mBackgroundRunning{ 0 };
    Completion mBackgroundCompletion;
    alignas(kCacheLineBytes) ParkingLot mIdle;
    alignas(kCacheLineBytes) ParkingLot mWaiting;
    std::atomic<uint64_t> mBusyNanoseconds{ 0 };
    std::atomic<bool> mStopping{ false };
    std::vector<std::thread> mThreads;
};

} // namespace filament::jobs
