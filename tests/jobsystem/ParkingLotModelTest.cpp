// SPDX-License-Identifier: Apache-2.0
// Sleeping and waking under the model checker: threads that push and then look for sleepers, and threads that announce
// their sleep and then look for work. The worker's loop is that of Scheduler::runWorker().
#include "jobsystem/ParkingLot.h"
#include "jobsystem/WorkStealingDeque.h"
#include "tests/jobsystem/ModelAtomics.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <memory>
#include <string>

namespace filament_core::jobs::model::parking_lot {
namespace {

/// Counts the wake-up calls into the kernel, per run.
struct CountingAtomics : ModelAtomics {
    static inline int wakeUps = 0;

    static void notifyOne(Atomic<uint32_t>& word) {
        ++wakeUps;
        ModelAtomics::notifyOne(word);
    }
};

struct Job {
    Plain<int> runs;
};

/// The smallest queue: one bit per job. A push is one point in the total order of seq_cst operations, like the deque's;
/// with so few steps more threads can be explored.
class Bits {
public:
    bool push(Job* job, Job* first) {
        mJobs.fetch_or(1u << (job - first), std::memory_order_seq_cst);
        return true;
    }
    Job* steal(Job* first) {
        uint32_t jobs = mJobs.load(std::memory_order_seq_cst);
        while (jobs != 0) {
            const int lowest = std::countr_zero(jobs);
            if (mJobs.compare_exchange_strong(jobs, jobs & (jobs - 1), std::memory_order_seq_cst))
                return first + lowest;
        }
        return nullptr;
    }
    bool isEmpty() const { return mJobs.load() == 0; }

private:
    Atomic<uint32_t> mJobs{ 0 };
};

class Deque {
public:
    bool push(Job* job, Job*) { return mDeque.push(job); }
    Job* steal(Job*) { return mDeque.steal(); }
    bool isEmpty() const { return mDeque.isEmpty(); }

private:
    WorkStealingDeque<Job, 4, ModelAtomics> mDeque;
};

enum class Worker : uint8_t { AsBuilt, ParksWithoutASecondLook, KeepsItsWakeUp };

struct Plan {
    int producers, jobs, workers; // each producer pushes `jobs` jobs to a queue of its own
    Worker worker = Worker::AsBuilt;
    bool firstJobLasts = false; // until all others have run: they need another worker

    std::string name() const {
        return std::to_string(producers) + " producers of " + std::to_string(jobs) + " jobs, " +
               std::to_string(workers) + " workers" + (firstJobLasts ? ", the first job lasts" : "");
    }
};

/// Threads: the workers, then the producers. Workers never return; a run ends well if they sleep and all jobs are done.
template <class Queue>
struct PushThenNotify : Scenario {
    explicit PushThenNotify(Plan const& options) : plan(options) { CountingAtomics::wakeUps = 0; }

    int threads() const override { return plan.workers + plan.producers; }

    void run(int thread) override {
        if (thread >= plan.workers) {
            produce(thread - plan.workers);
        } else {
            work();
        }
    }

    void produce(int producer) {
        for (int i = 0; i < plan.jobs; ++i) {
            require(queues[producer].push(&jobs[producer][i], jobs[producer].data()), "there is room");
            lot.wakeOne();
        }
    }

    void work() {
        bool woken = false;
        for (;;) {
            if (Job* job = find()) {
                if (woken && plan.worker != Worker::KeepsItsWakeUp && isWorkVisible()) lot.wakeOne();
                woken = false;
                execute(*job);
            } else {
                sleep();
                woken = true;
            }
        }
    }

    void sleep() {
        const auto ticket = lot.prepare();
        if (plan.worker != Worker::ParksWithoutASecondLook && isWorkVisible()) {
            lot.cancel();
        } else {
            lot.park(ticket);
        }
    }

    Job* find() {
        for (int i = 0; i < plan.producers; ++i) {
            if (Job* job = queues[i].steal(jobs[i].data())) return job;
        }
        return nullptr;
    }

    bool isWorkVisible() const {
        for (int i = 0; i < plan.producers; ++i) {
            if (!queues[i].isEmpty()) return true;
        }
        return false;
    }

