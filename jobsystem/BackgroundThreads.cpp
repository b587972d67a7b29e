// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/BackgroundThreads.h"

#include "jobsystem/Affinity.h"
#include "jobsystem/Scheduler.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <system_error>

namespace filament_core::jobs {

BackgroundThreads::BackgroundThreads(Scheduler& scheduler, uint32_t limit, std::string name)
        : mScheduler(scheduler), mLimit(limit), mName(std::move(name)), mBells(std::make_unique<ParkingLot[]>(limit)),
          mFree(static_cast<int32_t>(limit)) {
    mThreads.reserve(limit);
}

void BackgroundThreads::stop() {
    {
        const std::lock_guard lock(mMutex);
        mStopping = true;
    }
    mPushed.notify_all();
    for (uint32_t i = 0; i < startedThreads(); ++i) mThreads[i].join(); // running jobs may still start more
}

uint32_t BackgroundThreads::startedThreads() {
    const std::lock_guard lock(mMutex);
    return static_cast<uint32_t>(mThreads.size());
}

bool BackgroundThreads::push(Job& job) {
    {
        const std::lock_guard lock(mMutex);
        try {
            mQueue.push_back(&job);
        } catch (std::bad_alloc const&) {
            return false;
        }
        const bool wantsThread = mIdle < mQueue.size() && mThreads.size() < mLimit;
        if (wantsThread && !startThread() && mThreads.empty()) {
            mQueue.pop_back();
            return false;
        }
        mFree.fetch_sub(1, std::memory_order_relaxed);
    }
    mPushed.notify_one();
    // Threads that wait for a group sleep at their bells, and take jobs of their group only: each looks whether this
    // job is one.
    for (uint32_t i = 0; i < mLimit; ++i) mBells[i].wakeAll();
    return true;
}

bool BackgroundThreads::startThread() {
    const auto index = static_cast<uint32_t>(mThreads.size());
    try {
        mThreads.emplace_back(&BackgroundThreads::runThread, this, std::ref(mBells[index]), index);
        return true;
    } catch (std::system_error const&) {
        return false;
    } catch (std::bad_alloc const&) {
        return false;
    }
}

std::string BackgroundThreads::nameOf(uint32_t index) const {
    try {
        return mName + ' ' + std::to_string(index);
    } catch (std::bad_alloc const&) {
        return {}; // a name for debuggers is not worth ending the process
    }
}

void BackgroundThreads::runThread(ParkingLot& bell, uint32_t index) {
    nameThisThread(nameOf(index));
    mScheduler.placement().placeBackgroundThread();
    // Linux has a niceness for each thread, which is addressed by its own number.
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
    tThread.background = this;
    tThread.backgroundBell = &bell;
    tThread.priority = Priority::Background;
    std::unique_lock lock(mMutex);
    for (;;) {
        while (!mQueue.empty()) {
            Job* job = mQueue.front();
            mQueue.pop_front();
            lock.unlock();
            run(*job);
            lock.lock();
        }
        if (mStopping) return;
        ++mIdle;
        mPushed.wait(lock, [this] { return mStopping || !mQueue.empty(); });
        --mIdle;
    }
}

void BackgroundThreads::run(Job& job) {
    mScheduler.executeBackground(job);
    mFree.fetch_add(1, std::memory_order_relaxed);
}

// ---------------------------------------------------------------------------------------------- waiting

void BackgroundThreads::waitFor(Completion& completion) {
    while (!completion.isDone()) {
        if (Job* job = popOf(completion)) {
            run(*job);
        } else {
            sleepUntilDoneOrPushed(completion);
        }
    }
}

Job* BackgroundThreads::popOf(Completion const& completion) {
    const std::lock_guard lock(mMutex);
    const auto found =
            std::find_if(mQueue.begin(), mQueue.end(), [&](Job const* job) { return job->completion == &completion; });
    if (found == mQueue.end()) return nullptr;
    Job* job = *found;
    mQueue.erase(found);
    return job;
}

void BackgroundThreads::sleepUntilDoneOrPushed(Completion& completion) {
    ParkingLot& bell = *tThread.backgroundBell;
    // The order that ParkingLot needs: announced at the bell and at the group, then looked once more, then asleep. A
    // push or the end of the group in between rings the bell.
    const ParkingLot::Ticket ticket = bell.prepare();
    const bool pending = completion.announceSleeper(bell);
    Job* job = pending ? popOf(completion) : nullptr;
    if (job || !pending) {
        bell.cancel();
    } else {
        bell.park(ticket);
    }
    completion.withdrawSleeper();
    if (job) run(*job);
}

} // namespace filament_core::jobs
