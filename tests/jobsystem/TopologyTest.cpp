// SPDX-License-Identifier: Apache-2.0
// Other machines, described by hwloc's synthetic topologies and exported as XML.
#include "jobsystem/Topology.h"

#include "jobsystem/Affinity.h"
#include "tests/jobsystem/FakeMachine.h"
#include "tests/jobsystem/FakeRoot.h"

#include <gtest/gtest.h>

#include <atomic>
#include <dlfcn.h>
#include <hwloc.h>
#include <latch>
#include <limits>
#include <set>
#include <thread>
#include <vector>

static std::atomic<int> sLoads = 0;

// Replaces hwloc's function in this program, and counts the calls.
extern "C" int hwloc_topology_load(hwloc_topology_t topology) {
    static const auto load = reinterpret_cast<int (*)(hwloc_topology_t)>(dlsym(RTLD_NEXT, "hwloc_topology_load"));
    ++sLoads;
    return load(topology);
}

namespace filament_core::jobs {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

template <class Field>
std::vector<int> column(Topology const& topology, Field field) {
    std::vector<int> values;
    for (Cpu const& cpu : topology.cpus) values.push_back(cpu.*field);
    return values;
}

std::vector<int> firstCores(int count) {
    std::vector<int> cores;
    for (int i = 0; i < count; ++i) cores.push_back(i);
    return cores;
}

TEST(UsableThreads, IsTheWholePartOfTheLesserOfCoresAndQuotaButOneAtLeast) {
    EXPECT_EQ(usableThreads(8, kUnlimited), 8u);
    EXPECT_EQ(usableThreads(8, 2.9), 2u);
    EXPECT_EQ(usableThreads(2, 6.0), 2u);
    EXPECT_EQ(usableThreads(4, 0.5), 1u);
    EXPECT_EQ(usableThreads(1, kUnlimited), 1u);
}

TEST(CpuBudget, CombinesTheAffinityMaskAndTheQuota) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", "31 23 0:26 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n");
    root.write("proc/self/cgroup", "0::/\n");
    root.write("sys/fs/cgroup/cpu.max", "350000 100000");
    const CpuBudget budget = readCpuBudget({ .root = root.path(), .cores = { 1, 2, 5, 7, 9 } });
    EXPECT_EQ(budget.cores, (std::vector{ 1, 2, 5, 7, 9 }));
    EXPECT_EQ(budget.quota, 3.5);
    EXPECT_EQ(budget.usableThreads, 3u);
}

TEST(Topology, OfThisMachineListsTheAffinityMaskOnceEach) {
    const Topology topology = readTopology();
    EXPECT_EQ(column(topology, &Cpu::index), coresOfThisThread());
    EXPECT_EQ(topology.usableThreads, readCpuBudget().usableThreads);
    EXPECT_LE(topology.usableThreads, topology.cpus.size());
    std::set<std::pair<int, int>> places;
    for (Cpu const& cpu : topology.cpus) places.insert({ cpu.physicalCore, cpu.smtRank });
    EXPECT_EQ(places.size(), topology.cpus.size()) << "two processors in one place";
}

TEST(Topology, OfAThreadWithOneCoreIsOneCore) {
    const std::vector<int> cores = coresOfThisThread();
    std::thread([&] {
        ASSERT_TRUE(pinThisThread(cores.back()));
        const Topology topology = readTopology();
        EXPECT_EQ(column(topology, &Cpu::index), std::vector{ cores.back() });
        EXPECT_EQ(topology.cpus[0].physicalCore, 0);
        EXPECT_EQ(topology.cpus[0].smtRank, 0);
        EXPECT_EQ(topology.usableThreads, 1u);
        EXPECT_EQ(defaultWorkerCount(AffinityPolicy::none()), 0u);
    }).join();
    EXPECT_EQ(coresOfThisThread(), cores) << "a thread is restricted, not the process";
}

