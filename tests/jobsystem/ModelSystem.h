// SPDX-License-Identifier: Apache-2.0
/// ModelSystem: the whole scheduler under the model checker: workers that search, steal, sleep and wake each other, and
/// guests that take a seat, fork, compute alone, wait and leave.
///   Parts   the deques, groups, bells, Patience and Waking of the job system, over ModelAtomics. What the scheduler
///           does with them is repeated here, function by function, under its names, with clocks that count looks: a
///           thread gives up after two looks in vain.
///   Jobs    of all guests together, those of normal priority wait for each other: each needs a thread of its own, so a
///           wake-up that is lost, or kept by a worker that leaves work behind, ends in threads that all sleep.
///   Limits  sixteen workers and four guests.
///   Thread  one, as the checker.
#pragma once

#include "jobsystem/Completion.h"
#include "jobsystem/Patience.h"
#include "jobsystem/Waking.h"
#include "jobsystem/WorkStealingDeque.h"
#include "tests/jobsystem/ModelAtomics.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace filament_core::jobs::model {

/// Defects of the scheduler that the checker must find.
enum class Defect : uint8_t {
    None,
    SleepsWithoutASecondLook,
    KeepsItsWakeUp,    ///< a woken thread that leaves work behind wakes nobody
    WatchesInItsSleep, ///< pushes rely on a thread that has gone to sleep
    CountsWaitersLate, ///< after their last look for work
    PushesBeforeItsSeatIsKnown,
    WaitsRunAnything, ///< a wait for critical jobs takes normal ones
};

struct SystemPlan {
    int workers = 1;
    int guests = 1;
    int jobs = 1;     ///< of normal priority, by guest, 4 at most
    int critical = 0; ///< by guest, 2 at most
    int rounds = 1;   ///< each guest gets up and takes a seat again
    bool meet = true; ///< normal jobs wait for each other: workers + waiters must be as many
    int waiters = 0;  ///< guests that wait at once; the others compute alone until the jobs have met
    Defect defect = Defect::None;
};

/// What threads did, of all runs together.
struct SystemCounts {
    uint64_t jobs = 0, looks = 0, stealTries = 0, steals = 0, lostRaces = 0, wakeUps = 0, sleeps = 0;
};

struct CountingAtomics : ModelAtomics {
    static inline SystemCounts counts;

    static void lostRace() { ++counts.lostRaces; }
    static void wait(Atomic<uint32_t>& word, uint32_t old) {
        ++counts.sleeps;
        ModelAtomics::wait(word, old);
    }
    static void notifyOne(Atomic<uint32_t>& word) {
        ++counts.wakeUps;
        ModelAtomics::notifyOne(word);
    }
    static void notifyAll(Atomic<uint32_t>& word) {
        ++counts.wakeUps;
        ModelAtomics::notifyAll(word);
    }
};

class ModelSystem : public Scenario {
public:
    explicit ModelSystem(SystemPlan const& plan);

    int threads() const override { return mPlan.workers + mPlan.guests; }
    void run(int thread) override;
    void atEnd() override;

private:
    using Group = BasicCompletion<CountingAtomics>;
    using Lot = BasicParkingLot<CountingAtomics>;

    struct Task {
        int guest = 0;
        Priority priority = Priority::Normal;
        Plain<int> runs;
    };
    struct Seat {
        WorkStealingDeque<Task, 2, CountingAtomics> critical;
        WorkStealingDeque<Task, 4, CountingAtomics> normal;
        Lot bell;
        Atomic<uint8_t> waitsFor{ 0xFF };
        Atomic<bool> taken{ false };
        Occupant occupant = 0;
        Plain<int> visits; // written by each occupant: seats pass from thread to thread
        Patience patience;
        uint32_t random = 0, favourite = 0;
    };
    struct Guest {
        std::optional<Group> normal, critical;
        std::array<Task, 4> jobs;
        std::array<Task, 2> criticalJobs;
    };
    struct Hunt {
        int64_t now = 1;
        bool watches = false, passesOn = false;
    };
    struct Found {
        Task* task = nullptr;
        bool stolen = false;
        explicit operator bool() const { return task != nullptr; }
    };

    // As in Scheduler.cpp and Seat.cpp
    void runWorker(Seat& seat);
    void sleepUntilWork(Hunt& hunt);
    void enqueue(Seat& seat, Task& task);
    void notifyWork(Priority priority);
    void wakeAWaiter(Priority priority);
    Seat* sitDown();
    void raiseInUse(uint32_t count);
    void getUp(Seat& seat);

    // As in Running.cpp
    void execute(Seat& seat, Found const& found, Priority least);
    void finish(Seat& seat, Group& group, bool stolen);

    // As in Search.cpp
    Found takeOwn(Seat& seat, Priority least);
    Found searchOthers(Seat& thief, Priority least);
    Found searchCritical(Seat& thief);
    template <class Visit>
    Task* visitOthers(Seat& thief, Visit&& visit);
    template <class Visit>
    Task* visitSome(Seat& thief, Visit&& visit);
    Task* stealWhatStayed(Seat& thief, Seat& victim);
    std::optional<Priority> visibleWork(Priority least);
    Found spin(Seat& seat, Priority least, Group const* until, Hunt& hunt);
    void watch(Hunt& hunt);
    void stopWatching(Hunt& hunt);
    void endHunt(Hunt& hunt);

    // As in Waiting.cpp
    void wait(Seat& seat, Group& group);
    void sleepInWait(Seat& seat, Priority least, Group& group, Hunt& hunt);

    void beGuest(Guest& guest);
    void forkAndJoin(Guest& guest, Seat& seat, int round);
    Group& groupOf(Task const& task);
    int meeting() const { return mPlan.guests * mPlan.jobs; }

    const SystemPlan mPlan;
    std::deque<Seat> mSeats; // of workers, then of guests
    std::deque<Guest> mGuests;
    BasicWaking<CountingAtomics> mWaking;
    Atomic<bool> mCriticalHint{ false };
    Atomic<bool> mStopping{ false };
    Atomic<uint32_t> mInUse;
    Atomic<Occupant> mLastOccupant;
    Atomic<int> mMet{ 0 };
    Atomic<int> mGone{ 0 };
};

} // namespace filament_core::jobs::model
