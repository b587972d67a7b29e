// SPDX-License-Identifier: Apache-2.0
// The stack of free jobs under the model checker: threads take a number, use what it stands for, and put it back.
#include "jobsystem/IndexStack.h"
#include "tests/jobsystem/ModelAtomics.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

namespace filament_core::jobs::model::index_stack {
namespace {

struct Plan {
    const char* script; // of every thread: + takes a number, - puts back the one that it took first
    int threads;
    uint32_t numbers; // on the stack at first

    std::string name() const {
        return std::to_string(threads) + " threads " + script + ", " + std::to_string(numbers) + " numbers";
    }
};

struct TakeAndPutBack : Scenario {
    explicit TakeAndPutBack(Plan const& options) : plan(options), stack(options.numbers) {
        for (uint32_t i = 0; i < plan.numbers; ++i) stack.push(i);
    }

    int threads() const override { return plan.threads; }

    void run(int) override {
        std::array<uint32_t, 4> held{};
        size_t first = 0, end = 0;
        for (const char* step = plan.script; *step; ++step) {
            if (*step == '+') {
                const uint32_t index = stack.pop();
                if (index != Stack::kNone) held[end++] = take(index);
            } else if (first < end) {
                putBack(held[first++]);
            }
        }
        while (first < end) putBack(held[first++]);
    }

    uint32_t take(uint32_t index) {
        require(uses[index].get() % 2 == 0, "nobody else holds the number");
        ++uses[index];
        return index;
    }

    void putBack(uint32_t index) {
        ++uses[index];
        stack.push(index);
    }

    void atEnd() override {
        uint32_t left = 0;
        while (stack.pop() != Stack::kNone) require(++left <= plan.numbers, "a number lies on the stack once");
        require(left == plan.numbers, "every number was put back");
    }

    using Stack = IndexStack<ModelAtomics>;
    const Plan plan;
    Stack stack;
    std::array<Plain<int>, 4> uses;
};

Report check(Plan const& plan, Options const& options = {}) {
    return explore([&] { return std::make_unique<TakeAndPutBack>(plan); }, options);
}

void expectCorrect(Plan const& plan, Options const& options = {}) {
    const Report report = check(plan, boundedIfSanitized(options));
    printExplored(plan.name(), report);
    EXPECT_EQ(report.failure, "") << plan.name();
}

TEST(IndexStackModel, ANumberIsHeldByOneThreadAtATimeAndNoneIsLost) {
    expectCorrect({ "+-", 2, 1 });
    expectCorrect({ "+-", 2, 2 });
    expectCorrect({ "++-+", 2, 3 }, { .preemptions = 1 });
    expectCorrect({ "+-", 3, 2 }, { .preemptions = 1 });
}

TEST(IndexStackModel, TheSameInLongerRuns) {
    if (stressFactor() == 0) GTEST_SKIP() << "minutes: set FILAMENT_STRESS=1";
    expectCorrect({ "++-", 2, 2 });
    expectCorrect({ "++-+", 2, 3 }, { .preemptions = 2 });
    expectCorrect({ "+-", 3, 2 });
}

std::string findingOf(Mutation const& mutation) {
    for (Plan const& plan : { Plan{ "+-", 2, 2 }, Plan{ "++-", 2, 2 }, Plan{ "++-+", 2, 3 } }) {
        const Report report = check(plan, { .mutate = mutation });
        if (!report.ok()) return report.failure.substr(0, report.failure.find('\n'));
    }
    return "";
}

TEST(IndexStackModel, WithoutCountingChangesAHeadThatCameBackFoolsAPop) {
    const auto uncounted = [](Operation& operation) {
        if (operation.kind == Kind::CompareExchange) operation.operand &= 0xFFFF'FFFF;
    };
    EXPECT_NE(findingOf({ uncounted }), "");
}

TEST(IndexStackModel, PushMustReleaseAndPopAcquireWhatTheNumberStandsFor) {
    EXPECT_NE(findingOf(Mutation::weaken("push", Kind::CompareExchange, std::memory_order_relaxed)), "");
    EXPECT_NE(findingOf(Mutation::weaken("pop", Kind::CompareExchange, std::memory_order_relaxed)), "");
}

} // namespace
} // namespace filament_core::jobs::model::index_stack
