// SPDX-License-Identifier: Apache-2.0
#include "tests/jobsystem/JobSystemFixture.h"

#include <mutex>
#include <vector>

namespace filament_core::jobs {
namespace {

class PriorityTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, PriorityTest, testing::Values(1, 2, 7), workersName);

/// The order in which jobs started.
class StartOrder {
public:
    void note(char what) {
        const std::lock_guard lock(mMutex);
        mOrder += what;
    }
    std::string get() {
        const std::lock_guard lock(mMutex);
        return mOrder;
    }

private:
    std::mutex mMutex;
    std::string mOrder;
};

TEST(Priority, AWorkerStartsCriticalJobsBeforeNormalOnesThatWereQueuedEarlier) {
    for (const bool adopted : { true, false }) { // through a seat's deque, and through the injection queue
        JobSystem jobs({ .workers = 1 });
        std::unique_ptr<AdoptedThread> seat = adopted ? std::make_unique<AdoptedThread>(jobs) : nullptr;
        WorkersHeld held(jobs);
        StartOrder order;
        JobGroup normal(jobs), critical(jobs, Priority::FrameCritical);
        for (int i = 0; i < 8; ++i) normal.run([&] { order.note('n'); });
        for (int i = 0; i < 8; ++i) critical.run([&] { order.note('c'); });
        held.openWithoutWaiting();
        ASSERT_TRUE(becomesTrue([&] { return normal.isDone() && critical.isDone(); })); // the worker does it alone
        EXPECT_EQ(order.get(), "ccccccccnnnnnnnn") << (adopted ? "adopted" : "foreign");
    }
}

TEST(Priority, AWorkerLeavesItsOwnNormalJobsForACriticalOneThatAppearsElsewhere) {
    JobSystem jobs({ .workers = 1 });
    const AdoptedThread seat(jobs);
    std::atomic<bool> firstStarted = false, criticalQueued = false;
    StartOrder order;
    JobGroup normal(jobs), critical(jobs, Priority::FrameCritical);
    normal.run([&] {
        for (int i = 0; i < 5; ++i) {
            normal.run([&] {
                order.note('n');
                firstStarted = true;
                while (!criticalQueued.load()) std::this_thread::yield();
            });
        }
    });
    ASSERT_TRUE(becomesTrue([&] { return firstStarted.load(); }));
    critical.run([&] { order.note('c'); });
    criticalQueued = true;
    ASSERT_TRUE(becomesTrue([&] { return normal.isDone() && critical.isDone(); }));
    EXPECT_EQ(order.get(), "ncnnnn");
}

TEST_P(PriorityTest, AWaitForACriticalGroupStartsNoNormalJob) {
    const AdoptedThread seat(jobs);
    WorkersHeld held(jobs);
    const std::thread::id self = std::this_thread::get_id();
    std::atomic<int> normalHere = 0, criticalHere = 0;
    JobGroup normal(jobs), critical(jobs, Priority::FrameCritical);
    for (int i = 0; i < 20; ++i) {
        normal.run([&] { normalHere.fetch_add(std::this_thread::get_id() == self); });
        critical.run([&] { criticalHere.fetch_add(std::this_thread::get_id() == self); });
    }
    critical.wait();
    EXPECT_EQ(criticalHere.load(), 20);
    EXPECT_EQ(normalHere.load(), 0);
    EXPECT_FALSE(normal.isDone());
    held.open();
    normal.wait();
}

TEST_P(PriorityTest, AWaitForANormalGroupStartsCriticalJobsFirst) {
    const AdoptedThread seat(jobs);
    WorkersHeld held(jobs);
    StartOrder order;
    JobGroup normal(jobs), critical(jobs, Priority::FrameCritical);
    critical.run([&] { order.note('c'); });
    normal.run([&] { order.note('n'); });
    normal.wait();
    EXPECT_EQ(order.get(), "cn");
    held.open();
}

TEST_P(PriorityTest, ACriticalWaitThatSleepsWakesForCriticalWork) {
    const AdoptedThread seat(jobs);
    std::atomic<bool> inside = false, more = false, release = false;
    JobGroup critical(jobs, Priority::FrameCritical);
    std::vector<std::thread::id> ran(1);
    WorkersHeld held(jobs);
    std::thread feeder([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(5)); // by now the waiter sleeps
        JobGroup other(jobs, Priority::FrameCritical);
        other.run([&] { more = true; });
        EXPECT_TRUE(becomesTrue([&] { return more.load(); }))
                << "nobody ran it: all workers are held, the waiter slept";
        release = true;
    });
    critical.runBackground([&] {
        inside = true;
        while (!release.load()) std::this_thread::yield();
    });
    critical.wait();
    feeder.join();
    EXPECT_TRUE(inside.load());
    held.open();
}

TEST_P(PriorityTest, GroupsInheritThePriorityOfTheJobThatMakesThem) {
    std::vector<Priority> seen(3);
    JobGroup critical(jobs, Priority::FrameCritical), normal(jobs), background(jobs, Priority::Background);
    critical.run([&] { seen[0] = JobGroup(jobs).priority(); });
    normal.run([&] { seen[1] = JobGroup(jobs).priority(); });
    background.run([&] { seen[2] = JobGroup(jobs).priority(); });
    critical.wait();
    normal.wait();
    background.wait();
    EXPECT_EQ(seen, (std::vector{ Priority::FrameCritical, Priority::Normal, Priority::Background }));
    EXPECT_EQ(JobGroup(jobs).priority(), Priority::Normal);
}

TEST_P(PriorityTest, AStormOfMixedPrioritiesRunsEveryJobOnce) {
    std::atomic<int> ran = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t) {
        threads.emplace_back([&] {
            const AdoptedThread seat(jobs);
            for (int round = 0; round < 200; ++round) {
                JobGroup normal(jobs), critical(jobs, Priority::FrameCritical);
                for (int i = 0; i < 10; ++i) {
                    normal.run([&] {
                        ran.fetch_add(1);
                        parallelFor(jobs, Priority::FrameCritical, 4, 1, [&](size_t, size_t) { ran.fetch_add(1); });
                    });
                    critical.run([&] { ran.fetch_add(1); });
                }
                critical.wait();
                normal.wait();
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(ran.load(), 3 * 200 * 10 * 6);
}

} // namespace
} // namespace filament_core::jobs
