// SPDX-License-Identifier: Apache-2.0
// The work-stealing deque under the model checker: an owner against one and two thieves, all interleavings.
#include "jobsystem/WorkStealingDeque.h"
#include "tests/jobsystem/ModelAtomics.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <string>

namespace filament_core::jobs::model::deque {
namespace {

struct Item {
    Plain<int> payload; // what a job captured: written before push(), read after it came out
    Plain<int> runs;
};

/// The owner follows a script: p pushes the next item (and runs it itself if the deque is full), t takes one. At the
/// end the owner takes until nothing is left. Thieves steal `steals` times each.
template <uint32_t kSlots>
struct OwnerAgainstThieves : Scenario {
    OwnerAgainstThieves(std::string script, int thiefCount, int stealCount)
            : ownerScript(std::move(script)), thieves(thiefCount), steals(stealCount) {}

    int threads() const override { return 1 + thieves; }

    void run(int thread) override {
        if (thread == 0) {
            own();
        } else {
            for (int i = 0; i < steals; ++i) execute(deque.steal());
        }
    }

    void own() {
        for (const char step : ownerScript) step == 'p' ? push() : execute(deque.take());
        while (Item* item = deque.take()) execute(item);
    }

    void push() {
        Item& item = items[static_cast<size_t>(pushed++)];
        item.payload.set(pushed);
        if (!deque.push(&item)) execute(&item);
    }

    void execute(Item* item) {
        if (!item) return;
        require(item->payload.get() == static_cast<int>(item - items.data()) + 1, "an item comes out as it went in");
        require(item->runs.get() == 0, "an item comes out once");
        item->runs.set(1);
    }

    void atEnd() override {
        for (int i = 0; i < pushed; ++i) require(items[static_cast<size_t>(i)].runs.get() == 1, "every item comes out");
    }

    const std::string ownerScript;
    const int thieves, steals;
    WorkStealingDeque<Item, kSlots, ModelAtomics> deque;
    std::array<Item, 6> items;
    int pushed = 0; // of the owner
};

template <uint32_t kSlots = 2>
Report check(std::string const& script, int thieves, int steals, Options const& options = {}) {
    return explore([&] { return std::make_unique<OwnerAgainstThieves<kSlots>>(script, thieves, steals); }, options);
}

struct Case {
    const char* script;
    int thieves, steals;

    std::string name() const {
        return std::string(script) + ", " + std::to_string(thieves) + " x " + std::to_string(steals) + " steals";
    }
};

void expectCorrect(std::span<const Case> cases) {
    for (Case const& c : cases) {
        const Report report = check(c.script, c.thieves, c.steals, boundedIfSanitized({}));
        printExplored(c.name(), report);
        EXPECT_EQ(report.failure, "") << c.name();
    }
}

constexpr Case kQuick[] = { { "p", 1, 1 }, { "pp", 1, 2 }, { "pptp", 1, 2 },  { "pppp", 1, 4 },
                            { "p", 2, 1 }, { "pp", 2, 1 }, { "ptptp", 1, 2 }, { "ppp", 2, 1 } };

TEST(DequeModel, EveryItemComesOutExactlyOnceAlsoWhenTwoSlotsWrapAround) { expectCorrect(kQuick); }

TEST(DequeModel, EveryItemComesOutExactlyOnceInLongerRuns) {
    if (stressFactor() == 0) GTEST_SKIP() << "minutes: set FILAMENT_STRESS=1";
    constexpr Case kLong[] = { { "pptppt", 1, 3 }, { "pptp", 2, 1 }, { "ppppp", 1, 5 }, { "pp", 2, 2 } };
    expectCorrect(kLong);
}

// ---------------------------------------------------------------------------------------------- what if it were weaker

/// What the checker reports if one operation of the deque is replaced.
std::string findingOf(Mutation const& mutation) {
    for (Case const& c : kQuick) {
        const Report report = check(c.script, c.thieves, c.steals, { .mutate = mutation });
        if (!report.ok()) return report.failure.substr(0, report.failure.find('\n'));
    }
    return "";
}

// Two threads that run the same item race, unless another operation orders them.
constexpr const char* kTwice = "an item comes out once";
constexpr const char* kRace = "a data race: a read that a write does not happen before";

TEST(DequeModel, WithoutItsCompareAndSwapTakeHandsOutTheLastItemTwice) {
    EXPECT_EQ(findingOf(Mutation::to(Kind::Assume, "claim", Kind::CompareExchange)), kTwice);
}

TEST(DequeModel, WithoutItsCompareAndSwapTwoThievesStealTheSame) {
    EXPECT_EQ(findingOf(Mutation::to(Kind::Assume, "steal", Kind::CompareExchange)), kRace);
}

TEST(DequeModel, TakeMustClaimBeforeItLooksAtTheTop) {
    EXPECT_EQ(findingOf(Mutation::toReleaseStore("take")), kRace);
    for (const std::memory_order weaker :
         { std::memory_order_acq_rel, std::memory_order_acquire, std::memory_order_release, std::memory_order_relaxed })
        EXPECT_EQ(findingOf(Mutation::weaken("take", Kind::Exchange, weaker)), kRace);
}

TEST(DequeModel, TakeMustSeeEveryTheftThatCameBeforeItsClaim) {
    // line by line: the first load of top is relaxed already and only an early exit
    const auto secondLook = [](std::memory_order weaker) {
        return Mutation{ [=](Operation& operation) {
            const bool looks = operation.isIn("take") && operation.kind == Kind::Load;
            if (looks && operation.order == std::memory_order_seq_cst) operation.order = weaker;
        } };
    };
    EXPECT_EQ(findingOf(secondLook(std::memory_order_acquire)), kRace);
    EXPECT_EQ(findingOf(secondLook(std::memory_order_relaxed)), kRace);
}

TEST(DequeModel, PushMustReleaseWhatTheItemHolds) {
    EXPECT_EQ(findingOf(Mutation::weaken("push", Kind::Exchange, std::memory_order_relaxed)), kRace);
    EXPECT_EQ(findingOf(Mutation::weaken("push", Kind::Exchange, std::memory_order_acquire)), kRace);
}

TEST(DequeModel, StealMustAcquireWhatTheItemHolds) {
    EXPECT_EQ(findingOf(Mutation::weaken("steal", Kind::Load, std::memory_order_relaxed)), kRace);
}

TEST(DequeModel, StealMustSeeAnOwnersClaimThatItsLookAtTheTopCameAfter) {
    EXPECT_EQ(findingOf(Mutation::weaken("steal", Kind::Load, std::memory_order_acquire)), kRace);
}

// Between the thieves and the owner alone, a releasing push would suffice. ParkingLotModelTest.cpp shows why sleepers
// need a stronger one.
TEST(DequeModel, WithoutSleepersAReleasingPushWouldDo) {
    const Options weaker = boundedIfSanitized({ .mutate = Mutation::toReleaseStore("push") });
    EXPECT_EQ(check("pptp", 1, 2, weaker).failure, "");
    EXPECT_EQ(check("pp", 2, 1, weaker).failure, "");
}

} // namespace
} // namespace filament_core::jobs::model::deque