    void execute(Job& job) {
        job.runs.set(job.runs.get() + 1);
        const bool lasts = plan.firstJobLasts && &job == jobs[0].data();
        const uint32_t others = static_cast<uint32_t>(plan.producers * plan.jobs - 1);
        while (lasts && othersDone.load() != others) pause();
        if (!lasts && plan.firstJobLasts) othersDone.fetch_add(1);
    }

    bool mayRest() override { return !isWorkVisible(); }

    void atEnd() override {
        for (int i = 0; i < plan.producers; ++i) {
            for (int k = 0; k < plan.jobs; ++k) require(jobs[i][k].runs.get() == 1, "every job runs once");
        }
        require(CountingAtomics::wakeUps <= 2 * plan.jobs * plan.producers,
                "a job wakes one thread when it comes and one when it goes");
    }

    const Plan plan;
    BasicParkingLot<CountingAtomics> lot;
    std::array<Queue, 2> queues;
    Atomic<uint32_t> othersDone{ 0 };
    std::array<std::array<Job, 4>, 2> jobs;
};

template <class Queue>
Report check(Plan const& plan, Options const& options = {}) {
    return explore([&] { return std::make_unique<PushThenNotify<Queue>>(plan); }, options);
}

template <class Queue>
void expectCorrect(Plan const& plan, Options const& options = {}) {
    const Report report = check<Queue>(plan, boundedIfSanitized(options));
    printExplored(plan.name(), report);
    EXPECT_EQ(report.failure, "") << plan.name();
}

TEST(ParkingLotModel, NoWakeUpIsLostBetweenAProducerAndAWorker) {
    expectCorrect<Deque>({ .producers = 1, .jobs = 1, .workers = 1 });
    expectCorrect<Deque>({ .producers = 1, .jobs = 2, .workers = 1 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 1 });
}

TEST(ParkingLotModel, AFutexThatReturnsForNoReasonChangesNothing) {
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 1 }, { .spuriousReturns = 1 });
}

// With three and four threads, explores every run with at most two (three) switches forced by the model: most
// concurrency errors need no more (Musuvathi and Qadeer 2007, "Iterative context bounding").
TEST(ParkingLotModel, NoWakeUpIsLostAmongThreeAndFourThreads) {
    expectCorrect<Bits>({ .producers = 1, .jobs = 1, .workers = 2 }, { .preemptions = 2 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 2 }, { .preemptions = 2 });
    expectCorrect<Bits>({ .producers = 2, .jobs = 1, .workers = 1 }, { .preemptions = 3 });
    expectCorrect<Bits>({ .producers = 2, .jobs = 1, .workers = 2 }, { .preemptions = 1 });
}

// A burst makes one system call; the workers pass the wake-up on, so that all of its jobs get a worker.
TEST(ParkingLotModel, ABurstReachesAsManyWorkersAsItHasJobs) {
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 2, .firstJobLasts = true }, { .preemptions = 2 });
    expectCorrect<Bits>({ .producers = 2, .jobs = 1, .workers = 2, .firstJobLasts = true }, { .preemptions = 1 });
}

TEST(ParkingLotModel, NoWakeUpIsLostInLongerRuns) {
    if (stressFactor() == 0) GTEST_SKIP() << "minutes: set FILAMENT_STRESS=1";
    expectCorrect<Bits>({ .producers = 1, .jobs = 3, .workers = 1 });
    expectCorrect<Bits>({ .producers = 2, .jobs = 1, .workers = 1 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 1, .workers = 2 }, { .preemptions = 5 });
    expectCorrect<Deque>({ .producers = 1, .jobs = 1, .workers = 2 }, { .preemptions = 4 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 2 }, { .preemptions = 3 });
    expectCorrect<Bits>({ .producers = 2, .jobs = 1, .workers = 2 }, { .preemptions = 2 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 1, .workers = 3 }, { .preemptions = 2 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 2, .workers = 2, .firstJobLasts = true }, { .preemptions = 4 });
    expectCorrect<Bits>({ .producers = 1, .jobs = 3, .workers = 3, .firstJobLasts = true }, { .preemptions = 1 });
}

