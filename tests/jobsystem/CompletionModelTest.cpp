// SPDX-License-Identifier: Apache-2.0
// The count of a group under the model checker: its owner forks, runs and waits; thieves steal, fork and finish.
// Waiting and closing work as in Scheduler::sleepInWait() and Scheduler::close(), over the smallest possible queue.
#include "jobsystem/Completion.h"
#include "tests/jobsystem/ModelAtomics.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <memory>
#include <optional>
#include <string>

namespace filament_core::jobs::model::completion {
namespace {

using Group = BasicCompletion<ModelAtomics>;
using Lot = BasicParkingLot<ModelAtomics>;

constexpr Occupant kOwner = 7, kThief = 8;

struct Plan {
    int jobs = 1; // of the group
    int thieves = 1;
    bool forks = false;        // the first job forks one more into the group
    bool continues = false;    // a continuation into a second group, which is what the owner waits for
    bool waitsForBoth = false; // with `continues`: the owner waits for the first group before
    int rounds = 1;            // the group is used again

    std::string name() const {
        return std::to_string(jobs) + " jobs" + (forks ? " that fork" : "") + (continues ? ", continued" : "") +
               (waitsForBoth ? ", both waited for" : "") + ", " + std::to_string(rounds) + " rounds, " +
               std::to_string(thieves) + " thieves";
    }
};

struct ForkAndJoin : Scenario {
    static constexpr int kForked = 6, kContinuation = 7; // job numbers

    explicit ForkAndJoin(Plan const& options) : plan(options) {}

    int threads() const override { return 1 + plan.thieves; }

    void run(int thread) override {
        if (thread == 0) {
            own();
        } else {
            while (runOne(kThief, true)) {
            }
        }
    }

    void own() {
        group.emplace(kOwner, Priority::Normal);
        next.emplace(kOwner, Priority::Normal);
        for (int round = 0; round < plan.rounds; ++round) {
            for (int i = 0; i < plan.jobs; ++i) {
                group->add(kOwner);
                push(i);
            }
            if (plan.continues) {
                next->add(kOwner);
                if (!group->setContinuation(continuation)) push(kContinuation);
            }
            if (!plan.continues || plan.waitsForBoth) wait(*group);
            if (plan.continues) wait(*next);
            require(runs[0].get() == round + 1, "what a job wrote is visible after wait()");
            for (int i = 0; i < plan.jobs; ++i) require(runs[i].get() == round + 1, "every job ran once");
            require(!plan.forks || runs[kForked].get() == round + 1, "a forked job ran once");
            require(!plan.continues || runs[kContinuation].get() == round + 1, "a continuation runs once");
        }
        wait(*group); // as destructors do
        group.reset();
        wait(*next);
        next.reset();
    }

    void wait(Group& completion) {
        while (!completion.isDone()) {
            if (runOne(kOwner, false)) continue;
            const auto ticket = bell.prepare();
            const bool pending = completion.announceSleeper(bell);
            if (pending && queue.load() == 0) {
                bell.park(ticket);
            } else {
                bell.cancel();
                if (!pending && !completion.isDone()) pause();
            }
            completion.withdrawSleeper();
        }
        completion.reclaim(kOwner);
    }

    void push(int job) {
        queue.fetch_or(1u << job);
        bell.wakeOne();
    }

    bool runOne(Occupant here, bool isThief) {
        uint32_t jobs = queue.load();
        while (jobs != 0) {
            if (!queue.compare_exchange_strong(jobs, jobs & (jobs - 1))) continue;
            execute(std::countr_zero(jobs), here, isThief);
            return true;
        }
        return false;
    }

    void execute(int job, Occupant here, bool isThief) {
        Group& completion = job == kContinuation ? *next : *group;
        if (job == kContinuation) {
            for (int i = 0; i < plan.jobs; ++i)
                require(runs[i].get() == runs[kContinuation].get() + 1, "a continuation runs after the group");
        }
        runs[job].set(runs[job].get() + 1);
        if (job == 0 && plan.forks) {
            completion.add(here);
            push(kForked);
        }
        if (!isThief && completion.finishLocal(here)) return;
        if (completion.finishShared()) close(completion);
    }

    void close(Group& completion) {
        const auto [job, sleeper] = completion.close();
        if (job) push(kContinuation);
        if (sleeper) sleeper->wakeAll();
    }

