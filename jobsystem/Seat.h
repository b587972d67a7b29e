// SPDX-License-Identifier: Apache-2.0
/// Seat: what a thread needs to fork and join independently: deques, free jobs, and a bell to be woken by.
/// SeatTable: all seats of a system; workers own one permanently, other threads occupy one for a while.
/// ThreadState: what the job system knows about the calling thread.
///   Thread  any thread may steal from a seat's deques, ring its bell and read `waitsFor`; the rest belongs to its
///           occupant. SeatTable: any.
///   Memory  11 KiB per seat, in cache lines of its own.
///   Limits  kGuestSeats threads besides the workers.
///   Fails   sitDown() returns null when every guest seat is taken.
#pragma once

#include "jobsystem/Completion.h"
#include "jobsystem/Contention.h"
#include "jobsystem/Job.h"
#include "jobsystem/JobStorage.h"
#include "jobsystem/ParkingLot.h"
#include "jobsystem/Patience.h"
#include "jobsystem/WorkStealingDeque.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace filament_core::jobs {

class BackgroundThreads;
class Scheduler;

struct alignas(kCacheLineBytes) Seat {
    static constexpr uint8_t kNotWaiting = 0xFF;

    WorkStealingDeque<Job, 256> critical;
    WorkStealingDeque<Job, 1024> normal;

    JobStorage::Cache cache;
    Scheduler* scheduler = nullptr;
    Seat* outer = nullptr; ///< the seat of the same thread in another system, further down its stack
    Occupant occupant = 0;
    Patience patience;
    uint32_t random = 0;    ///< state of the victim generator, not 0
    uint32_t favourite = 0; ///< the seat where the occupant saw work last
    std::atomic<uint64_t> busyNanoseconds{ 0 };

    alignas(kCacheLineBytes) ParkingLot bell;     ///< rung when the group waited for is done, or when there is work
    std::atomic<uint8_t> waitsFor{ kNotWaiting }; ///< priority of the group whose wait() may sleep
    std::atomic<bool> taken{ false };

    ContentionCells contention; ///< written by the occupant; survives it
};

// What one thread writes often and others read lies in lines of its own.
static_assert(alignof(WorkStealingDeque<Job, 256>) == kCacheLineBytes && alignof(ContentionCells) == kCacheLineBytes);
static_assert(alignof(Seat) == kCacheLineBytes && sizeof(Seat) % kCacheLineBytes == 0);

class SeatTable {
public:
    static constexpr uint32_t kGuestSeats = 16;

    SeatTable(Scheduler& scheduler, uint32_t workers);

    /// Workers' seats come first.
    Seat& operator[](uint32_t index) { return mSeats[index]; }
    uint32_t indexOf(Seat const& seat) const { return static_cast<uint32_t>(&seat - mSeats.get()); }
    /// Seats from here on have never been used: their deques are empty.
    uint32_t inUse() const { return mInUse.load(std::memory_order_seq_cst); }
    uint32_t workers() const { return mWorkers; }

    Seat* sitDown();
    void getUp(Seat& seat);

private:
    void raiseInUse(uint32_t count);

    const uint32_t mWorkers;
    std::unique_ptr<Seat[]> mSeats;
    std::atomic<uint32_t> mInUse;                                 // read by every search
    alignas(kCacheLineBytes) std::atomic<Occupant> mLastOccupant; // written by every thread that sits down
};

struct ThreadState {
    Seat* seat = nullptr;                    ///< of the innermost system on the thread's stack
    uintptr_t stackFloor = 0;                ///< see FreshStack.h
    Priority priority = Priority::Normal;    ///< of the running job
    BackgroundThreads* background = nullptr; ///< its owner, for background threads: they run no frame jobs
    ParkingLot* backgroundBell = nullptr;

    Seat* seatOf(Scheduler const& scheduler) const {
        Seat* found = seat;
        while (found && found->scheduler != &scheduler) found = found->outer;
        return found;
    }
};

inline constinit thread_local ThreadState tThread;

} // namespace filament_core::jobs
