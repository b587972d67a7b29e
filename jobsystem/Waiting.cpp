// SPDX-License-Identifier: Apache-2.0
// wait(): for a thread that has nothing else to do until a group is done.
#include "jobsystem/FreshStack.h"
#include "jobsystem/Scheduler.h"

#include <algorithm>

namespace filament_core::jobs {
namespace {

// The last job usually ends soon, and a wake-up takes about this long. A waiter that spins for as long as a wake-up
// would cost never takes more than twice the optimal time.
constexpr int64_t kWaiterSpinNanoseconds = 50'000;

} // namespace

void Scheduler::wait(Completion& completion) {
    if (isStackLow()) {
        auto deeper = [&] { wait(completion); };
        return callOnFreshStack(deeper);
    }
    if (mBackground && tThread.background == mBackground.get()) {
        mBackground->waitFor(completion);
    } else {
        Seat* adopted = adoptThread();
        waitAt(tThread.seatOf(*this), completion);
        if (adopted) releaseThread(*adopted);
    }
    Seat const* seat = tThread.seatOf(*this);
    completion.reclaim(seat ? seat->occupant : 0);
}

void Scheduler::waitAt(Seat* seat, Completion& completion) {
    // No less urgent work than the group's: a frame must not wait until an image is decoded.
    const Priority least = std::min(completion.priority(), Priority::Normal);
    Hunt hunt;
    while (!completion.isDone()) {
        if (const Found own = takeOwn(seat, least)) {
            execute(seat, own);
            hunt.now = 0;
            continue;
        }
        if (hunt.now == 0) hunt.now = nanosecondsNow();
        if (const Found found = spin(seat, least, &completion, kWaiterSpinNanoseconds, hunt)) {
            endHunt(hunt);
            runStolen(seat, found, hunt);
        } else if (!completion.isDone()) {
            sleepInWait(seat, least, completion, hunt);
        }
    }
    endHunt(hunt);
}

void Scheduler::runStolen(Seat* seat, Found const& found, Hunt& hunt) {
    const int64_t begin = hunt.now;
    execute(seat, found);
    hunt.now = nanosecondsNow();
    if (seat) seat->patience.learn(hunt.now - begin);
}

void Scheduler::sleepInWait(Seat* seat, Priority least, Completion& completion, Hunt& hunt) {
    stopWatching(hunt);
    ParkingLot& bell = seat ? seat->bell : mUnseatedBell;
    if (seat) {
        seat->waitsFor.store(static_cast<uint8_t>(least), std::memory_order_relaxed);
        mWaking.beginSleepInWait(); // before the last look for work
    }
    const ParkingLot::Ticket ticket = bell.prepare();
    if (!completion.announceSleeper(bell) || visibleWork(least)) {
        bell.cancel();
    } else {
        bell.park(ticket);
    }
    completion.withdrawSleeper();
    if (seat) mWaking.endSleepInWait();
    hunt.now = 0;
    hunt.passesOn = true;
}

} // namespace filament_core::jobs
