// SPDX-License-Identifier: Apache-2.0
#include "backend/stream/DriverThread.h"

#include "filament_core/base/Assert.h"
#include "filament_core/base/Log.h"

#include <algorithm>
#include <chrono>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

namespace filament::backend {
namespace {

int64_t now() {
    const auto time = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
}

void nameAndPlaceThisThread(int core) {
#if defined(__linux__)
    pthread_setname_np(pthread_self(), "driver");
    if (core < 0) return;
    cpu_set_t cores;
    CPU_ZERO(&cores);
    if (core < CPU_SETSIZE) CPU_SET(static_cast<size_t>(core), &cores);
    if (pthread_setaffinity_np(pthread_self(), sizeof(cores), &cores) != 0) {
        log(Severity::Warning, "driver thread: core {} is not available to this process, running unpinned", core);
    }
#else
    static_cast<void>(core);
#endif
}

// The number that the app gave to the frame; it opens the stream, so only the first chunk is searched.
uint64_t frameNumber(CommandView commands, uint64_t otherwise) {
    if (commands.empty()) return otherwise;
    CommandChunk const& chunk = commands.front();
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
        : mOptions(options), mMailbox(mailbox), mSlots(std::max(1u, options.maxFramesAhead) + 1) {}

DriverThread::~DriverThread() {
    if (mThread.joinable()) {
        {
            const std::lock_guard lock(mMutex);
            mStopping = true;
        }
        mWork.notify_all();
        mThread.join();
    } else if (mDriver && !mMailbox.deviceLost()) {
        mDriver->waitIdle();
    }
}

Result<void> DriverThread::start(DriverFactory factory) {
    if (!mOptions.ownThread) return makeDriver(factory);
    Result<void> outcome;
    mThread =
            std::thread([this, &outcome, factory = std::move(factory)]() mutable { run(std::move(factory), outcome); });
    std::unique_lock lock(mMutex);
    mProgress.wait(lock, [&] { return mStarted; });
    return outcome;
}

Result<void> DriverThread::makeDriver(DriverFactory const& factory) {
    Result<std::unique_ptr<Driver>> driver = factory(mMailbox);
    if (!driver) return driver.error();
    mDriver = std::move(*driver);
    mInfo = mDriver->info();
    return {};
}

// The driver thread from the first to the last instruction.
void DriverThread::run(DriverFactory factory, Result<void>& outcome) {
    nameAndPlaceThisThread(mOptions.driverCore);
    outcome = makeDriver(factory);
    const bool usable = outcome.ok();
    factory = nullptr; // what it captured dies on this thread, before start() returns
    {
        const std::lock_guard lock(mMutex);
        mStarted = true; // `outcome` belongs to start() from here on
    }
    mProgress.notify_all();
    if (!usable) return;
    serve();
    if (!mMailbox.deviceLost()) mDriver->waitIdle();
    mDriver.reset();
}

void DriverThread::serve() {
    std::unique_lock lock(mMutex);
    while (true) {
        mWork.wait(lock, [&] { return mStopping || mReplayed < mSubmitted || mIdleReached < mIdleWanted; });
        // Whoever waits for an idle device goes before new frames, or a busy app could starve them.
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
            mReplayed = next;
        } else {
            return; // stopping, and nothing is left to do
        }
        mProgress.notify_all();
    }
}

void DriverThread::replaySlot(uint64_t submission) {
    Slot& slot = slotOf(submission);
    FrameTiming timing{ .submitted = slot.submitted, .replayBegin = now() };
    timing.frame = frameNumber(slot.commands.view(), submission);
    if (!mMailbox.deviceLost()) mDriver->execute(slot.commands.view());
    slot.commands.reset();
    timing.replayEnd = now();
    mMailbox.onReplayed(timing);
}

void DriverThread::settle(uint64_t submission) {
    if (!mMailbox.deviceLost()) mDriver->waitIdle();
    mMailbox.onIdle(submission);
}

CommandBuffer& DriverThread::acquire() {
    FILAMENT_ASSERT(mAcquired == nullptr, "submit() the buffer that acquire() gave before the next acquire()");
    std::unique_lock lock(mMutex);
    const auto mayRecord = [&] { return mSubmitted - mReplayed < mSlots.size() - 1; };
    if (!mayRecord()) {
        const int64_t begin = now();
        mProgress.wait(lock, mayRecord);
        mBackPressure += static_cast<uint64_t>(now() - begin);
    }
    mAcquired = &slotOf(mSubmitted + 1).commands;
    return *mAcquired;
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
    if (mOptions.ownThread) {
        mWork.notify_one();
    } else {
        replaySlot(submission);
        const std::lock_guard lock(mMutex);
        mReplayed = submission;
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
    mProgress.wait(lock, [&] { return mIdleReached >= submission; });
}

uint64_t DriverThread::backPressureNanoseconds() const {
    const std::lock_guard lock(mMutex);
    return mBackPressure;
}

} // namespace filament::backend
