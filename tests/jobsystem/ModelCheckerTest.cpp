// SPDX-License-Identifier: Apache-2.0
// The checker's own promises: it explores everything, it knows the memory model, it finds errors.
#include "tests/jobsystem/ModelAtomics.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace filament_core::jobs::model {
namespace {

constexpr auto relaxed = std::memory_order_relaxed;
constexpr auto acquire = std::memory_order_acquire;
constexpr auto release = std::memory_order_release;
constexpr auto acq_rel = std::memory_order_acq_rel;
constexpr auto seq_cst = std::memory_order_seq_cst;

/// Two variables, four results, and one function per thread: enough for the classic litmus tests.
struct Litmus : Scenario {
    struct Vars {
        Atomic<int> x{ 0 }, y{ 0 };
        int r[4] = {};
    };
    using Body = std::function<void(Vars&)>;

    Litmus(std::vector<Body> const& program, std::set<std::string>& seen) : bodies(program), results(seen) {}

    int threads() const override { return static_cast<int>(bodies.size()); }
    void run(int thread) override { bodies[static_cast<size_t>(thread)](vars); }
    void atEnd() override {
        std::string text;
        for (const int value : vars.r) text += std::to_string(value);
        results.insert(text + " x" + std::to_string(vars.x.load()) + " y" + std::to_string(vars.y.load()));
    }

