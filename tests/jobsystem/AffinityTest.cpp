// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Affinity.h"

#include "base/Log.h"
#include "tests/jobsystem/FakeMachine.h"
#include "tests/jobsystem/OwnThread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::jobs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Collects the log while it lives.
class LogCollector {
public:
    LogCollector() : mPrevious(setLogSink([this](Severity, std::string_view line) { mLines.emplace_back(line); })) {}
    ~LogCollector() { setLogSink(std::move(mPrevious)); }
    std::vector<std::string> const& lines() const { return mLines; }

private:
    std::vector<std::string> mLines;
    LogSink mPrevious;
};

// Cores 0 and 1 are fast and have two hardware threads each (0, 1 and 2, 3), cores 2 and 3 are slow (4 and 5).
Topology hybrid() {
    Topology topology{ .quota = 6, .usableThreads = 6 };
    for (int i = 0; i < 4; ++i)
        topology.cpus.push_back({ .index = i, .physicalCore = i / 2, .smtRank = i % 2, .efficiencyClass = 1 });
    for (int i = 4; i < 6; ++i) topology.cpus.push_back({ .index = i, .physicalCore = i - 2 });
    return topology;
}

Topology uniform(int cores, int coresPerCache = 64) {
    Topology topology{ .quota = 1e9, .usableThreads = static_cast<uint32_t>(cores) };
    for (int i = 0; i < cores; ++i)
        topology.cpus.push_back({ .index = i, .physicalCore = i, .cacheGroup = i / coresPerCache });
    return topology;
}

std::vector<int> allowed(AffinityPolicy const& policy, Topology const& topology) {
    std::vector<int> cores;
    for (Cpu const& cpu : allowedCpus(policy, topology)) cores.push_back(cpu.index);
    return cores;
}

std::vector<int> pinned(CorePins const& pins) { return { pins.cores().begin(), pins.cores().end() }; }

// ---------------------------------------------------------------------------------------------- policy

TEST(AffinityPolicy, BigCoresAreThoseOfTheMostCapableClass) {
    EXPECT_THAT(allowed(AffinityPolicy::bigCores(), hybrid()), ElementsAre(0, 1, 2, 3));
}

TEST(AffinityPolicy, BigCoresOfAUniformMachineAreAll) {
    EXPECT_THAT(allowed(AffinityPolicy::bigCores(), uniform(3)), ElementsAre(0, 1, 2));
}

