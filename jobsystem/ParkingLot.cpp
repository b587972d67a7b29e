// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/ParkingLot.h"

namespace filament::jobs {

ParkingLot::Ticket ParkingLot::prepare() {
    mSleepers.fetch_add(1, std::memory_order_seq_cst);
    const Ticket ticket = mEpoch.load(std::memory_order_seq_cst);
    mWaking.store(false, std::memory_order_seq_cst);
    return ticket;
}

void ParkingLot::cancel() { mSleepers.fetch_sub(1, std::memory_order_seq_cst); }

void ParkingLot::park(Ticket ticket) {
    mEpoch.wait(ticket, std::memory_order_seq_cst);
    mSleepers.fetch_sub(1, std::memory_order_seq_cst);
    mWaking.store(false, std::memory_order_seq_cst);
}

void ParkingLot::wakeOne() {
    if (!hasSleepers() || mWaking.exchange(true, std::memory_order_seq_cst)) return;
    mEpoch.fetch_add(1, std::memory_order_seq_cst);
    mEpoch.notify_one();
}

void ParkingLot::wakeAll() {
    if (!hasSleepers()) return;
    mEpoch.fetch_add(1, std::memory_order_seq_cst);
    mEpoch.notify_all();
}

} // namespace filament::jobs
