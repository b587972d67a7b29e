// SPDX-License-Identifier: Apache-2.0
/// Seat: what a thread needs to fork and join without asking anybody: deques, free jobs, a bell to be woken by.
/// SeatTable: all seats of a system; workers own one for life, other threads sit down for a while.
/// ThreadState: what the job system knows about the calling thread.
///   Thread  a seat's deques are stolen from by all; bell and `waitsFor` are rung and read by all; the rest belongs to
///           its occupant. SeatTable: any.
///   Memory  11 KiB a seat.
///   Limits  kGuestSeats threads besides the workers.
///   Fails   sitDown() returns null when every guest seat is taken.
#pragma once

#include "jobsystem/Completion.h"
#include "jobsystem/Job.h"
#include "jobsystem/JobStorage.h"
#include "jobsystem/ParkingLot.h"
#include "jobsystem/Patience.h"
#include "jobsystem/WorkStealingDeque.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace filament::jobs {

class BackgroundThreads;
class Scheduler;

struct alignas(kCacheLineBytes) Seat {
    static constexpr uint8_t kNotWaiting = 0xFF;

    WorkStealingDeque<Job, 256> critical;
    WorkStealingDeque<Job, 1024> normal;

    JobStorage::Cache cache;
    Scheduler* scheduler = nullptr;
    Seat* outer = nullptr; ///< the seat that the same thread has in another system, below on its stack
    Occupant occupant = 0;
    Patience patience;
    uint32_t random = 0; ///< state of the victim generator, not 0
    std::atomic<uint64_t> busyNanoseconds{ 0 };

    alignas(kCacheLineBytes) ParkingLot bell;     ///< rung when the group waited for is done, or when there is work
    std::atomic<uint8_t> waitsFor{ kNotWaiting }; ///< priority of the group whose wait() may sleep
    std::atomic<bool> taken{ false };
};

class SeatTable {
public:
    static constexpr uint32_t kGuestSeats = 16;

    SeatTable(Scheduler& scheduler, uint32_t workers);

    /// Workers' seats come first.
    Seat& operator[](uint32_t index) { return mSeats[index]; }
    uint32_t indexOf(Seat const& seat) const { return static_cast<uint32_t>(&seat - mSeats.get()); }
    /// Seats from here on have never been used: nothing is in their deques.
    uint32_t inUse() const { return mInUse.load(std::memory_order_seq_cst); }
    uint32_t workers() const { return mWorkers; }

    Seat* sitDown();
    void getUp(Seat& seat);

private:
    void raiseInUse(uint32_t count);

    const uint32_t mWorkers;
    std::unique_ptr<Seat[]> mSeats;
    std::atomic<uint32_t> mInUse;
    std::atomic<Occupant> mLastOccupant;
};

struct ThreadState {
    Seat* seat = nullptr;                    ///< of the innermost system on the thread's stack
    uintptr_t stackFloor = 0;                ///< see FreshStack.h
    Priority priority = Priority::Normal;    ///< of the running job
    BackgroundThreads* background = nullptr; ///< whose thread this is; such threads run no frame jobs of that system
    ParkingLot* backgroundBell = nullptr;

    Seat* seatOf(Scheduler const& scheduler) const {
        Seat* found = seat;
        while (found && found->scheduler != &scheduler) found = found->outer;
        return found;
    }
};

inline constinit thread_local ThreadState tThread;

} // namespace filament::jobs
