// SPDX-License-Identifier: Apache-2.0
// Whole job systems under affinity policies, and their timelines.
#include "base/Log.h"
#include "jobsystem/Affinity.h"
#include "jobsystem/JobSystem.h"
#include "jobsystem/JobTrace.h"
#include "jobsystem/Topology.h"
#include "tests/jobsystem/OwnThread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace filament_core::jobs {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSubsetOf;
using ::testing::SizeIs;

class QuietLog {
public:
    QuietLog() : mPrevious(setLogSink([](Severity, std::string_view) {})) {}
    ~QuietLog() { setLogSink(std::move(mPrevious)); }

private:
    LogSink mPrevious;
};

// Holds every worker in a job at the same time and reads the cores of each.
std::vector<std::vector<int>> coresOfWorkers(JobSystem& jobs) {
    std::mutex mutex;
    std::vector<std::vector<int>> cores;
    std::atomic<uint32_t> arrived = 0;
    const std::thread::id caller = std::this_thread::get_id();
    JobGroup group(jobs);
    for (uint32_t i = 0; i < jobs.workerCount(); ++i) {
        group.run([&] {
            ASSERT_NE(std::this_thread::get_id(), caller);
            {
                const std::lock_guard lock(mutex);
                cores.push_back(coresOfThisThread());
            }
            ++arrived;
            while (arrived < jobs.workerCount()) std::this_thread::yield();
        });
    }
    while (arrived < jobs.workerCount()) std::this_thread::yield(); // the caller takes none of them
    group.wait();
    return cores;
}

int64_t sumOfSquares(JobSystem& jobs, int64_t count) {
    std::atomic<int64_t> sum = 0;
    parallelFor<"squares">(jobs, static_cast<size_t>(count), 16, [&](size_t begin, size_t end) {
        int64_t part = 0;
        for (size_t i = begin; i < end; ++i) part += static_cast<int64_t>(i * i);
        sum += part;
    });
    return sum;
}

constexpr int64_t squaresBelow(int64_t n) { return (n - 1) * n * (2 * n - 1) / 6; }

// ---------------------------------------------------------------------------------------------- affinity

TEST(PlacedSystem, WithoutAPolicyLetsWorkersRunWhereTheirMakerMay) {
    JobSystem jobs({ .workers = 2 });
    EXPECT_THAT(coresOfWorkers(jobs), Each(coresOfThisThread()));
}

TEST(PlacedSystem, PinsEveryWorkerToOneCoreOfItsMaker) {
    const QuietLog quiet;
    JobSystem jobs({ .workers = 3, .affinity = AffinityPolicy::pin() });
    const std::vector<std::vector<int>> cores = coresOfWorkers(jobs);
    EXPECT_THAT(cores, Each(SizeIs(1)));
    EXPECT_EQ(std::set(cores.begin(), cores.end()).size(), std::min<size_t>(3, coresOfThisThread().size()));
    for (std::vector<int> const& one : cores) EXPECT_THAT(one, IsSubsetOf(coresOfThisThread()));
}

// The handles of a system's workers, for a change of their cores from outside.
std::vector<pthread_t> threadsOfWorkers(JobSystem& jobs) {
    std::vector<pthread_t> threads;
    std::mutex mutex;
    std::atomic<uint32_t> arrived = 0;
    JobGroup group(jobs);
    for (uint32_t i = 0; i < jobs.workerCount(); ++i) {
        group.run([&] {
            {
                const std::lock_guard lock(mutex);
                threads.push_back(pthread_self());
            }
            ++arrived;
            while (arrived < jobs.workerCount()) std::this_thread::yield();
        });
    }
    while (arrived < jobs.workerCount()) std::this_thread::yield();
    group.wait();
    return threads;
}

