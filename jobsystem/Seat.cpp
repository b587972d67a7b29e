// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Seat.h"

namespace filament_core::jobs {

SeatTable::SeatTable(Scheduler& scheduler, uint32_t workers)
        : mWorkers(workers), mSeats(std::make_unique<Seat[]>(workers + kGuestSeats)), mInUse(workers),
          mLastOccupant(workers) {
    for (uint32_t i = 0; i < workers + kGuestSeats; ++i) {
        Seat& seat = mSeats[i];
        seat.scheduler = &scheduler;
        seat.random = 0x9E3779B9u * (i + 1) | 1u;
        if (i >= workers) continue;
        seat.occupant = i + 1;
        seat.taken.store(true, std::memory_order_relaxed);
    }
}

Seat* SeatTable::sitDown() {
    for (uint32_t i = mWorkers; i < mWorkers + kGuestSeats; ++i) {
        Seat& seat = mSeats[i];
        if (seat.taken.load(std::memory_order_relaxed) || seat.taken.exchange(true, std::memory_order_acquire))
            continue;
        seat.occupant = mLastOccupant.fetch_add(1, std::memory_order_relaxed) + 1;
        raiseInUse(i + 1);
        return &seat;
    }
    return nullptr;
}

// Must precede the first push of a new occupant: a thread that is about to sleep and looks at the seats in use then
// either sees this one, or announced its sleep early enough for the push to see it.
void SeatTable::raiseInUse(uint32_t count) {
    uint32_t inUse = mInUse.load(std::memory_order_relaxed);
    while (inUse < count && !mInUse.compare_exchange_weak(inUse, count, std::memory_order_seq_cst)) {
    }
}

void SeatTable::getUp(Seat& seat) {
    seat.occupant = 0;
    seat.taken.store(false, std::memory_order_release);
}

} // namespace filament_core::jobs
