// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Seat.h"
#include "tests/jobsystem/JobSystemFixture.h"

#include <optional>
#include <vector>

namespace filament_core::jobs {
namespace {

class AdoptedThreadTest : public JobSystemFixture {};
INSTANTIATE_TEST_SUITE_P(Workers, AdoptedThreadTest, testing::Values(0, 1, 2, 7), workersName);

TEST_P(AdoptedThreadTest, MayComeAndGoAnyNumberOfTimes) {
    for (int round = 0; round < 20'000; ++round) {
        const AdoptedThread seat(jobs);
        if (round % 100 != 0) continue;
        ASSERT_EQ(fibonacci(jobs, 8), 21);
    }
}

TEST_P(AdoptedThreadTest, ManyThreadsComeAndGoAtTheSameTime) {
    constexpr int kThreads = 24, kRounds = 40; // more than there are seats
    std::atomic<int64_t> sum = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < kThreads; ++i) {
        threads.emplace_back([&] {
            for (int round = 0; round < kRounds; ++round) {
                const AdoptedThread seat(jobs);
                sum.fetch_add(fibonacci(jobs, 7));
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(sum.load(), kThreads * kRounds * 13);
}

TEST_P(AdoptedThreadTest, WorksWithoutAFreeSeat) {
    std::atomic<bool> release = false;
    std::atomic<uint32_t> seated = 0;
    std::vector<std::thread> threads;
    for (uint32_t i = 0; i < SeatTable::kGuestSeats; ++i) {
        threads.emplace_back([&] {
            const AdoptedThread seat(jobs);
            seated.fetch_add(1);
            while (!release.load()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        });
    }
    EXPECT_TRUE(becomesTrue([&] { return seated.load() == SeatTable::kGuestSeats; }));
    {
        const AdoptedThread late(jobs);
        EXPECT_EQ(tThread.seat, nullptr);
        EXPECT_EQ(fibonacci(jobs, 12), 144);
        std::atomic<int> visits = 0;
        parallelFor(jobs, 1000, 7, [&](size_t begin, size_t end) { visits.fetch_add(static_cast<int>(end - begin)); });
        EXPECT_EQ(visits.load(), 1000);
    }
    release = true;
    for (std::thread& thread : threads) thread.join();
}

TEST_P(AdoptedThreadTest, NestsWithinOneSystemAndAcrossSystems) {
    JobSystem other({ .workers = 1 });
    const AdoptedThread outer(jobs);
    Seat* const mine = tThread.seat;
    {
        const AdoptedThread again(jobs);
        EXPECT_EQ(tThread.seat, mine) << "a thread that sits does not take a second seat";
        const AdoptedThread there(other);
        EXPECT_NE(tThread.seat, mine);
        const AdoptedThread back(jobs);
        EXPECT_EQ(fibonacci(jobs, 8) + fibonacci(other, 8), 42);
    }
    EXPECT_EQ(tThread.seat, mine);
}

TEST_P(AdoptedThreadTest, JobsThatItLeavesBehindAreRunByOthers) {
    if (workers() == 0) GTEST_SKIP() << "nothing is ever left";
    std::atomic<int> ran = 0;
    std::optional<JobGroup> group(std::in_place, jobs);
    {
        const AdoptedThread seat(jobs);
        WorkersHeld held(jobs);
        for (int i = 0; i < 100; ++i) group->run([&] { ran.fetch_add(1); });
        held.openWithoutWaiting();
    }
    EXPECT_TRUE(becomesTrue([&] { return group->isDone(); }));
    EXPECT_EQ(ran.load(), 100);
}

TEST_P(AdoptedThreadTest, AGroupOutlivesTheStayThatItWasMadeIn) {
    for (int round = 0; round < 200; ++round) {
        std::atomic<int> ran = 0;
        std::optional<JobGroup> group;
        {
            const AdoptedThread seat(jobs);
            group.emplace(jobs);
            for (int i = 0; i < 4; ++i) group->run([&] { ran.fetch_add(1); });
        }
        std::thread somebodyElse([&] { // takes the seat that is free now, and runs what lies there
            const AdoptedThread seat(jobs);
            EXPECT_EQ(fibonacci(jobs, 6), 8);
        });
        group->wait();
        somebodyElse.join();
        ASSERT_EQ(ran.load(), 4);
    }
}

TEST_P(AdoptedThreadTest, ManySystemsComeAndGoUnderOneThread) {
    const AdoptedThread seat(jobs);
    for (int round = 0; round < 50; ++round) {
        JobSystem brief({ .workers = round % 4 });
        const AdoptedThread there(brief);
        ASSERT_EQ(fibonacci(brief, 8), 21);
    }
    EXPECT_EQ(fibonacci(jobs, 8), 21);
}

TEST(AdoptedThreadDeathTest, RefusesToEndOutOfOrder) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(
            {
                JobSystem one({ .workers = 1 });
                JobSystem other({ .workers = 1 });
                std::optional<AdoptedThread> first(std::in_place, one);
                const AdoptedThread second(other);
                first.reset();
            },
            "the last one first");
}

} // namespace
} // namespace filament_core::jobs
