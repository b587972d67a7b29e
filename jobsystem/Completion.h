// SPDX-License-Identifier: Apache-2.0
/// Completion: counts the unfinished jobs of a group, and records who sleeps until none is left and what runs next.
///   Count   has two parts: a plain one that only the owner touches (the occupant of the seat that made the group), and
///           an atomic one for all other threads. Their sum is the number of jobs left; each part alone may be
///           negative. A group that never meets another thread costs no atomic read-modify-write.
///   Shared  before the owner sleeps, and when a continuation is attached, the plain part is added to the atomic one
///           and the owner loses its privilege, so that the last thread to finish can decide from the atomic part
///           alone.
///   Guard   while a thread must be notified of the end (a sleeper, a continuation), the count is one larger than the
///           number of jobs. The thread that leaves only this extra unit closes the group: it takes out the
///           continuation and the sleeper, then returns the unit. The memory therefore cannot go away while that thread
///           still uses it.
///   Thread  isDone(), announceSleeper(), withdrawSleeper(), setContinuation(), reclaim(): the thread that made the
///           group. add(), finish...(), close(): any.
///   Missing whether a job of the group ran out of memory; recorded before the job counts as finished.
///   Memory  48 bytes.   Fails: never.
#pragma once

#include "jobsystem/Job.h"
#include "jobsystem/ParkingLot.h"

#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

/// Identifies one stay of one thread on a seat; every stay has a different value. 0: nobody.
using Occupant = uint64_t;

template <class Policy>
class BasicCompletion {
    template <class T>
    using Atomic = typename Policy::template Atomic<T>;
    using Bell = BasicParkingLot<Policy>;

public:
    BasicCompletion(Occupant owner, Priority priority) : mOwner(owner), mPriority(priority) {}
    BasicCompletion(BasicCompletion const&) = delete;
    BasicCompletion& operator=(BasicCompletion const&) = delete;

    Priority priority() const { return mPriority; }
    bool isDone() const { return unitsOf(mShared.load(std::memory_order_acquire)) + mLocal == 0; }

    void add(Occupant here) {
        if (isOwner(here)) {
            ++mLocal;
        } else {
            mShared.fetch_add(kUnit, std::memory_order_relaxed);
        }
    }

    /// False if `here` is not the owner: call finishShared() then. The owner never closes, since nobody waits for it.
    bool finishLocal(Occupant here) {
        if (!isOwner(here)) return false;
        --mLocal;
        return true;
    }

    /// True if the caller must call close(). If false, the memory of this object may be gone when it returns.
    [[nodiscard]] bool finishShared(int64_t jobs = 1) {
        const int64_t left = mShared.fetch_sub(jobs * kUnit, std::memory_order_acq_rel) - jobs * kUnit;
        return unitsOf(left) == 1 && (left & kFlags) != 0;
    }

    struct Closing {
        Job* continuation = nullptr; ///< to submit
        Bell* sleeper = nullptr;     ///< to wake
    };
    /// Returns what the caller has to do. The memory of this object may be gone when this returns. Until then nobody
    /// else changes the count: no job is left, and the owner sees that the group is being closed.
    Closing close() {
        const int64_t flags = mShared.load(std::memory_order_relaxed) & kFlags;
        const Closing closing{ flags & kHasContinuation ? mContinuation.load(std::memory_order_relaxed) : nullptr,
                               flags & kHasSleeper ? mSleeper.load(std::memory_order_relaxed) : nullptr };
        mShared.store(0, std::memory_order_release); // flags and guard in one: the owner cannot test again in between
        return closing;
    }

    /// Lets the last job ring `bell`. False if there is nothing to wait for, or only for a moment.
    bool announceSleeper(Bell& bell) {
        if (!isPending(mShared.load(std::memory_order_acquire) + mLocal * kUnit)) return false;
        mSleeper.store(&bell, std::memory_order_relaxed);
        return raiseFlag(kHasSleeper);
    }

    /// Withdraws the request, unless a thread is already closing.
    void withdrawSleeper() {
        int64_t state = mShared.load(std::memory_order_relaxed);
        int64_t next = 0;
        do {
            if (!(state & kHasSleeper) || unitsOf(state) == 1) return;
            next = state & ~kHasSleeper;
            if (!(next & kFlags)) next -= kUnit;
        } while (!mShared.compare_exchange_weak(state, next, std::memory_order_relaxed));
    }

    /// False if nothing is left to wait for: `job` is due now. One continuation at a time.
    bool setContinuation(Job& job) {
        if (!isPending(mShared.load(std::memory_order_acquire) + mLocal * kUnit)) return false;
        mContinuation.store(&job, std::memory_order_relaxed);
        return raiseFlag(kHasContinuation);
    }
    bool hasContinuation() const { return (mShared.load(std::memory_order_relaxed) & kHasContinuation) != 0; }

    void markOutOfMemory() { mIsOutOfMemory.store(true, std::memory_order_relaxed); }
    bool isOutOfMemory() const { return mIsOutOfMemory.load(std::memory_order_relaxed); }
    /// Call after isDone(), once.
    bool takeOutOfMemory() {
        if (!isOutOfMemory()) return false;
        mIsOutOfMemory.store(false, std::memory_order_relaxed);
        return true;
    }

    /// Makes `owner` the owner again, after isDone().
    void reclaim(Occupant owner) { mOwner.store(owner, std::memory_order_relaxed); }

private:
    static constexpr int64_t kHasSleeper = 1, kHasContinuation = 2, kFlags = 3, kUnit = 4;
    static int64_t unitsOf(int64_t state) { return state >> 2; }

    bool isOwner(Occupant here) const { return here != 0 && here == mOwner.load(std::memory_order_relaxed); }

    // A single unit together with a flag is the guard of a closing thread.
    static bool isPending(int64_t state) {
        return unitsOf(state) != 0 && !(unitsOf(state) == 1 && (state & kFlags) != 0);
    }

    // Adds the plain part and ends the owner's privilege. The first flag adds the guard unit.
    bool raiseFlag(int64_t flag) {
        int64_t state = mShared.load(std::memory_order_acquire);
        int64_t next = 0;
        do {
            next = state + mLocal * kUnit;
            if (!isPending(next)) return false;
            next = (next & kFlags ? next : next + kUnit) | flag;
        } while (!mShared.compare_exchange_weak(state, next, std::memory_order_acq_rel, std::memory_order_acquire));
        mLocal = 0;
        mOwner.store(0, std::memory_order_relaxed);
        return true;
    }

    // In the group's cache line: in a line of its own, a theft would cost the owner less, but every fork more.
    Atomic<Occupant> mOwner;                              // written by the owner only
    typename Policy::template Plain<int64_t> mLocal{ 0 }; // jobs that the owner added minus those it finished
    Atomic<int64_t> mShared{ 0 };                         // units << 2 | flags
    Atomic<Bell*> mSleeper{ nullptr };
    Atomic<Job*> mContinuation{ nullptr };
    const Priority mPriority;
    Atomic<bool> mIsOutOfMemory{ false }; // ordered by the count
};

using Completion = BasicCompletion<StdAtomics>;

} // namespace filament_core::jobs