TEST(PlacedSystem, WorkersTakeTheirCoresAgainAfterAWaitIfThePolicySaysSo) {
    if (coresOfThisThread().size() < 2) GTEST_SKIP() << "needs two cores";
    for (const bool repins : { false, true }) {
        AffinityPolicy policy = AffinityPolicy::pin();
        policy.repinsAfterWaits = repins;
        JobSystem jobs({ .workers = 1, .affinity = policy });
        const std::vector<int> own = coresOfWorkers(jobs).front();
        const pthread_t worker = threadsOfWorkers(jobs).front();
        cpu_set_t all;
        CPU_ZERO(&all);
        for (int core : coresOfThisThread()) CPU_SET(static_cast<size_t>(core), &all);
        ASSERT_EQ(pthread_setaffinity_np(worker, sizeof(all), &all), 0);
        std::vector<int> after;
        for (int round = 0; round < 100 && (round == 0 || (repins && after != own)); ++round) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20)); // longer than a worker searches before it waits
            after = coresOfWorkers(jobs).front();
        }
        if (repins)
            EXPECT_EQ(after, own);
        else
            EXPECT_EQ(after, coresOfThisThread());
    }
}

TEST(PlacedSystem, PinsTwoSystemsToDifferentCoresAndGivesThemBack) {
    if (coresOfThisThread().size() < 2) GTEST_SKIP() << "needs two cores";
    for (int round = 0; round < 3; ++round) {
        JobSystem first({ .workers = 1, .affinity = AffinityPolicy::pin() });
        JobSystem second({ .workers = 1, .affinity = AffinityPolicy::pin() });
        EXPECT_NE(coresOfWorkers(first), coresOfWorkers(second)) << "round " << round;
    }
}

TEST(PlacedSystem, KeepsWorkersOffAnAvoidedCore) {
    std::vector<int> cores = coresOfThisThread();
    if (cores.size() < 2) GTEST_SKIP() << "needs two cores";
    JobSystem jobs({ .workers = 2, .affinity = AffinityPolicy::avoid(cores.front()) });
    cores.erase(cores.begin());
    EXPECT_THAT(coresOfWorkers(jobs), Each(cores));
}

TEST(PlacedSystem, WorksWithOneCore) {
    const std::vector<int> cores = coresOfThisThread();
    onOwnThread([&] {
        const QuietLog quiet;
        ASSERT_TRUE(pinThisThread(cores.back()));
        EXPECT_EQ(JobSystem().workerCount(), 0u);
        const std::vector policies{ AffinityPolicy::none(), AffinityPolicy::pin(), AffinityPolicy::bigCores(),
                                    AffinityPolicy::avoid(cores.back()) };
        for (AffinityPolicy const& policy : policies) {
            JobSystem jobs({ .workers = 3, .affinity = policy });
            EXPECT_EQ(sumOfSquares(jobs, 10'000), squaresBelow(10'000));
            EXPECT_THAT(coresOfWorkers(jobs), Each(ElementsAre(cores.back())));
        }
    });
}

TEST(PlacedSystem, WorksWith256PinnedWorkers) {
    const QuietLog quiet;
    JobSystem jobs({ .workers = 256, .affinity = AffinityPolicy::pin() });
    for (int round = 0; round < 10; ++round) EXPECT_EQ(sumOfSquares(jobs, 100'000), squaresBelow(100'000));
}

TEST(PlacedSystem, LetsBackgroundThreadsOfPinnedWorkersRunAnywhere) {
    const QuietLog quiet;
    const std::vector<int> cores = coresOfThisThread();
    JobSystem jobs({ .workers = 2, .affinity = AffinityPolicy::pin() });
    std::vector<int> background;
    JobGroup group(jobs);
    group.run([&] { // a worker or this thread starts the background thread
        JobGroup decoding(jobs);
        decoding.runBackground([&] { background = coresOfThisThread(); });
        decoding.wait();
    });
    group.wait();
    EXPECT_EQ(background, cores);
}

// ---------------------------------------------------------------------------------------------- timeline

struct Timeline {
    std::map<std::string, size_t> jobs; // how often each name ran
    std::set<std::string> tracks;
    size_t stolen = 0;
};

