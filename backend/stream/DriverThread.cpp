// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/DriverThread.h"

#include "backend/stream/StreamHash.h"
#include "base/Assert.h"
#include "base/Log.h"
#include "base/OutOfMemory.h"

#include <algorithm>
#include <chrono>
#include <system_error>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

namespace filament_core::backend {
namespace {

int64_t now() {
    const auto time = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
}

// False if the process may not run there.
bool pinThisThread(int core) {
#if defined(__linux__)
    cpu_set_t cores;
    CPU_ZERO(&cores);
    if (core < CPU_SETSIZE) CPU_SET(static_cast<size_t>(core), &cores);
    return pthread_setaffinity_np(pthread_self(), sizeof(cores), &cores) == 0;
#else
    static_cast<void>(core);
    return true;
#endif
}

void nameAndPlaceThisThread(int core) {
#if defined(__linux__)
    pthread_setname_np(pthread_self(), "driver");
#endif
    if (core >= 0 && !pinThisThread(core)) {
        log(Severity::Warning, "driver thread: core {} is not available to this process, running unpinned", core);
    }
}

// The frame number that the app assigned. It is at the start of the stream, so only the first chunk is searched.
uint64_t frameNumber(CommandBuffer const& commands, uint64_t otherwise) {
    if (!commands.contains<CmdBeginFrame>()) return otherwise;
    CommandChunk const& chunk = commands.view().front();
    for (size_t at = 0; at < chunk.size;) {
        auto const& header = *reinterpret_cast<CommandHeader const*>(chunk.data + at);
        if (header.id == kCommandId<CmdBeginFrame>) {
            return reinterpret_cast<CmdBeginFrame const*>(chunk.data + at + kCommandAlignment)->frame;
        }
        at += header.bytes;
    }
    return otherwise;
}

} // namespace

DriverThread::DriverThread(CommandStreamOptions const& options, ResultMailbox& mailbox)
        : mOptions(options), mMailbox(mailbox), mWatch(options.stallWarning),
          // One more than may be ahead: the one that is being recorded.
          mSlots(std::max(1u, options.maxFramesAhead) + 1) {}

DriverThread::~DriverThread() {
    if (mThread.joinable()) {
        std::unique_lock lock(mMutex);
        mStopping = true;
        mWork.notify_all();
        waitForProgress(lock, [&] { return mEnded; });
        lock.unlock();
        mThread.join();
    } else if (mDriver) {
        endDriver();
    }
}

Result<void> DriverThread::start(DriverFactory factory) {
    if (!mOptions.ownThread) return makeDriver(factory);
    Result<void> outcome;
    try {
        mThread = std::thread(
                [this, &outcome, factory = std::move(factory)]() mutable { run(std::move(factory), outcome); });
    } catch (std::system_error const& error) {
        return fail(ErrorCode::OutOfMemory,
                    "driver thread: the operating system refuses to start it ({}); end other threads", error.what());
    }
    std::unique_lock lock(mMutex);
    waitForProgress(lock, [&] { return mStarted; });
    return outcome;
}

Result<void> DriverThread::makeDriver(DriverFactory const& factory) {
    mWatch.beginMakingDriver();
    auto driver = orOutOfMemory("driver", {}, [&]() -> Result<std::unique_ptr<Driver>> {
        Result<std::unique_ptr<Driver>> made = factory(mMailbox);
        if (made) mInfo = (*made)->info();
        return made;
    });
    mWatch.end();
    if (!driver) return driver.error();
    mDriver = std::move(*driver);
    return {};
}

template <class F>
void DriverThread::guarded(const char* doing, F&& step) noexcept {
    try {
        step();
    } catch (std::bad_alloc const&) {
        mMailbox.onOutOfMemory(doing);
    } catch (std::length_error const&) { // larger than any possible allocation
        mMailbox.onOutOfMemory(doing);
    }
    mWatch.end();
}

void DriverThread::endDriver() {
    mWatch.beginEndingDriver();
    // Answers that are still to come arrive before the mailbox goes.
    if (!mMailbox.deviceLost()) guarded("ending the driver", [&] { mDriver->waitIdle(); });
    mDriver.reset();
    mWatch.end();
}

// Runs the driver thread from beginning to end.
void DriverThread::run(DriverFactory factory, Result<void>& outcome) {
    nameAndPlaceThisThread(mOptions.driverCore);
    outcome = makeDriver(factory);
    const bool usable = outcome.ok();
    factory = nullptr; // destroy its captures on this thread, before start() returns
    {
        const std::lock_guard lock(mMutex);
        mStarted = true; // `outcome` belongs to start() from here on
        mEnded = !usable;
    }
    mProgress.notify_all();
    if (!usable) return;
    serve();
    endDriver();
    const std::lock_guard lock(mMutex);
    mEnded = true;
    mProgress.notify_all();
}

void DriverThread::serve() {
    std::unique_lock lock(mMutex);
    while (true) {
        const auto hasWork = [&] { return mStopping || mReplayed < mSubmitted || mIdleReached < mIdleWanted; };
        if (!hasWork()) {
            mWork.wait(lock, hasWork);
            if (mOptions.repinAfterWaits && mOptions.driverCore >= 0) pinThisThread(mOptions.driverCore);
        }
        // Requests for an idle device go before new frames; otherwise a busy app could starve them.
        if (mIdleReached < mIdleWanted && mIdleWanted <= mReplayed) {
            const uint64_t reached = mReplayed;
            lock.unlock();
            settle(reached);
            lock.lock();
            mIdleReached = reached;
        } else if (mReplayed < mSubmitted) {
            const uint64_t next = mReplayed + 1;
            lock.unlock();
            replaySlot(next);
            lock.lock();
        } else {
            return; // stopping, and no work is left
        }
        mProgress.notify_all();
    }
}

void DriverThread::replaySlot(uint64_t submission) {
    Slot& slot = slotOf(submission);
    FrameTiming timing{ .frame = frameNumber(slot.commands, submission),
                        .submitted = slot.submitted,
                        .replayBegin = now(),
                        .backPressure = slot.backPressure,
                        .isFrame = slot.commands.contains<CmdBeginFrame>() };
    if (mOptions.hashStreams) guarded("hashing a stream", [&] { timing.hash = hashStream(slot.commands.view()); });
    const bool reachesDevice = !mMailbox.deviceLost();
    if (reachesDevice) execute(slot, timing.frame);
    // Before the slot counts as replayed: from then on acquire() may hand it out.
    slot.commands.reset();
    timing.replayEnd = now();
    // Before the count, so that a thread that waits for this submission finds its timing.
    mMailbox.onReplayed(timing);
    const std::lock_guard lock(mMutex);
    if (reachesDevice && timing.isFrame) mLatency.add(timing);
    mReplayed = submission;
}

void DriverThread::execute(Slot const& slot, uint64_t frame) {
    guarded("replaying commands", [&] {
        mWatch.beginReplay(slot.commands, frame);
        const WatchedReplay watched(mWatch.progress());
        mDriver->execute(slot.commands.view());
    });
}

void DriverThread::settle(uint64_t submission) {
    if (!mMailbox.deviceLost()) {
        mWatch.beginSettling();
        guarded("waiting for the device", [&] { mDriver->waitIdle(); });
    }
    // After the wait has delivered all answers: a ticket without one by now gets none, and its waiter is told so.
    mMailbox.onIdle(submission);
}

// Threads that wait for the driver thread also check that it makes progress.
template <class Predicate>
void DriverThread::waitForProgress(std::unique_lock<std::mutex>& lock, Predicate isReached) {
    if (!mWatch.warns()) return mProgress.wait(lock, isReached);
    while (!mProgress.wait_for(lock, mWatch.period(), isReached)) {
        lock.unlock(); // a log sink may call back into this class
        mWatch.check();
        lock.lock();
    }
}

CommandBuffer& DriverThread::acquire() {
    FILAMENT_ASSERT(mAcquired == nullptr, "submit() the buffer that acquire() gave before the next acquire()");
    std::unique_lock lock(mMutex);
    const auto mayRecord = [&] { return mSubmitted - mReplayed < mSlots.size() - 1; };
    int64_t waited = 0;
    if (!mayRecord()) {
        const int64_t begin = now();
        waitForProgress(lock, mayRecord);
        waited = now() - begin;
    }
    mBackPressure += static_cast<uint64_t>(waited);
    Slot& slot = slotOf(mSubmitted + 1);
    slot.backPressure = waited;
    mAcquired = &slot.commands;
    return slot.commands;
}

void DriverThread::submit(CommandBuffer& commands) {
    FILAMENT_ASSERT(&commands == mAcquired, "submit() takes the buffer that acquire() gave");
    mAcquired = nullptr;
    uint64_t submission = 0;
    {
        const std::lock_guard lock(mMutex);
        submission = mSubmitted + 1;
        slotOf(submission).submitted = now();
        mSubmitted = submission;
    }
    // The lock is free again: the driver thread, once woken, need not wait for it.
    if (mOptions.ownThread) {
        mWork.notify_one();
    } else {
        replaySlot(submission);
    }
}

uint64_t DriverThread::requestIdle() {
    uint64_t submission = 0;
    {
        const std::lock_guard lock(mMutex);
        submission = mSubmitted;
        mIdleWanted = std::max(mIdleWanted, submission);
    }
    if (mOptions.ownThread)
        mWork.notify_one();
    else
        settle(submission);
    return submission;
}

void DriverThread::waitIdle() {
    const uint64_t submission = requestIdle();
    if (!mOptions.ownThread) return;
    std::unique_lock lock(mMutex);
    waitForProgress(lock, [&] { return mIdleReached >= submission; });
}

void DriverThread::waitReplayed(uint64_t submission) {
    std::unique_lock lock(mMutex);
    if (mReplayed >= submission) return;
    const int64_t begin = now();
    waitForProgress(lock, [&] { return mReplayed >= submission; });
    mBackPressure += static_cast<uint64_t>(now() - begin);
}

uint64_t DriverThread::submissions() const {
    const std::lock_guard lock(mMutex);
    return mSubmitted;
}

uint64_t DriverThread::replayedSubmissions() const {
    const std::lock_guard lock(mMutex);
    return mReplayed;
}

uint64_t DriverThread::backPressureNanoseconds() const {
    const std::lock_guard lock(mMutex);
    return mBackPressure;
}

LatencyStatistics DriverThread::latency() const {
    LatencyLog copy;
    {
        const std::lock_guard lock(mMutex);
        copy = mLatency; // 8 KiB; sorting must not hold up the driver thread
    }
    return copy.summary();
}

} // namespace filament_core::backend
