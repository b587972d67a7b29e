// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Contention.h"

#include "jobsystem/Seat.h"

namespace filament_core::jobs {

const char* nameOf(Contention kind) {
    constexpr const char* kNames[] = { "lost races", "looks",  "steal tries",  "steals",
                                       "wake-ups",   "sleeps", "shared queue", "shared pool" };
    static_assert(std::size(kNames) == kContentionKinds);
    return kNames[static_cast<size_t>(kind)];
}

void count(Contention kind, uint64_t times) {
    if (tThread.seat) tThread.seat->contention.add(kind, times);
}

} // namespace filament_core::jobs