// The rules of every timeline: jobs of one track are disjoint or nested.
Timeline checked(std::vector<TraceTrack> const& tracks) {
    Timeline timeline;
    for (TraceTrack const& track : tracks) {
        timeline.tracks.insert(track.name);
        EXPECT_EQ(track.dropped, 0u);
        std::vector<int64_t> open;
        for (TraceEvent const& event : track.events) {
            EXPECT_LE(event.begin, event.end);
            while (!open.empty() && open.back() <= event.begin) open.pop_back();
            EXPECT_TRUE(open.empty() || event.end <= open.back()) << event.name << " overlaps on " << track.name;
            open.push_back(event.end);
            ++timeline.jobs[event.name];
            timeline.stolen += event.kind == TraceEvent::Kind::StolenJob;
        }
    }
    return timeline;
}

class TracedSystem : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, TracedSystem, testing::Values(0, 1, 2, 16), testing::PrintToStringParamName());

TEST_P(TracedSystem, HasEveryJobOnceWithItsName) {
    JobSystem jobs({ .workers = GetParam(), .threadName = "hand", .trace = true });
    const int64_t before = JobTrace::now();
    {
        const AdoptedThread seat(jobs);
        JobGroup group(jobs), next(jobs);
        for (int i = 0; i < 100; ++i) {
            group.run<"outer">([&] {
                JobGroup inner(jobs);
                for (int j = 0; j < 5; ++j) inner.run<"inner">([] {});
                inner.wait();
            });
        }
        group.then<"after">(next, [] {});
        group.runBackground<"decode">([] {});
        group.wait();
        next.wait();
    }
    const Timeline timeline = checked(jobs.trace()->snapshot());
    EXPECT_EQ(timeline.jobs.at("outer"), 100u);
    EXPECT_EQ(timeline.jobs.at("inner"), 500u);
    EXPECT_EQ(timeline.jobs.at("after"), 1u);
    EXPECT_EQ(timeline.jobs.at("decode"), 1u);
    EXPECT_EQ(timeline.tracks.contains("hand bg 0"), GetParam() > 0);
    for (TraceTrack const& track : jobs.trace()->snapshot()) EXPECT_GE(track.events.front().begin, before);
}

TEST_P(TracedSystem, ShowsTheCallersPartOfALoopOnTheCallersTrack) {
    onOwnThread([this] {
        nameThisThread("the caller");
        JobSystem jobs({ .workers = GetParam(), .trace = true });
        EXPECT_EQ(sumOfSquares(jobs, 10'000), squaresBelow(10'000));
        const Timeline timeline = checked(jobs.trace()->snapshot());
        EXPECT_GE(timeline.jobs.at("squares"), 1u);
        EXPECT_TRUE(timeline.tracks.contains("the caller"));
    });
}

TEST_P(TracedSystem, CanBeReadWhileWorkersRun) {
    JobSystem jobs({ .workers = GetParam(), .trace = true });
    std::atomic<bool> stop = false;
    std::thread reader([&] {
        while (!stop) {
            for (TraceTrack const& track : jobs.trace()->snapshot()) {
                for (TraceEvent const& event : track.events) ASSERT_STREQ(event.name, "squares");
            }
        }
    });
    for (int round = 0; round < 100; ++round) EXPECT_EQ(sumOfSquares(jobs, 2'000), squaresBelow(2'000));
    stop = true;
    reader.join();
}

TEST(TracedSystem, SaysWhichJobsWereStolen) {
    JobSystem jobs({ .workers = 1, .trace = true });
    const AdoptedThread seat(jobs);
    std::atomic<bool> started = false;
    JobGroup group(jobs);
    group.run<"stolen">([&] { started = true; });
    while (!started) std::this_thread::yield(); // so the worker must have taken it
    group.wait();
    EXPECT_EQ(checked(jobs.trace()->snapshot()).stolen, 1u);
}

TEST(TracedSystem, HasNoTraceUnlessAskedForOne) { EXPECT_EQ(JobSystem({ .workers = 1 }).trace(), nullptr); }

} // namespace
} // namespace filament_core::jobs
