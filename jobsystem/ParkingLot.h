// SPDX-License-Identifier: Apache-2.0
/// ParkingLot: where threads without work sleep. An event count: announce, look once more, sleep.
///   Thread  any.
///   Use     Sleeper:  ticket = prepare();  found something? cancel() : park(ticket);   and look again in both cases
///           Waker:    publish the work (a seq_cst operation), then wakeOne() or wakeAll()
///   Order   prepare() counts the sleeper with a seq_cst operation before it looks; the waker looks at the count with
///           one after it published. In their single total order one of the two sees the other: no wake-up is lost.
///   Cost    wakeOne() with nobody asleep is one load; with a wake-up under way one load and one exchange. A burst of
///           pushes therefore makes one system call; the woken thread, if it finds work, wakes the next one.
///   Fails   never.
#pragma once

#include <atomic>
#include <cstdint>

namespace filament::jobs {

class ParkingLot {
public:
    using Ticket = uint32_t;

    Ticket prepare();
    void cancel();
    void park(Ticket ticket); ///< returns after any wake-up that came after prepare()

    bool hasSleepers() const { return mSleepers.load(std::memory_order_seq_cst) != 0; }

    /// Wakes a sleeper, unless one is on its way that has not looked for work yet.
    void wakeOne();
    void wakeAll();

private:
    std::atomic<uint32_t> mSleepers{ 0 }; // prepared or parked
    std::atomic<uint32_t> mEpoch{ 0 };    // changes with every wake-up; parked threads wait on it
    // True from a wakeOne() until a sleeper answers it by looking for work. A sleeper clears it after it read the
    // epoch and before it looks, the waker sets it before it changes the epoch: so if it is set after the last clear,
    // that sleeper's epoch is outdated and park() returns at once. It is never left set with everybody asleep.
    std::atomic<bool> mWaking{ false };
};

} // namespace filament::jobs
