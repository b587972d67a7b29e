// SPDX-License-Identifier: Apache-2.0
// The whole scheduler under the model checker (ModelSystem.h), with up to sixteen workers and four guests. So many
// threads have more runs than can be explored: random ones stand for them, and seeded defects show what they find.
#include "tests/jobsystem/ModelSystem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

namespace filament_core::jobs::model::waking {
namespace {

/// A tenth under sanitizers, which make a step ten times slower.
uint64_t schedules(uint64_t count) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    count = std::max<uint64_t>(count / 10, 1);
#endif
    return count * std::max<uint64_t>(stressFactor() * 20, 1);
}

Options randomRuns(uint64_t count) { return { .schedules = count, .maxSteps = 100'000 }; }

std::string firstLineOf(std::string const& text) { return text.substr(0, text.find('\n')); }

Report check(SystemPlan const& plan, Options const& options) {
    return explore([&] { return std::make_unique<ModelSystem>(plan); }, options);
}

void expectCorrect(SystemPlan const& plan, uint64_t count) {
    const Report report = check(plan, randomRuns(schedules(count)));
    printExplored(std::to_string(plan.workers) + " workers, " + std::to_string(plan.guests) + " guests of " +
                          std::to_string(plan.jobs) + " + " + std::to_string(plan.critical) + " jobs",
                  report);
    EXPECT_EQ(firstLineOf(report.failure), "")
            << report.failure.substr(report.failure.size() - std::min<size_t>(report.failure.size(), 2000));
}

TEST(WakingModel, EveryJobThatNeedsAThreadOfItsOwnGetsOneOfUpToSixteenWorkers) {
    expectCorrect({ .workers = 1, .guests = 1, .jobs = 1 }, 1000);
    expectCorrect({ .workers = 2, .guests = 1, .jobs = 2 }, 1000);
    expectCorrect({ .workers = 4, .guests = 2, .jobs = 2 }, 400);
    expectCorrect({ .workers = 8, .guests = 2, .jobs = 4 }, 100);
    expectCorrect({ .workers = 16, .guests = 4, .jobs = 4 }, 50);
}

TEST(WakingModel, JobsReachAThreadThatWaitsIfEveryWorkerIsBusy) {
    expectCorrect({ .workers = 1, .guests = 2, .jobs = 1, .waiters = 1 }, 1000);
    expectCorrect({ .workers = 2, .guests = 2, .jobs = 2, .waiters = 2 }, 400);
    expectCorrect({ .workers = 15, .guests = 4, .jobs = 4, .waiters = 1 }, 50);
}

TEST(WakingModel, CriticalJobsAndSeatsThatChangeHandsKeepTheirRules) {
    expectCorrect({ .workers = 2, .guests = 2, .jobs = 2, .critical = 2, .rounds = 2, .meet = false }, 400);
    expectCorrect({ .workers = 8, .guests = 4, .jobs = 4, .critical = 2, .rounds = 2, .meet = false }, 50);
    expectCorrect({ .workers = 16, .guests = 4, .jobs = 3, .critical = 2, .meet = true }, 50);
}

// ---------------------------------------------------------------------------------------------- seeded defects

struct Seeded {
    const char* name;
    SystemPlan plan;
    Mutation mutation{ [](Operation&) {} };
};

/// The first line of the failure, and prints after how many runs it was found.
std::string findingOf(Seeded const& seeded, uint64_t count) {
    Options options = randomRuns(count);
    options.mutate = seeded.mutation;
    const Report report = check(seeded.plan, options);
    const std::string finding = firstLineOf(report.failure);
    std::printf("[ SEEDED   ] %s, %d workers: %s by run %llu of %llu: %s\n", seeded.name, seeded.plan.workers,
                finding.empty() ? "not found" : "found", static_cast<unsigned long long>(report.runs),
                static_cast<unsigned long long>(count), finding.c_str());
    std::fflush(stdout);
    return finding;
}

constexpr const char* kLost = "every thread sleeps";

SystemPlan meeting(int workers, Defect defect = Defect::None) {
    const int guests = std::max(workers / 4, 1);
    return { .workers = workers, .guests = guests, .jobs = workers / guests, .defect = defect };
}

TEST(WakingModel, ALostWakeUpIsFoundAmongSixteenWorkers) {
    for (const int workers : { 2, 16 }) {
        EXPECT_EQ(findingOf({ "a sleep without a second look", meeting(workers, Defect::SleepsWithoutASecondLook) },
                            2000),
                  kLost);
        EXPECT_EQ(findingOf({ "a wake-up that is kept", meeting(workers, Defect::KeepsItsWakeUp) }, 2000), kLost);
        SystemPlan oneGuest{ .workers = workers, .guests = 1, .jobs = std::min(workers, 4) };
        oneGuest.defect = Defect::PushesBeforeItsSeatIsKnown;
        EXPECT_EQ(findingOf({ "a seat that is known too late", oneGuest }, 2000), kLost);
    }
    EXPECT_EQ(findingOf({ "a watcher that sleeps", meeting(2, Defect::WatchesInItsSleep) }, 2000), kLost);
    const SystemPlan busy{ .workers = 1, .guests = 2, .jobs = 1, .waiters = 1, .defect = Defect::CountsWaitersLate };
    EXPECT_EQ(findingOf({ "a waiter that is counted too late", busy }, 20'000), kLost);
}

const Seeded kMissingFences[] = {
    { "a push that only releases", {}, Mutation::toReleaseStore("push") },
    { "an announcement out of the total order", {}, Mutation::weaken("prepare", Kind::Add, std::memory_order_acq_rel) },
    { "a look out of the total order", {}, Mutation::weaken("extent", Kind::Load, std::memory_order_acquire) },
};

TEST(WakingModel, AMissingFenceIsFound) {
    for (Seeded seeded : kMissingFences) {
        seeded.plan = meeting(2);
        EXPECT_EQ(findingOf(seeded, 2000), kLost);
    }
}

TEST(WakingModel, AJobThatIsStolenTwiceOrByTheWrongThreadIsFoundAmongSixteenWorkers) {
    const SystemPlan many{ .workers = 16, .guests = 4, .jobs = 4, .critical = 2, .meet = false };
    SystemPlan wrong = many;
    wrong.defect = Defect::WaitsRunAnything;
    EXPECT_EQ(findingOf({ "a wait that runs any job", wrong }, 2000), "a wait runs nothing less urgent than its group");
    EXPECT_NE(findingOf({ "a theft without compare-and-swap", many,
                          Mutation::to(Kind::Assume, "steal", Kind::CompareExchange) },
                        2000),
              "");
    EXPECT_NE(findingOf({ "two threads on one seat", many, Mutation::to(Kind::Load, "sitDown", Kind::Exchange) }, 2000),
              "");
}

// ---------------------------------------------------------------------------------------------- contention

// On as many cores as threads: in walks, all threads advance about as fast. Sixteen workers may cost a job more than
// four do, but not four times as much.
TEST(WakingModel, WhatThreadsDoToEachOtherByJobGrowsLessThanTheWorkers) {
    const auto countsOf = [](int workers) {
        CountingAtomics::counts = {};
        const SystemPlan plan{ .workers = workers, .guests = 2, .jobs = 4, .rounds = 2, .meet = false };
        EXPECT_EQ(firstLineOf(check(plan, randomRuns(20)).failure), "");
        SystemCounts const& counts = CountingAtomics::counts;
        const auto byJob = [&](uint64_t n) { return static_cast<double>(n) / static_cast<double>(counts.jobs); };
        std::printf("[ COUNTED  ] %2d workers, by job: %.2f lost races, %.1f looks, %.2f steal tries, %.2f steals, "
                    "%.2f wake-ups, %.2f sleeps\n",
                    workers, byJob(counts.lostRaces), byJob(counts.looks), byJob(counts.stealTries),
                    byJob(counts.steals), byJob(counts.wakeUps), byJob(counts.sleeps));
        return counts;
    };
    for (const int workers : { 1, 2 }) countsOf(workers);
    const SystemCounts four = countsOf(4);
    countsOf(8);
    const SystemCounts sixteen = countsOf(16);
    EXPECT_LT(sixteen.looks, 4 * four.looks);
    EXPECT_LT(sixteen.wakeUps, 4 * four.wakeUps);
    EXPECT_LT(sixteen.lostRaces, 4 * four.lostRaces + four.jobs);
}

} // namespace
} // namespace filament_core::jobs::model::waking
