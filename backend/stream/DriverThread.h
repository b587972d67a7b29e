// SPDX-License-Identifier: Apache-2.0
/// DriverThread: owns a driver and its thread; replays submitted buffers in order.
///   Thread  the driver is created, used and destroyed on its own thread (or, without one, on the caller's). start(),
///           acquire(), submit(): one app thread. waitIdle(), requestIdle(), statistics(), latency(): any, during its
///           lifetime.
///   Memory  maxFramesAhead + 1 command buffers, reused in turn. A steady frame allocates nothing.
///   Stuck   threads that wait here check the driver thread from time to time, and report the command in which it is
///           stuck.
///   Fails   start() with the factory's error, or OutOfMemory. After DeviceLost, buffers are accepted but no longer
///           replayed. If a driver throws std::bad_alloc, its state is incomplete, so the device is lost too.
///   Cost    a submit is one lock and one wake-up; threads block instead of spinning.
#pragma once

#include "backend/api/Driver.h"
#include "backend/stream/CommandStream.h"
#include "backend/stream/LatencyLog.h"
#include "backend/stream/ReplayWatch.h"
#include "backend/stream/ResultMailbox.h"

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace filament_core::backend {

class DriverThread {
public:
    explicit DriverThread(CommandStreamOptions const& options, ResultMailbox& mailbox);
    /// Replays everything submitted, waits for the device, destroys the driver, ends the thread.
    ~DriverThread();
    DriverThread(DriverThread const&) = delete;
    DriverThread& operator=(DriverThread const&) = delete;

    Result<void> start(DriverFactory factory);

    DeviceInfo const& info() const { return mInfo; }
    DriverStatistics statistics() const { return mDriver->statistics(); }
    uint64_t submissions() const;
    uint64_t replayedSubmissions() const;
    uint64_t backPressureNanoseconds() const;
    LatencyStatistics latency() const;
    ReplayWatch& watch() { return mWatch; }

    CommandBuffer& acquire();
    void submit(CommandBuffer& commands);
    /// Requests an idle device after everything submitted so far; ResultMailbox::onIdle() reports that number.
    uint64_t requestIdle();
    void waitIdle();
    void waitReplayed(uint64_t submission);

private:
    struct Slot {
        CommandBuffer commands;
        int64_t submitted = 0;
        int64_t backPressure = 0;
    };

    void run(DriverFactory factory, Result<void>& outcome);
    Result<void> makeDriver(DriverFactory const& factory);
    void serve();
    void replaySlot(uint64_t submission);
    void execute(Slot const& slot, uint64_t frame);
    void settle(uint64_t submission);
    void endDriver();
    template <class F>
    void guarded(const char* doing, F&& step) noexcept;
    template <class Predicate>
    void waitForProgress(std::unique_lock<std::mutex>& lock, Predicate isReached);
    Slot& slotOf(uint64_t submission) { return mSlots[submission % mSlots.size()]; }

    const CommandStreamOptions mOptions;
    ResultMailbox& mMailbox;
    ReplayWatch mWatch;
    std::unique_ptr<Driver> mDriver;
    DeviceInfo mInfo;
    std::vector<Slot> mSlots;
    CommandBuffer* mAcquired = nullptr; // app thread
    std::thread mThread;

    mutable std::mutex mMutex;
    std::condition_variable mWork;     // for the driver thread
    std::condition_variable mProgress; // for all other threads
    // Submissions are numbered from 1; the count of each stage is the number of the last one that passed it.
    uint64_t mSubmitted = 0;
    uint64_t mReplayed = 0;
    uint64_t mIdleWanted = 0; // highest submission after which an idle device was requested
    uint64_t mIdleReached = 0;
    uint64_t mBackPressure = 0;
    LatencyLog mLatency;
    bool mStarted = false;
    bool mStopping = false;
    bool mEnded = false;
};

} // namespace filament_core::backend