TEST(AffinityPolicy, EveryKindCanAvoidCores) {
    EXPECT_THAT(allowed(AffinityPolicy::avoid(4), hybrid()), ElementsAre(0, 1, 2, 3, 5));
    EXPECT_THAT(allowed(AffinityPolicy::avoid(0).avoiding(5).avoiding(5), hybrid()), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(allowed(AffinityPolicy::bigCores().avoiding(2), hybrid()), ElementsAre(0, 1, 3));
    EXPECT_THAT(allowed(AffinityPolicy::pin().avoiding(2), hybrid()), ElementsAre(0, 1, 3, 4, 5));
}

TEST(AffinityPolicy, AvoidsNothingWhereNoOtherCoreIsLeft) {
    EXPECT_THAT(allowed(AffinityPolicy::avoid(0), uniform(1)), ElementsAre(0));
    EXPECT_THAT(allowed(AffinityPolicy::avoid(0).avoiding(1), uniform(2)), ElementsAre(0, 1));
}

TEST(AffinityPolicy, AvoidingACoreThatIsNotThereChangesNothing) {
    EXPECT_THAT(allowed(AffinityPolicy::avoid(9), uniform(2)), ElementsAre(0, 1));
}

TEST(DefaultWorkerCount, IsOneLessThanTheUsableThreads) {
    const auto budget = readCpuBudget();
    EXPECT_EQ(defaultWorkerCount(AffinityPolicy::none()), budget.usableThreads - 1);
    EXPECT_EQ(defaultWorkerCount(AffinityPolicy::pin()), budget.usableThreads - 1);
    EXPECT_EQ(defaultWorkerCount(AffinityPolicy::avoid(budget.cores.back())), budget.usableThreads - 1);
}

TEST(RequireCore, NamesTheOptionAndTheCoresThereAre) {
    const std::vector<int> cores = coresOfThisThread();
    EXPECT_TRUE(requireCore(cores.front(), "EngineOptions::driverCore").ok());
    for (int core : { -2, cores.back() + 1, 100'000 }) {
        const Result<void> refused = requireCore(core, "EngineOptions::driverCore");
        ASSERT_FALSE(refused.ok()) << core;
        EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(refused.error().message, HasSubstr("EngineOptions::driverCore"));
        EXPECT_THAT(refused.error().message, HasSubstr("no core " + std::to_string(core) + ' '));
        EXPECT_THAT(refused.error().message, HasSubstr(rangesOf(cores)));
    }
}

// ---------------------------------------------------------------------------------------------- threads

TEST(ThisThread, PinningNarrowsItsCoresToOne) {
    const std::vector<int> cores = coresOfThisThread();
    onOwnThread([&] {
        EXPECT_TRUE(pinThisThread(cores.back()));
        EXPECT_EQ(coresOfThisThread(), std::vector{ cores.back() });
        EXPECT_TRUE(bindThisThread(cores)) << "and back";
        EXPECT_EQ(coresOfThisThread(), cores);
    });
    EXPECT_EQ(coresOfThisThread(), cores);
}

TEST(ThisThread, StaysWhereItIsIfACoreDoesNotExist) {
    const std::vector<int> cores = coresOfThisThread();
    LogCollector log;
    for (int core : { 8191, 8192, -1 }) EXPECT_FALSE(pinThisThread(core)) << core;
    EXPECT_FALSE(bindThisThread({}));
    EXPECT_EQ(coresOfThisThread(), cores);
    ASSERT_EQ(log.lines().size(), 4u);
    EXPECT_THAT(log.lines()[0], HasSubstr("cannot bind a thread to core 8191: "));
}

TEST(ThisThread, HasANameOfFifteenBytes) {
    onOwnThread([] {
        nameThisThread("a name beyond fifteen letters");
        std::string name;
        std::getline(std::ifstream("/proc/thread-self/comm"), name);
        EXPECT_EQ(name, "a name beyond f");
        EXPECT_EQ(nameOfThisThread(), name);
    });
}

// ---------------------------------------------------------------------------------------------- pins

TEST(CoreRegistry, LendsPhysicalCoresBeforeTheirSecondHardwareThreadsAndFastOnesFirst) {
    CoreRegistry registry;
    const Topology topology = hybrid();
    const CorePins pins = registry.lend(topology, topology.cpus, 6, "test");
    EXPECT_EQ(pins.callerCore(), 0) << "the fastest core is the caller's until the others are taken";
    EXPECT_THAT(pinned(pins), ElementsAre(2, 4, 5, 1, 3, 0));
}

TEST(CoreRegistry, LendsTwoSystemsDifferentCoresWhileThereAreAny) {
    CoreRegistry registry;
    const Topology topology = uniform(4);
    const CorePins first = registry.lend(topology, topology.cpus, 2, "first");
    const CorePins second = registry.lend(topology, topology.cpus, 2, "second");
    EXPECT_THAT(pinned(first), ElementsAre(1, 2));
    EXPECT_THAT(pinned(second), ElementsAre(0, 3));
}

TEST(CoreRegistry, LendsGivenBackCoresAgain) {
    CoreRegistry registry;
    const Topology topology = uniform(4);
    CorePins first = registry.lend(topology, topology.cpus, 3, "first");
    EXPECT_THAT(pinned(first), ElementsAre(1, 2, 3));
    CorePins moved = std::move(first);
    EXPECT_THAT(pinned(first), IsEmpty());
    moved = {};
    EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 3, "second")), ElementsAre(1, 2, 3));
}

TEST(CoreRegistry, GoesRoundWithOneLineInTheLogWhenThereAreMoreThreadsThanCores) {
    CoreRegistry registry;
    const Topology topology = uniform(2);
    LogCollector log;
    const CorePins pins = registry.lend(topology, topology.cpus, 5, "worker");
    EXPECT_THAT(pinned(pins), ElementsAre(1, 0, 1, 0, 1));
    EXPECT_THAT(log.lines(), ElementsAre(HasSubstr("worker: 3 of 5 pinned threads share a core")));
}

TEST(CoreRegistry, SharesEvenlyAmong256ThreadsOnTwoCores) {
    CoreRegistry registry;
    const Topology topology = uniform(2);
    LogCollector log;
    const CorePins pins = registry.lend(topology, topology.cpus, 256, "worker");
    EXPECT_EQ(std::count(pins.cores().begin(), pins.cores().end(), 0), 128);
}

TEST(CoreRegistry, LendsAReservedCoreLast) {
    CoreRegistry registry;
    const Topology topology = uniform(4);
    LogCollector log;
    {
        const CorePins driver = registry.reserve(1);
        EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 3, "test")), ElementsAre(2, 3, 0));
        EXPECT_THAT(log.lines(), IsEmpty());
        EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 4, "test")), ElementsAre(2, 3, 0, 1));
        EXPECT_EQ(log.lines().size(), 1u);
    }
    EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 3, "test")), ElementsAre(1, 2, 3));
    EXPECT_THAT(pinned(registry.reserve(-1)), IsEmpty());
}

TEST(CoreRegistry, AvoidsTheNeighbourOfABusyHardwareThread) {
    CoreRegistry registry;
    const Topology topology = hybrid();
    const CorePins driver = registry.reserve(0);
    const CorePins pins = registry.lend(topology, topology.cpus, 2, "test");
    EXPECT_EQ(pins.callerCore(), 2);
    EXPECT_THAT(pinned(pins), ElementsAre(4, 5)) << "slow cores of their own before 1, the other half of core 0";
}