    std::vector<Body> const& bodies;
    std::set<std::string>& results;
    Vars vars;
};

/// The possible outcomes of a program: "<r0..r3> x<last> y<last>".
std::set<std::string> endsOf(std::vector<Litmus::Body> const& program, Options const& options = {},
                             Report* report = nullptr) {
    std::set<std::string> results;
    const Report found = explore([&] { return std::make_unique<Litmus>(program, results); }, options);
    EXPECT_EQ(found.failure, "");
    if (report) *report = found;
    return results;
}

bool contains(std::set<std::string> const& ends, std::string const& prefix) {
    const auto at = ends.lower_bound(prefix);
    return at != ends.end() && at->starts_with(prefix);
}

using Vars = Litmus::Vars;

// ---------------------------------------------------------------------------------------------- completeness

TEST(ModelChecker, GoesThroughEveryOrderOfDependentSteps) {
    // n steps of one thread and m of another on the same object: (n + m)! / (n! m!) orders.
    const auto adds = [](int count) {
        return [count](Vars& v) {
            for (int i = 0; i < count; ++i) v.x.fetch_add(1);
        };
    };
    Report report;
    endsOf({ adds(3), adds(3) }, {}, &report);
    EXPECT_EQ(report.runs, 20u);
    endsOf({ adds(5), adds(4) }, {}, &report);
    EXPECT_EQ(report.runs, 126u);
    endsOf({ adds(2), adds(2), adds(2) }, {}, &report);
    EXPECT_EQ(report.runs, 90u);
    EXPECT_EQ(report.steps, 90u * 6);
}

TEST(ModelChecker, TriesIndependentStepsInOneOrderOnly) {
    Report report;
    endsOf({ [](Vars& v) { v.x.fetch_add(1), v.x.fetch_add(1); }, [](Vars& v) { v.y.fetch_add(1), v.y.fetch_add(1); } },
           {}, &report);
    EXPECT_EQ(report.runs, 1u);
}

TEST(ModelChecker, APreemptionBoundKeepsToItsNumberOfSwitches) {
    const auto twice = [](Vars& v) { v.x.fetch_add(1), v.x.fetch_add(1); };
    const std::vector<Litmus::Body> program = { twice, twice };
    Report report;
    endsOf(program, { .preemptions = 0 }, &report);
    EXPECT_EQ(report.runs, 2u); // aabb bbaa
    endsOf(program, { .preemptions = 1 }, &report);
    EXPECT_EQ(report.runs, 4u); // and abba baab
    endsOf(program, { .preemptions = 2 }, &report);
    EXPECT_EQ(report.runs, 6u); // and abab baba
}

// ---------------------------------------------------------------------------------------------- the memory model

TEST(ModelMemory, StoreBufferingNeedsSequentialConsistencyToGoAway) {
    const auto program = [](std::memory_order store, std::memory_order load) -> std::vector<Litmus::Body> {
        return { [=](Vars& v) { v.x.store(1, store), v.r[0] = v.y.load(load); },
                 [=](Vars& v) { v.y.store(1, store), v.r[1] = v.x.load(load); } };
    };
    EXPECT_TRUE(contains(endsOf(program(release, acquire)), "00"));
    EXPECT_TRUE(contains(endsOf(program(release, seq_cst)), "00"));
    EXPECT_FALSE(contains(endsOf(program(seq_cst, seq_cst)), "00"));
    EXPECT_EQ(endsOf(program(seq_cst, seq_cst)).size(), 3u);
}

TEST(ModelMemory, AMessageArrivesWithItsFlagIfReleaseMeetsAcquire) {
    const auto program = [](std::memory_order store, std::memory_order load) -> std::vector<Litmus::Body> {
        return { [=](Vars& v) { v.x.store(1, relaxed), v.y.store(1, store); },
                 [=](Vars& v) { v.r[0] = v.y.load(load), v.r[1] = v.x.load(relaxed); } };
    };
    EXPECT_FALSE(contains(endsOf(program(release, acquire)), "10"));
    EXPECT_TRUE(contains(endsOf(program(relaxed, acquire)), "10"));
    EXPECT_TRUE(contains(endsOf(program(release, relaxed)), "10"));
}

TEST(ModelMemory, ReadersAgreeOnTheOrderOfTwoWritersOnlyIfSequentiallyConsistent) {
    const auto program = [](std::memory_order store, std::memory_order load) -> std::vector<Litmus::Body> {
        return { [=](Vars& v) { v.x.store(1, store); }, [=](Vars& v) { v.y.store(1, store); },
                 [=](Vars& v) { v.r[0] = v.x.load(load), v.r[1] = v.y.load(load); },
                 [=](Vars& v) { v.r[2] = v.y.load(load), v.r[3] = v.x.load(load); } };
    };
    EXPECT_TRUE(contains(endsOf(program(release, acquire)), "1010"));
    EXPECT_FALSE(contains(endsOf(program(seq_cst, seq_cst)), "1010"));
}

TEST(ModelMemory, OneObjectIsCoherentEvenIfRelaxed) {
    const auto ends = endsOf({ [](Vars& v) { v.x.store(1, relaxed), v.x.store(2, relaxed); },
                               [](Vars& v) { v.r[0] = v.x.load(relaxed), v.r[1] = v.x.load(relaxed); } });
    EXPECT_TRUE(contains(ends, "02"));
    EXPECT_TRUE(contains(ends, "12"));
    EXPECT_FALSE(contains(ends, "21"));
    EXPECT_FALSE(contains(ends, "10"));
    EXPECT_EQ(ends.size(), 6u);
}

TEST(ModelMemory, ModificationOrdersMayDifferFromProgramOrders) { // 2+2W
    const auto program = [](std::memory_order order) -> std::vector<Litmus::Body> {
        return { [=](Vars& v) { v.x.store(1, order), v.y.store(2, order); },
                 [=](Vars& v) { v.y.store(1, order), v.x.store(2, order); } };
    };
    EXPECT_TRUE(contains(endsOf(program(release)), "0000 x1 y1"));
    EXPECT_FALSE(contains(endsOf(program(seq_cst)), "0000 x1 y1"));
}

TEST(ModelMemory, ModificationsAreNeverLostAndCarryAReleaseOn) {
    const auto ends = endsOf({ [](Vars& v) { v.x.store(1, relaxed), v.y.fetch_add(1, release); },
                               [](Vars& v) { v.y.fetch_add(2, relaxed); },
                               [](Vars& v) { v.r[0] = v.y.load(acquire), v.r[1] = v.x.load(relaxed); } });
    EXPECT_TRUE(contains(ends, "31"));
    EXPECT_TRUE(contains(ends, "20"));
    EXPECT_FALSE(contains(ends, "10"));
    EXPECT_FALSE(contains(ends, "30")); // whether the release came last, or was carried on by the relaxed one
    for (std::string const& end : ends) EXPECT_TRUE(end.ends_with("y3")) << end;
}

TEST(ModelMemory, TwoModificationsNeverReadTheSameStore) {
    const auto ends = endsOf({ [](Vars& v) {
                                  int expected = 0;
                                  v.r[0] = v.x.compare_exchange_strong(expected, 5, acq_rel, relaxed);
                                  v.r[1] = expected;
                              },
                               [](Vars& v) { v.r[2] = v.x.exchange(7, relaxed); } });
    EXPECT_EQ(ends, (std::set<std::string>{ "1050 x7 y0", "0700 x7 y0" }));
}

// ---------------------------------------------------------------------------------------------- what it finds

struct Program : Scenario {
    explicit Program(std::vector<std::function<void(Program&)>> threadBodies) : bodies(std::move(threadBodies)) {}
    int threads() const override { return static_cast<int>(bodies.size()); }
    void run(int thread) override { bodies[static_cast<size_t>(thread)](*this); }