/// How often this process has loaded the machine's description after eight threads have requested it together; -1 if
/// their answers differ.
int loadsForThreadsThatAskTogether() {
    std::vector<Topology> seen(8);
    std::latch start(std::ssize(seen));
    std::vector<std::thread> threads;
    for (Topology& topology : seen) {
        threads.emplace_back([&] {
            start.arrive_and_wait();
            topology = readTopology();
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (Topology const& topology : seen)
        if (column(topology, &Cpu::physicalCore) != column(seen[0], &Cpu::physicalCore)) return -1;
    return sLoads;
}

// In a separate process, without an earlier request.
TEST(TopologyDeathTest, LoadsOnceForThreadsThatAskTogether) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(std::_Exit(loadsForThreadsThatAskTogether()), testing::ExitedWithCode(1), "");
}

// Two caches, each with two cores of two hardware threads.
TEST(Topology, TellsHardwareThreadsCoresAndCachesApart) {
    const std::string xml = FakeMachine("pack:1 l3:2 core:2 pu:2").xml();
    const Topology topology = readTopology({ .cores = firstCores(8), .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::physicalCore), (std::vector{ 0, 0, 1, 1, 2, 2, 3, 3 }));
    EXPECT_EQ(column(topology, &Cpu::smtRank), (std::vector{ 0, 1, 0, 1, 0, 1, 0, 1 }));
    EXPECT_EQ(column(topology, &Cpu::cacheGroup), (std::vector{ 0, 0, 0, 0, 1, 1, 1, 1 }));
    EXPECT_EQ(column(topology, &Cpu::efficiencyClass), std::vector<int>(8, 0));
}

TEST(Topology, NumbersOnlyWhatTheAffinityMaskLeaves) {
    const std::string xml = FakeMachine("pack:1 l3:2 core:2 pu:2").xml();
    const Topology topology = readTopology({ .cores = { 3, 6, 7 }, .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::index), (std::vector{ 3, 6, 7 }));
    EXPECT_EQ(column(topology, &Cpu::physicalCore), (std::vector{ 0, 1, 1 }));
    EXPECT_EQ(column(topology, &Cpu::smtRank), (std::vector{ 0, 0, 1 })) << "3 is what is left of its core";
    EXPECT_EQ(column(topology, &Cpu::cacheGroup), (std::vector{ 0, 1, 1 }));
}

TEST(Topology, GroupsByTheSecondCacheWhereThereIsNoThird) {
    const std::string xml = FakeMachine("pack:1 l2:2 core:2 pu:1").xml();
    const Topology topology = readTopology({ .cores = firstCores(4), .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::cacheGroup), (std::vector{ 0, 0, 1, 1 }));
}

TEST(Topology, RanksTheClassesOfAHybridMachine) {
    const std::string xml = FakeMachine("pack:1 l3:1 core:4 pu:1")
                                    .kind({ 0, 1 }, { { "CoreType", "IntelAtom" }, { "FrequencyMaxMHz", "3600" } })
                                    .kind({ 2, 3 }, { { "CoreType", "IntelCore" }, { "FrequencyMaxMHz", "5100" } })
                                    .xml();
    const Topology topology = readTopology({ .cores = firstCores(4), .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::maxMegahertz), (std::vector{ 3600, 3600, 5100, 5100 }));
    EXPECT_GT(topology.cpus[2].efficiencyClass, topology.cpus[0].efficiencyClass);
    EXPECT_EQ(topology.cpus[2].efficiencyClass, topology.cpus[3].efficiencyClass);
}

// hwloc gives up ranking if one kind reports nothing; then the known frequency decides.
TEST(Topology, RanksClassesByFrequencyWhereHwlocDoesNot) {
    const std::string xml = FakeMachine("pack:1 l3:1 core:4 pu:1")
                                    .kind({ 0, 3 }, { { "FrequencyMaxMHz", "2400" } })
                                    .kind({ 1, 2 }, { { "Colour", "blue" } })
                                    .xml();
    const Topology topology = readTopology({ .cores = firstCores(4), .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::efficiencyClass), (std::vector{ 1, 0, 0, 1 }));
}

TEST(Topology, TakesAProcessorThatTheMachineDoesNotListForACoreOfItsOwn) {
    const std::string xml = FakeMachine("pack:1 l3:1 core:1 pu:2").xml();
    const Topology topology = readTopology({ .cores = { 0, 1, 40, 41 }, .hwlocXml = xml });
    EXPECT_EQ(column(topology, &Cpu::index), (std::vector{ 0, 1, 40, 41 }));
    EXPECT_EQ(column(topology, &Cpu::physicalCore), (std::vector{ 0, 0, 1, 2 }));
    EXPECT_EQ(column(topology, &Cpu::cacheGroup), (std::vector{ 0, 0, 0, 0 }));
}

TEST(Topology, SurvivesADescriptionThatHwlocRefuses) {
    const Topology topology = readTopology({ .cores = { 0, 1 }, .hwlocXml = "<no topology>" });
    EXPECT_EQ(column(topology, &Cpu::physicalCore), (std::vector{ 0, 1 }));
    EXPECT_EQ(column(topology, &Cpu::efficiencyClass), (std::vector{ 0, 0 }));
}

TEST(RangesOf, JoinsNeighbours) {
    EXPECT_EQ(rangesOf({}), "");
    EXPECT_EQ(rangesOf(std::vector{ 3 }), "3");
    EXPECT_EQ(rangesOf(std::vector{ 0, 1, 2, 3, 8, 10, 11 }), "0-3,8,10-11");
}

} // namespace
} // namespace filament_core::jobs
