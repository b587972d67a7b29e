// SPDX-License-Identifier: Apache-2.0
/// Waking: whether a push must wake a thread, and how threads without work fall asleep.
///   Idle    workers sleep in idle(). Threads inside wait() sleep at bells of their own; here they are only counted, so
///           that a push with nobody asleep pays two loads.
///   Watch   while one thread looks for work (it watches), pushes rely on it and wake nobody. It passes on: if it
///           leaves work behind, it wakes the next thread.
///   Order   a push is published by a seq_cst operation before notify() reads; threads announce themselves by one
///           before their last look. So one of the two sees the other: tests/jobsystem/WakingModelTest.cpp, with up to
///           sixteen workers.
///   Thread  any.  Fails: never.
#pragma once

#include "jobsystem/ParkingLot.h"

#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

template <class Policy>
class BasicWaking {
public:
    BasicParkingLot<Policy>& idle() { return mIdle; }

    /// After work was published: calls wake() if a thread sleeps.
    template <class Wake>
    void notify(Wake&& wake) {
        const bool anybody = mIdle.hasSleepers() || mSleepingWaiters.load(std::memory_order_seq_cst) != 0;
        if (anybody) [[unlikely]]
            wake();
    }

    /// The rest of a push that found a sleeper: a worker if one sleeps, otherwise wakeAWaiter(), unless a thread
    /// watches.
    template <class WakeAWaiter>
    void wakeSomebody(WakeAWaiter&& wakeAWaiter) {
        if (mWatched.load(std::memory_order_seq_cst)) return;
        if (mIdle.hasSleepers()) {
            mIdle.wakeOne();
        } else {
            wakeAWaiter();
        }
    }

    /// A worker without work sleeps until it is woken, unless `seesWork` after it was announced: a push from there on
    /// sees a sleeper.
    template <class SeesWork>
    void sleepUnless(SeesWork&& seesWork) {
        const auto ticket = mIdle.prepare();
        if (seesWork()) {
            mIdle.cancel();
        } else {
            mIdle.park(ticket);
        }
    }

    /// A thread inside wait() counts from before its last look for work until it is awake.
    void beginSleepInWait() { mSleepingWaiters.fetch_add(1, std::memory_order_seq_cst); }
    void endSleepInWait() { mSleepingWaiters.fetch_sub(1, std::memory_order_seq_cst); }

    /// Whether the calling thread watches from now on: one does at a time.
    bool watch() {
        return !mWatched.load(std::memory_order_relaxed) && !mWatched.exchange(true, std::memory_order_seq_cst);
    }
    /// Once no thread watches, a push wakes one. Earlier pushes are seen by later searches, because both the flag and
    /// the search are in the total order of seq_cst operations.
    void stopWatching() { mWatched.store(false, std::memory_order_seq_cst); }

private:
    template <class T>
    using Atomic = typename Policy::template Atomic<T>;

    BasicParkingLot<Policy> mIdle;
    Atomic<uint32_t> mSleepingWaiters{ 0 };
    Atomic<bool> mWatched{ false };
};

using Waking = BasicWaking<StdAtomics>;

} // namespace filament_core::jobs