    std::vector<std::function<void(Program&)>> bodies;
    Atomic<uint32_t> word{ 0 };
    Atomic<uint32_t> flag{ 0 };
    Plain<int> data;
    std::optional<Atomic<uint32_t>> brief{ std::in_place, 0u };
};

Report check(std::vector<std::function<void(Program&)>> const& bodies, Options const& options = {}) {
    return explore([&] { return std::make_unique<Program>(bodies); }, options);
}

std::string ruleOf(Report const& report) { return report.failure.substr(0, report.failure.find('\n')); }

TEST(ModelChecker, FindsADataRaceUnlessSomethingOrdersIt) {
    const auto writer = [](std::memory_order order) {
        return [=](Program& p) { p.data.set(1), p.flag.store(1, order); };
    };
    const auto reader = [](std::memory_order order) {
        return [=](Program& p) {
            if (p.flag.load(order) == 1) p.data.get();
        };
    };
    EXPECT_EQ(check({ writer(release), reader(acquire) }).failure, "");
    EXPECT_NE(ruleOf(check({ writer(relaxed), reader(acquire) })).find("data race"), std::string::npos);
    EXPECT_NE(ruleOf(check({ writer(release), reader(relaxed) })).find("data race"), std::string::npos);
    const auto lateWriter = [](Program& p) { p.flag.store(1, release), p.data.set(1); };
    EXPECT_NE(ruleOf(check({ lateWriter, reader(acquire) })).find("data race"), std::string::npos);
}

TEST(ModelChecker, FindsALostWakeUp) {
    const auto sleeper = [](Program& p) {
        while (p.word.load() == 0) ModelAtomics::wait(p.word, 0);
    };
    const auto loud = [](Program& p) { p.word.store(1), ModelAtomics::notifyOne(p.word); };
    const auto early = [](Program& p) { ModelAtomics::notifyOne(p.word), p.word.store(1); };
    EXPECT_EQ(check({ sleeper, loud }).failure, "");
    EXPECT_EQ(check({ sleeper, loud }, { .spuriousReturns = 2 }).failure, "");
    EXPECT_EQ(ruleOf(check({ sleeper, early })), "every thread sleeps");
}

TEST(ModelChecker, AWakeUpOfOneReachesOneAndOfAllReachesAll) {
    const auto sleeper = [](Program& p) {
        while (p.word.load() == 0) ModelAtomics::wait(p.word, 0);
    };
    const auto wakesOne = [](Program& p) { p.word.store(1), ModelAtomics::notifyOne(p.word); };
    const auto wakesAll = [](Program& p) { p.word.store(1), ModelAtomics::notifyAll(p.word); };
    EXPECT_EQ(ruleOf(check({ sleeper, sleeper, wakesOne })), "every thread sleeps");
    EXPECT_EQ(check({ sleeper, sleeper, wakesAll }).failure, "");
}

TEST(ModelChecker, FindsAnAccessThatTheEndOfAnObjectDoesNotWaitFor) {
    const auto finish = [](std::memory_order order) { return [=](Program& p) { p.brief->fetch_sub(1, order); }; };
    const auto wait = [](std::memory_order order) {
        return [=](Program& p) {
            if (p.brief->load(order) == ~0u) p.brief.reset();
        };
    };
    EXPECT_EQ(check({ finish(release), wait(acquire) }).failure, "");
    EXPECT_NE(check({ finish(release), wait(relaxed) }).failure, "");
    const auto touchAgain = [](Program& p) { p.brief->fetch_sub(1), p.brief->load(); };
    EXPECT_NE(check({ touchAgain, wait(acquire) }).failure, "");
}

TEST(ModelChecker, FindsARunWithoutAnEnd) {
    const auto spin = [](Program& p) {
        while (p.word.load(relaxed) == 0) p.flag.fetch_add(1, relaxed);
    };
    EXPECT_EQ(ruleOf(check({ spin, spin }, { .maxSteps = 40 })), "the run does not end");
}

TEST(ModelChecker, AppliesAMutationWhereItIsAskedTo) {
    const Options weaker = { .mutate = [](Operation& operation) {
        if (operation.kind == Kind::Store) operation.order = relaxed;
    } };
    const auto writer = [](Program& p) { p.data.set(1), p.flag.store(1, release); };
    const auto reader = [](Program& p) {
        if (p.flag.load(acquire) == 1) p.data.get();
    };
    EXPECT_EQ(check({ writer, reader }).failure, "");
    EXPECT_NE(check({ writer, reader }, weaker).failure, "");
}

TEST(ModelChecker, TellsTheStepsOfTheRunThatFailed) {
    const Report report = check({ [](Program& p) { p.word.store(7), require(p.flag.load() == 1, "one is set"); } });
    EXPECT_EQ(report.failure.substr(0, 11), "one is set\n");
    EXPECT_NE(report.failure.find("thread 0: atomic 0 store seq_cst finds 0, operand 7"), std::string::npos)
            << report.failure;
    EXPECT_NE(report.failure.find("thread 0: atomic 1 load seq_cst finds 0"), std::string::npos) << report.failure;
}

// ---------------------------------------------------------------------------------------------- random runs

/// One of the threads overtakes the other between its two steps.
std::vector<Litmus::Body> overtaking() {
    const auto twice = [](Vars& v) {
        const int before = v.x.load();
        v.x.store(before + 1);
    };
    return { twice, twice };
}

TEST(ModelSchedule, RandomRunsFindWhatAllRunsFind) {
    const std::set<std::string> all = endsOf(overtaking());
    EXPECT_EQ(endsOf(overtaking(), { .schedules = 200 }), all);
    EXPECT_TRUE(contains(all, "0000 x1")); // an increment is lost
}

TEST(ModelSchedule, TheSameSeedGivesTheSameRuns) {
    const auto failureOf = [](uint64_t seed) {
        const auto make = [] {
            struct Racing : Scenario {
                int threads() const override { return 8; }
                void run(int thread) override {
                    if (thread == 7)
                        require(x.fetch_add(1) > 3, "the eighth comes late");
                    else
                        x.fetch_add(1);
                }
                Atomic<int> x{ 0 };
            };
            return std::make_unique<Racing>();
        };
        return explore(make, { .schedules = 1000, .seed = seed }).failure;
    };
    EXPECT_NE(failureOf(1), "");
    EXPECT_EQ(failureOf(1), failureOf(1));
    EXPECT_NE(failureOf(1), failureOf(2));
}

} // namespace
} // namespace filament_core::jobs::model
