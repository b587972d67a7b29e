// SPDX-License-Identifier: Apache-2.0
// Where the scheduler looks for work, in which order, and how often.
#include "jobsystem/Scheduler.h"

namespace filament_core::jobs {
namespace {

constexpr uint32_t kVictims = 4; // of a look, besides the favourite

// Marsaglia 2003, "Xorshift RNGs": period 2^32 - 1. The first victim affects only the speed.
uint32_t nextRandom(uint32_t& state) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

template <class Deque>
Job* steal(Deque& deque) {
    count(Contention::StealTry);
    Job* job = deque.steal();
    if (job) count(Contention::Steal);
    return job;
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
    Job* job = mInjected[static_cast<int>(priority)].pop();
    if (job) count(Contention::SharedQueue);
    return { job, priority, true };
}

/// Calls visit(seat) for all other seats in use, starting at a random one, until it returns a job.
template <class Visit>
Job* Scheduler::visitOthers(Seat* thief, Visit&& visit) {
    const uint32_t seats = mSeats.inUse();
    const uint32_t start = thief ? nextRandom(thief->random) % seats : 0;
    for (uint32_t i = 0; i < seats; ++i) {
        Seat& victim = mSeats[start + i < seats ? start + i : start + i - seats];
        if (&victim == thief) continue;
        if (Job* job = visit(victim)) {
            count(Contention::Look, i + 1);
            return job;
        }
    }
    count(Contention::Look, seats);
    return nullptr;
}

/// Calls visit(seat) for the thief's favourite and for kVictims random neighbours, until it returns a job.
template <class Visit>
Job* Scheduler::visitSome(Seat& thief, Visit&& visit) {
    const uint32_t seats = mSeats.inUse();
    const uint32_t favourite = thief.favourite, start = nextRandom(thief.random) % seats;
    for (uint32_t i = 0; i <= kVictims; ++i) {
        const uint32_t at = i == 0 ? favourite : (start + i) % seats;
        Seat& victim = mSeats[at];
        if (&victim == &thief || (i > 0 && at == favourite)) continue;
        if (Job* job = visit(victim)) {
            count(Contention::Look, i + 1);
            return job;
        }
    }
    count(Contention::Look, kVictims + 1);
    return nullptr;
}

Scheduler::Found Scheduler::stealCritical(Seat* thief) {
    const auto stealIfAny = [](Seat& victim) { return victim.critical.isEmpty() ? nullptr : steal(victim.critical); };
    return { visitOthers(thief, stealIfAny), Priority::FrameCritical, true };
}

// Where work was seen last, and a few more: a look at all seats would cost their owners more cache lines the more seats
// there are. What is missed is found by a later look, or by the last one before the thread sleeps, which sees all.
Scheduler::Found Scheduler::stealNormal(Seat* thief, Patience& patience) {
    const auto stealWhatStayed = [&](Seat& victim) -> Job* {
        const auto items = victim.normal.extent();
        if (items.isEmpty()) return nullptr;
        if (thief) thief->favourite = mSeats.indexOf(victim);
        return patience.isStillThere(&victim, items.oldest, items.end) ? steal(victim.normal) : nullptr;
    };
    Job* job = thief && mSeats.inUse() > kVictims + 1 ? visitSome(*thief, stealWhatStayed)
                                                      : visitOthers(thief, stealWhatStayed);
    return { job, Priority::Normal, true };
}

std::optional<Priority> Scheduler::visibleWork(Priority least) {
    count(Contention::Look, mSeats.inUse());
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
