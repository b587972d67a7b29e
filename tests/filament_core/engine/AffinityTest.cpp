// SPDX-License-Identifier: Apache-2.0
// Where an engine's threads run: missing cores are refused, and two engines do not share pins.
#include <filament_core/Engine.h>

#include "filament_core/engine/EngineImpl.h"
#include "jobsystem/Topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace filament_core {
namespace {

using ::testing::HasSubstr;

// The cores of every worker; each worker is held in a job until all have reported.
std::set<std::vector<int>> coresOfWorkers(Engine& engine) {
    jobs::JobSystem& jobs = engine.impl().jobs;
    std::vector<std::vector<int>> cores(jobs.workerCount());
    std::atomic<uint32_t> arrived = 0;
    jobs::JobGroup group(jobs);
    for (uint32_t i = 0; i < jobs.workerCount(); ++i) {
        group.run([&, i] {
            cores[i] = jobs::coresOfThisThread();
            ++arrived;
            while (arrived < jobs.workerCount()) std::this_thread::yield();
        });
    }
    while (arrived < jobs.workerCount()) std::this_thread::yield();
    group.wait();
    return { cores.begin(), cores.end() };
}

TEST(EngineAffinity, RefusesCoresThatTheProcessMayNotUse) {
    const int missing = jobs::coresOfThisThread().back() + 1;
    for (int core : { missing, -2 }) {
        for (bool driver : { true, false }) {
            EngineOptions options{ .backend = Backend::Null };
            (driver ? options.driverCore : options.avoidCore) = core;
            const Result<Engine> engine = Engine::create(options);
            ASSERT_FALSE(engine.ok());
            EXPECT_EQ(engine.error().code, ErrorCode::InvalidArgument);
            EXPECT_THAT(engine.error().message,
                        HasSubstr(driver ? "EngineOptions::driverCore" : "EngineOptions::avoidCore"));
            EXPECT_THAT(engine.error().message, HasSubstr("core " + std::to_string(core)));
        }
    }
}

TEST(EngineAffinity, KeepsWorkersOffTheDriversCoreAndTheAvoidedOne) {
    std::vector<int> cores = jobs::coresOfThisThread();
    if (cores.size() < 2) GTEST_SKIP() << "needs two cores";
    const int driverCore = cores.back();
    cores.pop_back();
    for (ThreadAffinity affinity : { ThreadAffinity::None, ThreadAffinity::Pin }) {
        Result<Engine> engine = Engine::create(
                { .backend = Backend::Null, .workers = 1, .affinity = affinity, .driverCore = driverCore });
        ASSERT_TRUE(engine.ok());
        for (std::vector<int> const& own : coresOfWorkers(*engine)) EXPECT_THAT(own, testing::IsSubsetOf(cores));
    }
    Result<Engine> engine = Engine::create({ .backend = Backend::Null, .workers = 1, .avoidCore = driverCore });
    ASSERT_TRUE(engine.ok());
    EXPECT_EQ(coresOfWorkers(*engine), (std::set{ cores }));
}

TEST(EngineAffinity, PinsWorkersAwayFromAnotherEnginesDriver) {
    const std::vector<int> cores = jobs::coresOfThisThread();
    if (cores.size() < 2) GTEST_SKIP() << "needs two cores";
    for (int driverCore : cores) {
        Result<Engine> driving = Engine::create({ .backend = Backend::Null, .workers = 0, .driverCore = driverCore });
        Result<Engine> pinned =
                Engine::create({ .backend = Backend::Null, .workers = 1, .affinity = ThreadAffinity::Pin });
        ASSERT_TRUE(driving.ok() && pinned.ok());
        for (std::vector<int> const& own : coresOfWorkers(*pinned)) {
            EXPECT_EQ(own.size(), 1u);
            EXPECT_NE(own, std::vector{ driverCore });
        }
    }
}

TEST(EngineAffinity, PinsTwoEnginesToDifferentCores) {
    if (jobs::coresOfThisThread().size() < 2) GTEST_SKIP() << "needs two cores";
    const EngineOptions options{ .backend = Backend::Null, .workers = 1, .affinity = ThreadAffinity::Pin };
    Result<Engine> first = Engine::create(options), second = Engine::create(options);
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_NE(coresOfWorkers(*first), coresOfWorkers(*second));
}

} // namespace
} // namespace filament_core
