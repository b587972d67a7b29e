// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/ModelSystem.h"

#include <algorithm>

namespace filament_core::jobs::model {
namespace {

constexpr uint32_t kVictims = 4;

} // namespace

ModelSystem::ModelSystem(SystemPlan const& plan)
        : mPlan(plan), mInUse(static_cast<uint32_t>(plan.workers)), mLastOccupant(static_cast<Occupant>(plan.workers)) {
    for (int i = 0; i < plan.workers + plan.guests; ++i) {
        Seat& seat = mSeats.emplace_back();
        seat.random = static_cast<uint32_t>(i);
        if (i < plan.workers) seat.occupant = static_cast<Occupant>(i) + 1;
    }
    for (int i = 0; i < plan.guests; ++i) {
        Guest& guest = mGuests.emplace_back();
        for (Task& task : guest.jobs) task.guest = i;
        for (Task& task : guest.criticalJobs) {
            task.guest = i;
            task.priority = Priority::FrameCritical;
        }
    }
}

void ModelSystem::run(int thread) {
    if (thread < mPlan.workers) {
        runWorker(mSeats[static_cast<size_t>(thread)]);
    } else {
        beGuest(mGuests[static_cast<size_t>(thread - mPlan.workers)]);
    }
}

void ModelSystem::atEnd() {
    for (Guest& guest : mGuests) {
        for (int i = 0; i < mPlan.jobs; ++i)
            require(guest.jobs[static_cast<size_t>(i)].runs.get() == mPlan.rounds, "every job runs once");
        for (int i = 0; i < mPlan.critical; ++i)
            require(guest.criticalJobs[static_cast<size_t>(i)].runs.get() == mPlan.rounds, "every job runs once");
    }
    CountingAtomics::counts.jobs += static_cast<uint64_t>(mPlan.guests * (mPlan.jobs + mPlan.critical) * mPlan.rounds);
}

// ---------------------------------------------------------------------------------------------- guests

void ModelSystem::beGuest(Guest& guest) {
    for (int round = 0; round < mPlan.rounds; ++round) {
        Seat* seat = sitDown();
        for (; !seat; seat = sitDown()) yield(); // one may be free again that was looked at before
        forkAndJoin(guest, *seat, round);
        getUp(*seat);
    }
    if (mGone.fetch_add(1) + 1 < mPlan.guests) return;
    mStopping.store(true, std::memory_order_seq_cst);
    mWaking.idle().wakeAll();
}

void ModelSystem::forkAndJoin(Guest& guest, Seat& seat, int round) {
    guest.normal.emplace(seat.occupant, Priority::Normal);
    for (int i = 0; i < mPlan.jobs; ++i) {
        guest.normal->add(seat.occupant);
        enqueue(seat, guest.jobs[static_cast<size_t>(i)]);
    }
    if (mPlan.defect == Defect::PushesBeforeItsSeatIsKnown)
        raiseInUse(static_cast<uint32_t>(mPlan.workers + mPlan.guests));
    if (mPlan.critical > 0) guest.critical.emplace(seat.occupant, Priority::FrameCritical);
    for (int i = 0; i < mPlan.critical; ++i) {
        guest.critical->add(seat.occupant);
        enqueue(seat, guest.criticalJobs[static_cast<size_t>(i)]);
    }
    if (mPlan.critical > 0) wait(seat, *guest.critical);
    const bool waitsAtOnce = guest.jobs[0].guest < mPlan.waiters || !mPlan.meet;
    while (!waitsAtOnce && mMet.load() < meeting()) pause();
    wait(seat, *guest.normal);
    for (int i = 0; i < mPlan.jobs; ++i)
        require(guest.jobs[static_cast<size_t>(i)].runs.get() == round + 1, "what a job wrote is visible after wait()");
    guest.normal.reset();
    guest.critical.reset();
}

ModelSystem::Seat* ModelSystem::sitDown() {
    for (size_t i = static_cast<size_t>(mPlan.workers); i < mSeats.size(); ++i) {
        Seat& seat = mSeats[i];
        if (seat.taken.load(std::memory_order_relaxed) || seat.taken.exchange(true, std::memory_order_acquire))
            continue;
        seat.occupant = mLastOccupant.fetch_add(1, std::memory_order_relaxed) + 1;
        seat.visits.set(seat.visits.get() + 1);
        if (mPlan.defect != Defect::PushesBeforeItsSeatIsKnown) raiseInUse(static_cast<uint32_t>(i) + 1);
        return &seat;
    }
    return nullptr;
}

void ModelSystem::raiseInUse(uint32_t count) {
    uint32_t inUse = mInUse.load(std::memory_order_relaxed);
    while (inUse < count && !mInUse.compare_exchange_weak(inUse, count, std::memory_order_seq_cst)) {
    }
}

void ModelSystem::getUp(Seat& seat) {
    seat.occupant = 0;
    seat.taken.store(false, std::memory_order_release);
}

// ---------------------------------------------------------------------------------------------- Scheduler.cpp

void ModelSystem::runWorker(Seat& seat) {
    Hunt hunt;
    for (;;) {
        if (Found found = spin(seat, Priority::Normal, nullptr, hunt)) {
            endHunt(hunt);
            while (found) {
                execute(seat, found, Priority::Normal);
                found = takeOwn(seat, Priority::Normal);
                if (!found) found = searchOthers(seat, Priority::Normal);
            }
        } else if (mStopping.load(std::memory_order_seq_cst)) {
            return;
        } else {
            sleepUntilWork(hunt);
        }
    }
}

void ModelSystem::sleepUntilWork(Hunt& hunt) {
    if (mPlan.defect != Defect::WatchesInItsSleep) stopWatching(hunt);
    bool sawWork = false;
    mWaking.sleepUnless([&] {
        if (mPlan.defect == Defect::SleepsWithoutASecondLook) return false;
        return sawWork = visibleWork(Priority::Normal) || mStopping.load(std::memory_order_seq_cst);
    });
    if (sawWork) yield();
    watch(hunt);
}

void ModelSystem::enqueue(Seat& seat, Task& task) {
    const bool isCritical = task.priority == Priority::FrameCritical;
    require(isCritical ? seat.critical.push(&task) : seat.normal.push(&task), "there is room");
    if (isCritical && !mCriticalHint.load(std::memory_order_seq_cst))
        mCriticalHint.store(true, std::memory_order_seq_cst);
    notifyWork(task.priority);
}

void ModelSystem::notifyWork(Priority priority) {
    mWaking.notify([&] { mWaking.wakeSomebody([&] { wakeAWaiter(priority); }); });
}

void ModelSystem::wakeAWaiter(Priority priority) {
    const auto level = static_cast<uint8_t>(priority);
    for (uint32_t i = 0, end = mInUse.load(std::memory_order_seq_cst); i < end; ++i) {
        Seat& seat = mSeats[i];
        if (!seat.bell.hasSleepers() || seat.waitsFor.load(std::memory_order_relaxed) < level) continue;
        seat.bell.wakeOne();
        return;
    }
}

// ---------------------------------------------------------------------------------------------- Running.cpp

ModelSystem::Group& ModelSystem::groupOf(Task const& task) {
    Guest& guest = mGuests[static_cast<size_t>(task.guest)];
    return task.priority == Priority::Normal ? *guest.normal : *guest.critical;
}

void ModelSystem::execute(Seat& seat, Found const& found, Priority least) {
    Task& task = *found.task;
    require(task.priority <= least, "a wait runs nothing less urgent than its group");
    Group& group = groupOf(task);
    task.runs.set(task.runs.get() + 1);
    if (task.priority == Priority::Normal && mPlan.meet) {
        mMet.fetch_add(1);
        while (mMet.load() < meeting()) pause();
    }
    finish(seat, group, found.stolen);
}

void ModelSystem::finish(Seat& seat, Group& group, bool stolen) {
    if (!stolen && group.finishLocal(seat.occupant)) return;
    if (!group.finishShared()) return;
    if (Lot* sleeper = group.close().sleeper) sleeper->wakeAll();
}

// ---------------------------------------------------------------------------------------------- Search.cpp

ModelSystem::Found ModelSystem::takeOwn(Seat& seat, Priority least) {
    if (Task* task = seat.critical.take()) return { task, false };
    if (least == Priority::FrameCritical && mPlan.defect != Defect::WaitsRunAnything) return {};
    if (mCriticalHint.load(std::memory_order_relaxed)) {
        if (const Found found = searchCritical(seat)) return found;
    }
    return { seat.normal.take(), false };
}

ModelSystem::Found ModelSystem::searchOthers(Seat& thief, Priority least) {
    if (mCriticalHint.load(std::memory_order_relaxed)) {
        if (const Found found = searchCritical(thief)) return found;
    }
    if (least == Priority::FrameCritical && mPlan.defect != Defect::WaitsRunAnything) return {};
    const auto visit = [&](Seat& victim) { return stealWhatStayed(thief, victim); };
    const bool areMany = mInUse.load(std::memory_order_seq_cst) > kVictims + 1;
    return { areMany ? visitSome(thief, visit) : visitOthers(thief, visit), true };
}

ModelSystem::Task* ModelSystem::stealWhatStayed(Seat& thief, Seat& victim) {
    const auto items = victim.normal.extent();
    if (items.isEmpty()) return nullptr;
    for (uint32_t i = 0; i < mSeats.size(); ++i) {
        if (&mSeats[i] == &victim) thief.favourite = i;
    }
    if (!thief.patience.isStillThere(&victim, items.oldest, items.end)) return nullptr;
    ++CountingAtomics::counts.stealTries;
    Task* task = victim.normal.steal();
    if (task) ++CountingAtomics::counts.steals;
    return task;
}

template <class Visit>
ModelSystem::Task* ModelSystem::visitSome(Seat& thief, Visit&& visit) {
    const uint32_t seats = mInUse.load(std::memory_order_seq_cst);
    const uint32_t favourite = thief.favourite;
    thief.random = thief.random * 1664525 + 1013904223; // Knuth and Lewis, in "Numerical Recipes" 1992, 7.1
    const uint32_t start = (thief.random >> 16) % seats;
    for (uint32_t i = 0; i <= kVictims; ++i) {
        const uint32_t at = i == 0 ? favourite : (start + i) % seats;
        Seat& victim = mSeats[at];
        if (&victim == &thief || (i > 0 && at == favourite)) continue;
        ++CountingAtomics::counts.looks;
        if (Task* task = visit(victim)) return task;
    }
    return nullptr;
}

ModelSystem::Found ModelSystem::searchCritical(Seat& thief) {
    if (mCriticalHint.load(std::memory_order_relaxed)) mCriticalHint.exchange(false, std::memory_order_seq_cst);
    const Found found{
        visitOthers(thief, [](Seat& victim) { return victim.critical.isEmpty() ? nullptr : victim.critical.steal(); }),
        true
    };
    if (found) mCriticalHint.store(true, std::memory_order_seq_cst);
    return found;
}

template <class Visit>
ModelSystem::Task* ModelSystem::visitOthers(Seat& thief, Visit&& visit) {
    const uint32_t seats = mInUse.load(std::memory_order_seq_cst);
    const auto start = static_cast<uint32_t>(thief.occupant % seats);
    for (uint32_t i = 0; i < seats; ++i) {
        Seat& victim = mSeats[(start + i) % seats];
        if (&victim == &thief) continue;
        ++CountingAtomics::counts.looks;
        if (Task* task = visit(victim)) return task;
    }
    return nullptr;
}

std::optional<Priority> ModelSystem::visibleWork(Priority least) {
    std::optional<Priority> seen;
    for (uint32_t i = 0, end = mInUse.load(std::memory_order_seq_cst); i < end; ++i) {
        if (!mSeats[i].critical.isEmpty()) return Priority::FrameCritical;
        if (!mSeats[i].normal.isEmpty()) seen = Priority::Normal;
    }
    return least == Priority::FrameCritical ? std::nullopt : seen;
}

ModelSystem::Found ModelSystem::spin(Seat& seat, Priority least, Group const* until, Hunt& hunt) {
    constexpr int64_t kLook = 2 * Patience::kDisappointment; // so that every look is due
    seat.patience.begin(hunt.now);
    for (int inVain = 0; inVain < 2; hunt.now += kLook) {
        if (const Found found = searchOthers(seat, least)) return found;
        const bool sawWork = seat.patience.looked(hunt.now);
        if (sawWork && least == Priority::Normal) watch(hunt);
        inVain = sawWork && hunt.watches ? 0 : inVain + 1;
        if (until && until->isDone()) return {};
    }
    return {};
}

void ModelSystem::stopWatching(Hunt& hunt) {
    if (hunt.watches) mWaking.stopWatching();
    hunt.watches = false;
}

void ModelSystem::watch(Hunt& hunt) {
    hunt.passesOn = true;
    if (!hunt.watches) hunt.watches = mWaking.watch();
}

void ModelSystem::endHunt(Hunt& hunt) {
    stopWatching(hunt);
    if (!hunt.passesOn) return;
    hunt.passesOn = false;
    if (mPlan.defect == Defect::KeepsItsWakeUp) return;
    if (const std::optional<Priority> left = visibleWork(Priority::Normal)) notifyWork(*left);
}

// ---------------------------------------------------------------------------------------------- Waiting.cpp

void ModelSystem::wait(Seat& seat, Group& group) {
    const Priority least = std::min(group.priority(), Priority::Normal);
    Hunt hunt;
    while (!group.isDone()) {
        if (const Found own = takeOwn(seat, least)) {
            execute(seat, own, least);
        } else if (const Found found = spin(seat, least, &group, hunt)) {
            endHunt(hunt);
            execute(seat, found, least);
        } else if (!group.isDone()) {
            sleepInWait(seat, least, group, hunt);
        }
    }
    endHunt(hunt);
    group.reclaim(seat.occupant);
}

void ModelSystem::sleepInWait(Seat& seat, Priority least, Group& group, Hunt& hunt) {
    stopWatching(hunt);
    const bool countsLate = mPlan.defect == Defect::CountsWaitersLate;
    seat.waitsFor.store(static_cast<uint8_t>(least), std::memory_order_relaxed);
    if (!countsLate) mWaking.beginSleepInWait();
    const auto ticket = seat.bell.prepare();
    const bool mustStay = !group.announceSleeper(seat.bell) || visibleWork(least);
    if (countsLate) mWaking.beginSleepInWait();
    if (mustStay) {
        seat.bell.cancel();
        yield();
    } else {
        seat.bell.park(ticket);
    }
    group.withdrawSleeper();
    mWaking.endSleepInWait();
    hunt.passesOn = true;
}

} // namespace filament_core::jobs::model
