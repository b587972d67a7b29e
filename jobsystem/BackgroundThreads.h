// SPDX-License-Identifier: Apache-2.0
/// BackgroundThreads: run long work (files, decoding, shader compilers), so that no frame waits for it.
///   In      jobs created with new; they are deleted after they ran.
///   Thread  push(), wantsMore(): any. waitFor(): the threads of this object. A thread starts when a job finds none
///           idle, up to a limit, and stays. Threads have the niceness kNiceness: if cores are scarce, the operating
///           system prefers frame work.
///   Order   first in, first out. A background thread that waits for a group only takes jobs of that group, so a wait
///           never grows by unrelated work.
///   Memory  a queue that grows with the number of queued jobs.
///   Fails   push() refuses a job if there is no memory for its queue entry, or no thread at all to run it. It does
///           without further threads that the operating system refuses.
///   Cost    a lock and at most one wake-up per job: 1 us or more. The work should last a thousand times longer.
#pragma once

#include "jobsystem/Job.h"
#include "jobsystem/ParkingLot.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::jobs {

class Scheduler;

class BackgroundThreads {
public:
    static constexpr int kNiceness = 10;

    BackgroundThreads(Scheduler& scheduler, uint32_t limit, std::string name);
    /// Call after stop(), and after every thread that runs jobs has ended: one of them could still ring a bell.
    ~BackgroundThreads() = default;
    BackgroundThreads(BackgroundThreads const&) = delete;
    BackgroundThreads& operator=(BackgroundThreads const&) = delete;

    /// Runs the queued jobs and all jobs that they queue, then ends the threads. Call once.
    void stop();

    /// False: the caller must run it.
    [[nodiscard]] bool push(Job& job);
    /// A thread would start another job at once.
    bool wantsMore() const { return mFree.load(std::memory_order_relaxed) > 0; }
    /// Runs jobs of this group until it is done.
    void waitFor(Completion& completion);

private:
    bool startThread();
    uint32_t startedThreads();
    std::string nameOf(uint32_t index) const;
    void runThread(ParkingLot& bell, uint32_t index);
    void run(Job& job);
    Job* popOf(Completion const& completion);
    void sleepUntilDoneOrPushed(Completion& completion);

    Scheduler& mScheduler;
    const uint32_t mLimit;
    const std::string mName;
    const std::unique_ptr<ParkingLot[]> mBells; // one per thread; rung when its group is done and at every push
    std::atomic<int32_t> mFree;                 // threads that are idle or could start, minus queued jobs

    std::mutex mMutex; // protects the members below
    std::condition_variable mPushed;
    std::deque<Job*> mQueue;
    std::vector<std::thread> mThreads;
    uint32_t mIdle = 0;
    bool mStopping = false;
};

} // namespace filament_core::jobs
