// SPDX-License-Identifier: Apache-2.0
/// Scheduler: decides which thread runs which job and when; the implementation of JobSystem.
///   Search  own critical jobs (newest first); critical jobs of others, if there is a hint of any; own normal jobs;
///           then the injection queues and the deques of others (oldest first): where it saw work last, and a few more.
///   Sleep   after a short spin, workers sleep in mWaking, and threads inside wait() at the bell of their seat. New
///           work wakes one thread, a worker before a waiting thread; a woken thread that sees more work than it took
///           wakes the next. The last job of a group wakes the one thread that waits for it.
///   Thread  all functions: any.
///   Memory  SeatTable, 64 jobs of 72 bytes per seat, and 4096 more; the queues grow only for threads without a seat.
///   Source  Blumofe and Leiserson 1999, "Scheduling multithreaded computations by work stealing".
///   Files   Scheduler.cpp: workers and queues. Search.cpp: finding work. Running.cpp: calling it. Waiting.cpp: wait().
#pragma once

#include "jobsystem/Affinity.h"
#include "jobsystem/BackgroundThreads.h"
#include "jobsystem/InjectionQueue.h"
#include "jobsystem/Job.h"
#include "jobsystem/JobStorage.h"
#include "jobsystem/JobSystem.h"
#include "jobsystem/JobTrace.h"
#include "jobsystem/ParkingLot.h"
#include "jobsystem/Seat.h"
#include "jobsystem/Waking.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::jobs {

class Scheduler {
public:
    static constexpr uint32_t kMaxWorkers = 256;

    explicit Scheduler(JobSystemOptions const& options);
    ~Scheduler() = default;
    Scheduler(Scheduler const&) = delete;
    Scheduler& operator=(Scheduler const&) = delete;

    /// 0 also if the operating system refuses every thread.
    uint32_t workerCount() const { return mHasWorkers ? mSeats.workers() : 0; }
    uint64_t busyNanoseconds();
    ContentionCounts contention();

    /// An empty job, or null: there are no workers, or no free job.
    Job* allocate(Priority priority);
    /// Queues a filled job from allocate(), or runs it if there is no room.
    void submit(Job& job);
    /// The same for long work, whatever the priority of its group.
    Job* allocateBackground();
    void submitBackground(Job& job);
    /// Submits a filled job from allocate() as soon as `before` is done.
    void continueWith(Completion& before, Job& job);
    void wait(Completion& completion);

    /// On a background thread: runs and deletes a job from allocateBackground().
    void executeBackground(Job& job);
    Completion& backgroundCompletion() { return mBackgroundCompletion; }

    /// The calling thread, which is on `seat` or on none, has no job left that others could steal.
    bool isHungry(Seat* seat, Priority priority) const;

    /// Null if the calling thread already has a seat, no seat is free, or it would not need one.
    Seat* adoptThread();
    void releaseThread(Seat& seat);

    WorkerPlacement const& placement() const { return mPlacement; }
    JobTrace* trace() const { return mTrace.get(); }
    /// Writes to the trace, which must exist: the calling thread, which is on `seat` or on none, has run a job since
    /// `begin`.
    void record(Seat const* seat, const char* name, int64_t begin, bool stolen);

private:
    struct Found {
        Job* job = nullptr;
        Priority priority = Priority::Normal;
        bool stolen = false; ///< taken from another deque

        explicit operator bool() const { return job != nullptr; }
    };

    /// The state of a thread that looks for work.
    struct Hunt {
        int64_t now = 0; ///< the current time, or a little earlier; 0: unknown. Reading a clock takes as long as a fork
        bool watches = false; ///< pushes rely on this thread and wake nobody
        bool passesOn =
                false; ///< it stood in for pushes that woke nobody: if it leaves work behind, it must wake another
    };

    // Scheduler.cpp
    void startWorkers(std::string const& threadName);
    void runWorker(uint32_t index, std::string const& name);
    void sleepUntilWork(Hunt& hunt);
    void enqueue(Seat* seat, Job& job, Priority priority);
    void notifyWork(Priority priority) {
        mWaking.notify([&] { wakeSomebody(priority); });
    }
    void pushBackground(Job& job);
    void endThreads();
    void wakeSomebody(Priority priority);
    void wakeAWaiter(Priority priority);

    // Running.cpp
    class Report;
    Found stealAgain(Seat& seat, Hunt& hunt);
    void run(Seat* seat, Found const& found);
    void work(Seat& seat, Found found, Hunt& hunt);
    void execute(Seat* seat, Found const& found);
    void executeInline(Seat* seat, Job& job, Priority priority);
    bool call(Seat const* seat, Found const& found);
    bool callUntraced(Job& job, Priority priority);
    void finish(Seat const* seat, Completion& completion, bool stolen);
    void close(Completion& completion);

    // Search.cpp; `least` is the least urgent priority to search for
    Found takeOwn(Seat* seat, Priority least);
    Found searchOthers(Seat* thief, Priority least, Patience& patience);
    Found searchCritical(Seat* thief);
    Found popInjected(Priority priority);
    Found stealCritical(Seat* thief);
    Found stealNormal(Seat* thief, Patience& patience);
    template <class Visit>
    Job* visitOthers(Seat* thief, Visit&& visit);
    template <class Visit>
    Job* visitSome(Seat& thief, Visit&& visit);
    std::optional<Priority> visibleWork(Priority least);
    Found spin(Seat* seat, Priority least, Completion const* until, int64_t nanoseconds, Hunt& hunt);
    void watch(Hunt& hunt);
    void stopWatching(Hunt& hunt);
    void endHunt(Hunt& hunt);

    // Waiting.cpp
    void waitAt(Seat* seat, Completion& completion);
    void runStolen(Seat* seat, Found const& found, Hunt& hunt);
    void sleepInWait(Seat* seat, Priority least, Completion& completion, Hunt& hunt);

    SeatTable mSeats;
    const WorkerPlacement mPlacement;
    const std::unique_ptr<JobTrace> mTrace; // null: not requested
    JobStorage mStorage;
    InjectionQueue mInjected[2]; // by priority
    alignas(kCacheLineBytes) Waking mWaking;
    alignas(kCacheLineBytes) ParkingLot mUnseatedBell; // for threads that wait without a seat
    // Set by the push of a critical job, cleared by a search that finds none. Normal work pays one load for it.
    alignas(kCacheLineBytes) std::atomic<bool> mCriticalHint{ false };
    alignas(kCacheLineBytes) std::atomic<bool> mStopping{ false };
    Completion mBackgroundCompletion{ 0, Priority::Background };
    std::unique_ptr<BackgroundThreads> mBackground; // null without workers
    bool mHasWorkers = false;                       // constant after construction
    std::vector<std::thread> mThreads;
    // The last member: ends the running threads, even if the constructor could not start all of them.
    struct ThreadEnd {
        Scheduler& scheduler;
        ~ThreadEnd() { scheduler.endThreads(); }
    } mThreadEnd{ *this };
};

} // namespace filament_core::jobs
