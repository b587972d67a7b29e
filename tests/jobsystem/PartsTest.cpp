// SPDX-License-Identifier: Apache-2.0
// The parts below the scheduler, each alone: deque, storage, parking lot.
#include "jobsystem/JobStorage.h"
#include "jobsystem/ParkingLot.h"
#include "jobsystem/Patience.h"
#include "jobsystem/WorkStealingDeque.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>
#include <vector>

namespace filament_core::jobs {
namespace {

TEST(WorkStealingDeque, TheOwnerTakesTheNewestAndAThiefTheOldest) {
    WorkStealingDeque<int, 8> deque;
    int items[4] = {};
    for (int& item : items) ASSERT_TRUE(deque.push(&item));
    EXPECT_EQ(deque.steal(), &items[0]);
    EXPECT_EQ(deque.take(), &items[3]);
    EXPECT_EQ(deque.steal(), &items[1]);
    EXPECT_EQ(deque.take(), &items[2]);
    EXPECT_EQ(deque.take(), nullptr);
    EXPECT_EQ(deque.steal(), nullptr);
    EXPECT_TRUE(deque.isEmpty());
}

TEST(WorkStealingDeque, RefusesWhenFullAndAcceptsAgainAfterATheft) {
    WorkStealingDeque<int, 4> deque;
    int items[5] = {};
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(deque.push(&items[i]));
    EXPECT_FALSE(deque.push(&items[4]));
    EXPECT_EQ(deque.steal(), &items[0]);
    EXPECT_TRUE(deque.push(&items[4]));
    EXPECT_EQ(deque.take(), &items[4]);
}

TEST(WorkStealingDeque, UnderThievesEveryItemComesOutExactlyOnce) {
    constexpr int kItems = 200'000;
    WorkStealingDeque<int, 64> deque;
    std::vector<int> items(kItems, 0); // plain: two threads on one item would be a race that the sanitizer reports
    std::atomic<bool> done = false;
    const auto thief = [&] {
        while (!done.load()) {
            if (int* item = deque.steal()) ++*item;
        }
    };
    std::thread first(thief), second(thief);
    for (int i = 0; i < kItems; ++i) {
        while (!deque.push(&items[i])) {
            if (int* item = deque.take()) ++*item;
        }
        if (i % 3 == 0) {
            if (int* item = deque.take()) ++*item;
        }
    }
    while (int* item = deque.take()) ++*item;
    done = true;
    first.join();
    second.join();
    for (int i = 0; i < kItems; ++i) ASSERT_EQ(items[i], 1) << "item " << i;
}

TEST(WorkStealingDeque, TellsTheExtentOfItsItems) {
    WorkStealingDeque<int, 8> deque;
    int items[3] = {};
    EXPECT_TRUE(deque.extent().isEmpty());
    for (int& item : items) ASSERT_TRUE(deque.push(&item));
    const auto all = deque.extent();
    EXPECT_EQ(all.end - all.oldest, 3);
    ASSERT_NE(deque.steal(), nullptr);
    EXPECT_EQ(deque.extent().oldest, all.oldest + 1);
    ASSERT_NE(deque.take(), nullptr);
    ASSERT_NE(deque.take(), nullptr); // the last item goes the way of a theft: its place is not used again
    EXPECT_TRUE(deque.extent().isEmpty());
    ASSERT_TRUE(deque.push(&items[0]));
    EXPECT_GE(deque.extent().oldest, all.oldest + 2);
}

// ---------------------------------------------------------------------------------------------- patience

TEST(Patience, TakesOnlyWhatWasThereAtTheLastLook) {
    Patience patience;
    int deque = 0, other = 0;
    patience.begin(0);
    ASSERT_TRUE(patience.isTimeToLook(0));
    EXPECT_FALSE(patience.isStillThere(&deque, 5, 7));
    EXPECT_TRUE(patience.looked(0)) << "it saw something";
    EXPECT_FALSE(patience.isTimeToLook(Patience::kSecondLook - 1));
    ASSERT_TRUE(patience.isTimeToLook(Patience::kSecondLook));
    EXPECT_FALSE(patience.isStillThere(&other, 5, 7));
    EXPECT_FALSE(patience.isStillThere(&deque, 7, 8)) << "what was there is gone, this is new";
    EXPECT_TRUE(patience.isStillThere(&deque, 6, 9)) << "the second of two items that were there";
}

TEST(Patience, LooksEverMoreRarelyWhileThereIsNothing) {
    Patience patience;
    int64_t now = 0, last = 0;
    std::vector<int64_t> intervals;
    patience.begin(now);
    while (intervals.size() < 8) {
        while (!patience.isTimeToLook(now)) ++now;
        intervals.push_back(now - last);
        last = now;
        EXPECT_FALSE(patience.looked(now));
    }
    EXPECT_EQ(intervals, (std::vector<int64_t>{ 0, 100, 200, 400, 800, 1000, 1000, 1000 }));
}

TEST(Patience, AfterATheftThatDidNotPayTheNextLookWaits) {
    Patience patience;
    patience.learn(Patience::kWorthStealing - 1);
    patience.begin(0);
    EXPECT_FALSE(patience.isTimeToLook(Patience::kLongestInterval - 1));
    EXPECT_TRUE(patience.isTimeToLook(Patience::kLongestInterval));
    patience.learn(Patience::kWorthStealing);
    patience.begin(0);
    EXPECT_TRUE(patience.isTimeToLook(0));
}

// ---------------------------------------------------------------------------------------------- storage, sleep

TEST(JobStorage, GivesOutEveryJobOnceAndThenNull) {
    JobStorage storage(100); // not a multiple of the batch size
    JobStorage::Cache cache;
    std::set<Job*> jobs;
    while (Job* job = storage.allocate(jobs.size() % 2 ? &cache : nullptr)) ASSERT_TRUE(jobs.insert(job).second);
    while (Job* job = storage.allocate(&cache)) ASSERT_TRUE(jobs.insert(job).second);
    EXPECT_EQ(jobs.size(), 100u);
    EXPECT_EQ(storage.allocate(nullptr), nullptr);
}

TEST(JobStorage, WhatOneThreadReleasesAnotherCanAllocate) {
    JobStorage storage(256);
    JobStorage::Cache mine, theirs;
    for (int round = 0; round < 50; ++round) {
        std::vector<Job*> jobs;
        for (int i = 0; i < 128; ++i) jobs.push_back(storage.allocate(&mine));
        for (Job* job : jobs) {
            ASSERT_NE(job, nullptr) << "round " << round;
            storage.release(&theirs, *job);
        }
    }
}

TEST(JobStorage, ThreadsNeverHoldTheSameJob) {
    JobStorage storage(512);
    const auto churn = [&](bool cached) {
        JobStorage::Cache cache;
        std::vector<Job*> held;
        for (int i = 0; i < 50'000; ++i) {
            if (Job* job = held.size() < 60 ? storage.allocate(cached ? &cache : nullptr) : nullptr) {
                job->captures[0] = std::byte{ 1 }; // a plain write: shared jobs would be a race
                held.push_back(job);
            }
            if (i % 3 == 0 || held.size() == 60) {
                storage.release(cached ? &cache : nullptr, *held.back());
                held.pop_back();
            }
        }
    };
    std::thread first(churn, true), second(churn, true), third(churn, false);
    first.join();
    second.join();
    third.join();
}

TEST(ParkingLot, AWakeUpBetweenPrepareAndParkIsNotLost) {
    ParkingLot lot;
    const ParkingLot::Ticket one = lot.prepare();
    lot.wakeOne();
    lot.park(one); // would hang
    const ParkingLot::Ticket all = lot.prepare();
    lot.wakeAll();
    lot.park(all);
    EXPECT_FALSE(lot.hasSleepers());
}

TEST(ParkingLot, AWakeUpThatMeetsACancelledSleepDoesNotSwallowTheNextOne) {
    ParkingLot lot;
    lot.prepare();
    lot.wakeOne(); // answered by cancel(): that thread looks for work itself
    lot.cancel();
    const ParkingLot::Ticket ticket = lot.prepare();
    lot.wakeOne();
    lot.park(ticket); // would hang if the first wake-up still counted as under way
    EXPECT_FALSE(lot.hasSleepers());
}

TEST(ParkingLot, TwoThreadsThatHandATokenToAndFroNeverBothSleep) {
    constexpr int kRounds = 20'000;
    ParkingLot lots[2];
    std::atomic<int> token = 0; // seq_cst, as the protocol demands of what is published
    const auto player = [&](int self) {
        for (int round = 0; round < kRounds; ++round) {
            while (token.load() != 2 * round + self) {
                const ParkingLot::Ticket ticket = lots[self].prepare();
                if (token.load() == 2 * round + self) {
                    lots[self].cancel();
                } else {
                    lots[self].park(ticket);
                }
            }
            token.fetch_add(1);
            lots[1 - self].wakeOne();
        }
    };
    std::thread first(player, 0), second(player, 1);
    first.join();
    second.join();
    EXPECT_EQ(token.load(), 2 * kRounds);
}

} // namespace
} // namespace filament_core::jobs
