// SPDX-License-Identifier: Apache-2.0
/// BackgroundThreads: where long work runs (files, decoding, shader compilers), so that no frame waits for it.
///   In      jobs made with new; they are deleted after they ran.
///   Thread  push(), wantsMore(): any. waitFor(): the threads of this object.
///           Threads start when a job finds none idle, up to a limit, and stay. Their niceness is kNiceness: where
///           cores are scarce, the operating system prefers frame work.
///   Order   first in, first out; but a background thread that waits for a group takes jobs of this group only, so a
///           wait never grows by a stranger's work.
///   Memory  a queue that grows with the jobs in it.
///   Fails   push() refuses the job if there is no memory for its place in the queue, or no thread at all for it;
///           further threads that the operating system refuses are done without.
///   Cost    a lock and at most one wake-up a job: 1 us and up. The work is meant to last a thousand times longer.
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

namespace filament::jobs {

class Scheduler;

class BackgroundThreads {
public:
    static constexpr int kNiceness = 10;

    BackgroundThreads(Scheduler& scheduler, uint32_t limit, std::string name);
    /// After stop(), and after every thread that runs jobs has ended: one of them may still be about to ring a bell.
    ~BackgroundThreads() = default;
    BackgroundThreads(BackgroundThreads const&) = delete;
    BackgroundThreads& operator=(BackgroundThreads const&) = delete;

    /// Runs what is queued and what that queues, then ends the threads. Once.
    void stop();

    /// False: the caller runs it.
    [[nodiscard]] bool push(Job& job);
    /// A thread would take another job at once.
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
    const std::unique_ptr<ParkingLot[]> mBells; // of each thread; rung when its group is done and at every push
    std::atomic<int32_t> mFree;                 // threads that are idle or could start, minus queued jobs

    std::mutex mMutex; // of what follows
    std::condition_variable mPushed;
    std::deque<Job*> mQueue;
    std::vector<std::thread> mThreads;
    uint32_t mIdle = 0;
    bool mStopping = false;
};

} // namespace filament::jobs
