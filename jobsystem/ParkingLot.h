// SPDX-License-Identifier: Apache-2.0
/// ParkingLot: where threads without work sleep. An event count: announce, check once more, sleep.
///   Thread  any.
///   Use     Sleeper:  ticket = prepare();  found something? cancel() : park(ticket);   and check again in both cases
///           Waker:    publish the work (a seq_cst operation), then wakeOne() or wakeAll()
///   Order   prepare() counts the sleeper with a seq_cst operation before it checks; the waker reads the count with one
///           after it published. In their single total order one of the two sees the other, so no wake-up is lost.
///           tests/jobsystem/ParkingLotModelTest.cpp checks all interleavings.
///   Cost    wakeOne() is one load if nobody sleeps, and one load and one exchange if a wake-up is under way. A burst
///           of pushes therefore makes one system call; the woken thread, if it finds work, wakes the next one.
///   Fails   never.
#pragma once

#include "jobsystem/Atomics.h"

#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

template <class Policy>
class BasicParkingLot {
public:
    using Ticket = uint32_t;

    Ticket prepare() {
        mSleepers.fetch_add(1, std::memory_order_seq_cst);
        const Ticket ticket = mEpoch.load(std::memory_order_seq_cst);
        mWaking.store(false, std::memory_order_seq_cst);
        return ticket;
    }

    void cancel() { mSleepers.fetch_sub(1, std::memory_order_seq_cst); }

    /// Returns after any wake-up that follows prepare().
    void park(Ticket ticket) {
        while (mEpoch.load(std::memory_order_seq_cst) == ticket) Policy::wait(mEpoch, ticket);
        mSleepers.fetch_sub(1, std::memory_order_seq_cst);
        mWaking.store(false, std::memory_order_seq_cst);
    }

    bool hasSleepers() const { return mSleepers.load(std::memory_order_seq_cst) != 0; }

    /// Wakes a sleeper, unless a woken one has not looked for work yet.
    void wakeOne() {
        if (!hasSleepers() || mWaking.exchange(true, std::memory_order_seq_cst)) return;
        mEpoch.fetch_add(1, std::memory_order_seq_cst);
        Policy::notifyOne(mEpoch);
    }

    void wakeAll() {
        if (!hasSleepers()) return;
        mEpoch.fetch_add(1, std::memory_order_seq_cst);
        Policy::notifyAll(mEpoch);
    }

private:
    template <class T>
    using Atomic = typename Policy::template Atomic<T>;

    Atomic<uint32_t> mSleepers{ 0 }; // prepared or parked
    Atomic<uint32_t> mEpoch{ 0 };    // changes with every wake-up; parked threads wait on it
    // True from a wakeOne() until a sleeper responds by looking for work. A sleeper clears it after it read the epoch
    // and before it looks; the waker sets it before it changes the epoch. So if it is set after the last clear, that
    // sleeper's epoch is outdated and park() returns at once. It is never left set with all threads asleep.
    Atomic<bool> mWaking{ false };
};

using ParkingLot = BasicParkingLot<StdAtomics>;

} // namespace filament_core::jobs