    const Plan plan;
    Lot bell;
    Atomic<uint32_t> queue{ 0 };
    std::optional<Group> group, next;
    Job continuation;
    std::array<Plain<int>, 8> runs;
};

Report check(Plan const& plan, Options const& options = {}) {
    return explore([&] { return std::make_unique<ForkAndJoin>(plan); }, options);
}

void expectCorrect(Plan const& plan, Options const& options = {}) {
    const Report report = check(plan, boundedIfSanitized(options));
    printExplored(plan.name(), report);
    EXPECT_EQ(report.failure, "") << plan.name();
}

TEST(CompletionModel, WaitEndsWhenEveryJobHasFinishedAndNotBefore) {
    expectCorrect({ .jobs = 1 });
    expectCorrect({ .jobs = 2 });
    expectCorrect({ .jobs = 1, .rounds = 2 });
    expectCorrect({ .jobs = 1, .thieves = 2 });
    expectCorrect({ .jobs = 2, .thieves = 2 }, { .preemptions = 3 });
}

TEST(CompletionModel, TheSumOfBothPartsIsNeverZeroWhileAThiefForks) {
    expectCorrect({ .jobs = 1, .forks = true }, { .preemptions = 3 });
    expectCorrect({ .jobs = 1, .thieves = 2, .forks = true }, { .preemptions = 2 });
}

TEST(CompletionModel, AContinuationRunsOnceAfterTheGroupAndBeforeTheNextOneIsDone) {
    expectCorrect({ .jobs = 1, .continues = true });
    expectCorrect({ .jobs = 1, .continues = true, .waitsForBoth = true }, { .preemptions = 3 });
    expectCorrect({ .jobs = 1, .thieves = 2, .continues = true }, { .preemptions = 2 });
    expectCorrect({ .jobs = 1, .continues = true, .waitsForBoth = true, .rounds = 2 }, { .preemptions = 2 });
}

TEST(CompletionModel, AllOfThisHoldsInLongerRuns) {
    if (stressFactor() == 0) GTEST_SKIP() << "minutes: set FILAMENT_STRESS=1";
    expectCorrect({ .jobs = 2, .thieves = 2 });
    expectCorrect({ .jobs = 1, .forks = true });
    expectCorrect({ .jobs = 1, .thieves = 2, .forks = true }, { .preemptions = 3 });
    expectCorrect({ .jobs = 1, .continues = true, .waitsForBoth = true });
    expectCorrect({ .jobs = 1, .thieves = 2, .continues = true }, { .preemptions = 3 });
    expectCorrect({ .jobs = 2, .thieves = 2, .continues = true, .waitsForBoth = true }, { .preemptions = 2 });
}

// ---------------------------------------------------------------------------------------------- what if it were weaker

std::string findingOf(Mutation const& mutation) {
    for (Plan const& plan : { Plan{ .jobs = 1 }, Plan{ .jobs = 2 }, Plan{ .jobs = 1, .continues = true } }) {
        const Report report = check(plan, { .mutate = mutation });
        if (!report.ok()) return report.failure.substr(0, report.failure.find('\n'));
    }
    return "";
}

constexpr const char* kRace = "a data race: a read that a write does not happen before";
constexpr const char* kLost = "every thread sleeps";

TEST(CompletionModel, FinishingMustReleaseWhatTheJobWrote) {
    EXPECT_EQ(findingOf(Mutation::weaken("finishShared", Kind::Add, std::memory_order_relaxed)), kRace);
    EXPECT_EQ(findingOf(Mutation::weaken("finishShared", Kind::Add, std::memory_order_acquire)), kRace);
}

TEST(CompletionModel, ClosingMustReleaseWhatTheJobsWrote) {
    EXPECT_EQ(findingOf(Mutation::weaken("close", Kind::Store, std::memory_order_relaxed)), kRace);
}

TEST(CompletionModel, TheOwnerMustAcquireWhatTheJobsWrote) {
    EXPECT_EQ(findingOf(Mutation::weaken("isDone", Kind::Load, std::memory_order_relaxed)), kRace);
}

TEST(CompletionModel, WhoClosesMustSeeWhomToWake) {
    EXPECT_EQ(findingOf(Mutation::weaken("raiseFlag", Kind::CompareExchange, std::memory_order_relaxed)), kLost);
    EXPECT_EQ(findingOf(Mutation::weaken("finishShared", Kind::Add, std::memory_order_release)), kLost);
}

TEST(CompletionModel, WithoutTheGuardUnitTheGroupEndsBeforeItsLastJob) {
    const auto noGuard = [](Operation& operation) {
        const bool first = operation.isIn("raiseFlag") && operation.kind == Kind::CompareExchange;
        if (first && (operation.expected & 3) == 0) operation.operand -= 4;
    };
    EXPECT_NE(findingOf({ noGuard }), "");
}

TEST(CompletionModel, AnOwnerThatSleepsWithoutFoldingItsPartIsNeverWoken) {
    const auto kept = [](Operation& operation) { // the guard unit and the flag, but nothing of the owner's jobs
        const bool raises = operation.isIn("raiseFlag") && operation.kind == Kind::CompareExchange;
        if (raises && operation.expected == 0) operation.operand = 4 | (operation.operand & 3);
    };
    EXPECT_NE(findingOf({ kept }), "");
}

} // namespace
} // namespace filament_core::jobs::model::completion
