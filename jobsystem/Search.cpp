// SPDX-License-Identifier: Apache-2.0
// Where the scheduler looks for work, in which order, and how often.
#include "jobsystem/Scheduler.h"

namespace filament_core::jobs {
namespace {

// Marsaglia 2003, "Xorshift RNGs": period 2^32 - 1. The first victim affects only the speed.
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

Scheduler::Found Scheduler::searchOthers(Seat* thief, Priority least, Patience& patience) {
    if (mCriticalHint.load(std::memory_order_relaxed)) {
        if (const Found found = searchCritical(thief)) return found;
    }
    if (least == Priority::FrameCritical) return {};
    if (const Found found = popInjected(Priority::Normal)) return found;
    return stealNormal(thief, patience);
}

// Clears the hint before searching: a push that the search misses sets it again.
Scheduler::Found Scheduler::searchCritical(Seat* thief) {
    if (mCriticalHint.load(std::memory_order_relaxed)) mCriticalHint.exchange(false, std::memory_order_seq_cst);
    Found found = popInjected(Priority::FrameCritical);
    if (!found) found = stealCritical(thief);
    if (found) mCriticalHint.store(true, std::memory_order_seq_cst); // there may be more
    return found;
}

Scheduler::Found Scheduler::popInjected(Priority priority) {
    return { mInjected[static_cast<int>(priority)].pop(), priority, true };
}

/// Calls visit(seat) for all other seats in use, starting at a random one, until it returns a job.
template <class Visit>
Job* Scheduler::visitOthers(Seat* thief, Visit&& visit) {
    const uint32_t seats = mSeats.inUse();
    const uint32_t start = thief ? nextRandom(thief->random) % seats : 0;
    for (uint32_t i = 0; i < seats; ++i) {
        Seat& victim = mSeats[start + i < seats ? start + i : start + i - seats];
        if (&victim == thief) continue;
        if (Job* job = visit(victim)) return job;
    }
    return nullptr;
}

Scheduler::Found Scheduler::stealCritical(Seat* thief) {
    return { visitOthers(thief, [](Seat& victim) { return victim.critical.steal(); }), Priority::FrameCritical, true };
}

Scheduler::Found Scheduler::stealNormal(Seat* thief, Patience& patience) {
    const auto stealWhatStayed = [&](Seat& victim) {
        const auto items = victim.normal.extent();
        const bool take = !items.isEmpty() && patience.isStillThere(&victim, items.oldest, items.end);
        return take ? victim.normal.steal() : nullptr;
    };
    return { visitOthers(thief, stealWhatStayed), Priority::Normal, true };
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

void Scheduler::stopWatching(Hunt& hunt) {
    if (hunt.watches) mWaking.stopWatching();
    hunt.watches = false;
}

void Scheduler::watch(Hunt& hunt) {
    hunt.passesOn = true;
    if (!hunt.watches) hunt.watches = mWaking.watch();
}

// One wake-up may stand for several pushes: a woken thread that leaves work behind wakes the next one.
void Scheduler::endHunt(Hunt& hunt) {
    stopWatching(hunt);
    if (!hunt.passesOn) return;
    hunt.passesOn = false;
    if (const std::optional<Priority> left = visibleWork(Priority::Normal)) notifyWork(*left);
}

// One thread stays awake as long as it sees work, even if the work is gone when it looks again: if it slept, the next
// push would have to pay for a wake-up.
Scheduler::Found Scheduler::spin(Seat* seat, Priority least, Completion const* until, int64_t nanoseconds, Hunt& hunt) {
    constexpr int64_t kOftenFor = 2'000, kRarely = 250; // reading a completion's line delays its threads
    Patience own;
    Patience& patience = seat ? seat->patience : own;
    const int64_t begin = hunt.now;
    int64_t lastSeen = begin, nextQuestion = begin;
    patience.begin(begin);
    for (; hunt.now - lastSeen < nanoseconds; hunt.now = nanosecondsNow()) {
        const int64_t now = hunt.now;
        if (patience.isTimeToLook(now)) {
            if (const Found found = searchOthers(seat, least, patience)) return found;
            const bool sawWork = patience.looked(now);
            if (sawWork && least == Priority::Normal) watch(hunt);
            if (sawWork && hunt.watches) lastSeen = now;
        }
        if (until && now >= nextQuestion) {
            if (until->isDone()) return {};
            nextQuestion = now - begin < kOftenFor ? now : now + kRarely;
        }
        pauseCore();
    }
    return {};
}

} // namespace filament_core::jobs