TEST(ParkingLotModel, ABurstThatNobodyHasAnsweredYetIsOneSystemCall) {
    struct Burst : Scenario {
        int threads() const override { return 1; }
        void run(int) override {
            CountingAtomics::wakeUps = 0;
            lot.prepare();
            lot.prepare(); // two sleepers on their way
            for (int i = 0; i < 5; ++i) lot.wakeOne();
            require(CountingAtomics::wakeUps == 1, "the first wake-up of the burst");
            lot.prepare(); // a third one, who will look for itself
            lot.wakeOne();
            require(CountingAtomics::wakeUps == 2, "the first wake-up after an answer");
        }
        BasicParkingLot<CountingAtomics> lot;
    };
    EXPECT_EQ(explore([] { return std::make_unique<Burst>(); }).failure, "");
}

// ---------------------------------------------------------------------------------------------- what if it were weaker

template <class Queue>
std::string findingOf(Mutation const& mutation) {
    for (Plan const& plan : { Plan{ 1, 1, 1 }, Plan{ 1, 2, 1 } }) {
        const Report report = check<Queue>(plan, { .mutate = mutation });
        if (!report.ok()) return report.failure.substr(0, report.failure.find('\n'));
    }
    return "";
}

constexpr const char* kLost = "every thread sleeps";

TEST(ParkingLotModel, AWorkerThatParksWithoutASecondLookSleepsBesideWork) {
    const Report report = check<Bits>({ 1, 1, 1, Worker::ParksWithoutASecondLook });
    EXPECT_EQ(report.failure.substr(0, report.failure.find('\n')), kLost);
}

TEST(ParkingLotModel, AWorkerThatKeepsItsWakeUpForItselfLeavesWorkBesideSleepers) {
    const Plan burst{ 1, 2, 2, Worker::KeepsItsWakeUp, true };
    const Report report = check<Bits>(burst, { .preemptions = 2 });
    EXPECT_EQ(report.failure.substr(0, report.failure.find('\n')), kLost);
}

// A push that only releases stays in the store buffer while its thread finds no sleepers.
TEST(ParkingLotModel, APushThatOnlyReleasesLosesAWakeUp) {
    EXPECT_EQ(findingOf<Deque>(Mutation::toReleaseStore("push")), kLost);
    EXPECT_EQ(findingOf<Deque>(Mutation::weaken("push", Kind::Exchange, std::memory_order_acq_rel)), kLost);
    EXPECT_EQ(findingOf<Bits>(Mutation::weaken("push", Kind::Or, std::memory_order_acq_rel)), kLost);
}

TEST(ParkingLotModel, TheSleepersCountMustBeInTheTotalOrder) {
    EXPECT_EQ(findingOf<Bits>(Mutation::weaken("prepare", Kind::Add, std::memory_order_acq_rel)), kLost);
    EXPECT_EQ(findingOf<Bits>(Mutation::weaken("hasSleepers", Kind::Load, std::memory_order_acquire)), kLost);
}

TEST(ParkingLotModel, TheLastLookForWorkMustBeInTheTotalOrder) {
    EXPECT_EQ(findingOf<Bits>(Mutation::weaken("isEmpty", Kind::Load, std::memory_order_acquire)), kLost);
    EXPECT_EQ(findingOf<Deque>(Mutation::weaken("extent", Kind::Load, std::memory_order_acquire)), kLost);
}

TEST(ParkingLotModel, AWakeUpMustChangeTheEpoch) {
    const auto stays = [](Operation& operation) {
        if (operation.isIn("wakeOne") && operation.kind == Kind::Add) operation.operand = 0;
    };
    EXPECT_EQ(findingOf<Bits>({ stays }), kLost);
}

TEST(ParkingLotModel, AnAnswerMustClearTheWakeUpThatIsUnderWay) {
    const auto staysSet = [](Operation& operation) {
        if ((operation.isIn("prepare") || operation.isIn("park")) && operation.kind == Kind::Store)
            operation.kind = Kind::Load;
    };
    EXPECT_EQ(findingOf<Bits>({ staysSet }), kLost);
}

} // namespace
} // namespace filament_core::jobs::model::parking_lot