TEST(CoreRegistry, FillsOneCacheBeforeTheNext) {
    CoreRegistry registry;
    Topology topology = uniform(8, 4);
    for (Cpu& cpu : topology.cpus) { // as on machines that count the cores of the caches in turns
        cpu.cacheGroup = cpu.index % 2;
    }
    EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 5, "test")), ElementsAre(2, 4, 6, 1, 3));
}

TEST(CoreRegistry, KeepsItsCountsWhenManySystemsComeAndGo) {
    CoreRegistry registry;
    const Topology topology = uniform(4);
    LogCollector log;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&, i] {
            for (int round = 0; round < 500; ++round) {
                const CorePins driver = registry.reserve(i);
                const CorePins pins = registry.lend(topology, topology.cpus, 1 + static_cast<uint32_t>(i), "test");
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(pinned(registry.lend(topology, topology.cpus, 3, "test")), ElementsAre(1, 2, 3)) << "all came back";
}

// ---------------------------------------------------------------------------------------------- placement

TEST(WorkerPlacement, WithoutAPolicyLeavesThreadsWhereTheyAre) {
    const std::vector<int> cores = coresOfThisThread();
    const WorkerPlacement placement(AffinityPolicy::none(), 2, "test");
    onOwnThread([&] {
        ASSERT_TRUE(pinThisThread(cores.front()));
        placement.placeWorker(0);
        placement.placeBackgroundThread();
        EXPECT_EQ(coresOfThisThread(), std::vector{ cores.front() });
    });
}

TEST(WorkerPlacement, PinsWorkersToDifferentCoresAndFreesTheBackgroundThreadsTheyStart) {
    const std::vector<int> cores = coresOfThisThread();
    const auto workers = static_cast<uint32_t>(cores.size());
    const WorkerPlacement placement(AffinityPolicy::pin(), workers, "test");
    std::set<int> taken;
    for (uint32_t worker = 0; worker < workers; ++worker) {
        onOwnThread([&] {
            placement.placeWorker(worker);
            const std::vector<int> own = coresOfThisThread();
            EXPECT_EQ(own.size(), 1u);
            taken.insert(own[0]);
            onOwnThread([&] {
                placement.placeBackgroundThread();
                EXPECT_EQ(coresOfThisThread(), cores);
            });
        });
    }
    EXPECT_EQ(taken.size(), cores.size());
}

TEST(WorkerPlacement, OfTwoSystemsPinsToDifferentCores) {
    if (coresOfThisThread().size() < 2) GTEST_SKIP() << "needs two cores";
    const auto coreOf = [](WorkerPlacement const& placement) {
        int core = -1;
        onOwnThread([&] {
            placement.placeWorker(0);
            core = coresOfThisThread()[0];
        });
        return core;
    };
    const WorkerPlacement first(AffinityPolicy::pin(), 1, "first"), second(AffinityPolicy::pin(), 1, "second");
    EXPECT_NE(coreOf(first), coreOf(second));
}

TEST(WorkerPlacement, KeepsWorkersAndBackgroundThreadsOffAnAvoidedCore) {
    std::vector<int> others = coresOfThisThread();
    if (others.size() < 2) GTEST_SKIP() << "needs two cores";
    const WorkerPlacement placement(AffinityPolicy::avoid(others.back()), 1, "test");
    const WorkerPlacement pinnedPlacement(AffinityPolicy::pin().avoiding(others.back()), 3, "test");
    const int avoided = others.back();
    others.pop_back();
    onOwnThread([&] {
        placement.placeWorker(0);
        EXPECT_EQ(coresOfThisThread(), others);
    });
    onOwnThread([&] {
        placement.placeBackgroundThread();
        EXPECT_EQ(coresOfThisThread(), others);
    });
    for (uint32_t worker = 0; worker < 3; ++worker) {
        onOwnThread([&] {
            pinnedPlacement.placeWorker(worker);
            EXPECT_NE(coresOfThisThread(), std::vector{ avoided });
        });
    }
}

TEST(WorkerPlacement, ReportsCoresThatCannotBeAvoided) {
    const std::vector<int> cores = coresOfThisThread();
    onOwnThread([&] {
        ASSERT_TRUE(pinThisThread(cores.front()));
        LogCollector log;
        const WorkerPlacement placement(AffinityPolicy::avoid(cores.front()).avoiding(8190), 1, "worker");
        placement.placeWorker(0);
        EXPECT_EQ(coresOfThisThread(), std::vector{ cores.front() });
        EXPECT_THAT(log.lines(),
                    ElementsAre(HasSubstr("worker: avoiding core 8190 has no effect"),
                                HasSubstr("worker: core " + std::to_string(cores.front()) + " cannot be avoided")));
    });
}

} // namespace
} // namespace filament_core::jobs
