// SPDX-License-Identifier: Apache-2.0
// Where the scheduler looks for work, in which order and how often.
#include "jobsystem/Scheduler.h"

namespace filament::jobs {
namespace {

// Marsaglia 2003, "Xorshift RNGs": period 2^32 - 1. Which victim is tried first only affects speed.
uint32_t nextRandom(uint32_t& state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

} // namespace

Scheduler::Found Scheduler::takeOwn(Seat* seat, Priority least) {
    if (!seat) return {};
    if (Job* job = seat->critical.take()) return { job, Priority::FrameCritical, false };
    if (least == Priority::FrameCritical) return {};
    if (mCriticalHint.load(std::memory_order_relaxed)) {
        if (const Found found = searchCritical(seat)) return found;
    }
    if (Job* job = seat->normal.take()) return { job, Priority::Normal, false };
    return {};
}

Scheduler::Found Scheduler::searchOthers(Seat* thief, Priority least) {
    if (mCriticalHint.load(std::memory_order_relaxed)) {
        if (const Found found = searchCritical(thief)) return found;
    }
    if (least == Priority::FrameCritical) return {};
    if (const Found found = popInjected(Priority::Normal)) return found;
    return steal(thief, Priority::Normal);
}

// Before a sleep nobody relies on hints.
Scheduler::Found Scheduler::searchOthersThoroughly(Seat* thief, Priority least) {
    if (const Found found = searchCritical(thief)) return found;
    return searchOthers(thief, least);
}

// The hint goes before the search: a push that the search misses sets it again.
Scheduler::Found Scheduler::searchCritical(Seat* thief) {
    if (mCriticalHint.load(std::memory_order_relaxed)) mCriticalHint.exchange(false, std::memory_order_seq_cst);
    Found found = popInjected(Priority::FrameCritical);
    if (!found) found = steal(thief, Priority::FrameCritical);
    if (found) mCriticalHint.store(true, std::memory_order_seq_cst); // where one was, more may be
    return found;
}

Scheduler::Found Scheduler::popInjected(Priority priority) {
    return { mInjected[static_cast<int>(priority)].pop(), priority, true };
}

Scheduler::Found Scheduler::steal(Seat* thief, Priority priority) {
    const uint32_t seats = mSeats.inUse();
    const uint32_t start = thief ? nextRandom(thief->random) % seats : 0;
    for (uint32_t i = 0; i < seats; ++i) {
        Seat& victim = mSeats[start + i < seats ? start + i : start + i - seats];
        if (&victim == thief) continue;
        Job* job = priority == Priority::FrameCritical ? victim.critical.steal() : victim.normal.steal();
        if (job) return { job, priority, true };
    }
    return {};
}

std::optional<Priority> Scheduler::visibleWork(Priority least) {
    std::optional<Priority> seen;
    if (!mInjected[0].isEmpty()) return Priority::FrameCritical;
    if (!mInjected[1].isEmpty()) seen = Priority::Normal;
    for (uint32_t i = 0, end = mSeats.inUse(); i < end; ++i) {
        if (!mSeats[i].critical.isEmpty()) return Priority::FrameCritical;
        if (!mSeats[i].normal.isEmpty()) seen = Priority::Normal;
    }
    return least == Priority::FrameCritical ? std::nullopt : seen;
}

// A wake-up stands for any number of pushes: whoever answers it and leaves work behind wakes the next one.
void Scheduler::passOnWakeUp() {
    if (const std::optional<Priority> left = visibleWork(Priority::Normal)) notifyWork(*left);
}

Scheduler::Found Scheduler::spin(Seat* seat, Priority least, Completion const* until, int64_t nanoseconds) {
    Patience local;
    Patience& patience = seat ? seat->patience : local;
    const int64_t begin = nanosecondsNow();
    patience.begin(begin);
    for (int64_t now = begin; now - begin < nanoseconds; now = nanosecondsNow()) {
        if (patience.isTimeToLook(now)) {
            if (const Found found = searchOthers(seat, least)) return found;
            patience.looked(now);
        }
        if (until && until->isDone()) return {};
        pauseCore();
    }
    return {};
}

} // namespace filament::jobs
