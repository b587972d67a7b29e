// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobTrace.h"

#include "jobsystem/Affinity.h"
#include "tests/jobsystem/FakeRoot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <atomic>
#include <map>
#include <sstream>
#include <thread>
#include <vector>

namespace filament_core::jobs {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string written(std::vector<TraceTrack> const& tracks) {
    std::ostringstream out;
    writeChromeTrace(tracks, out);
    return out.str();
}

std::vector<std::string> namesOf(TraceTrack const& track) {
    std::vector<std::string> names;
    for (TraceEvent const& event : track.events) names.emplace_back(event.name);
    return names;
}

TEST(JobTrace, HasNoTracksBeforeAnythingHappens) {
    JobTrace trace(4);
    trace.nameSeat(0, "worker 0");
    trace.track("driver");
    EXPECT_THAT(trace.snapshot(), IsEmpty());
    EXPECT_THAT(json::parse(written({}))["traceEvents"], IsEmpty());
}

TEST(JobTrace, KeepsWhatItWasToldInTheOrderOfSeatsAndThenOfTracks) {
    JobTrace trace(3);
    trace.nameSeat(2, "worker 2");
    const JobTrace::Track driver = trace.track("driver");
    trace.span(driver, "replay", 100, 900, 17);
    trace.recordJob(2, "cull", 10, 30, true);
    trace.recordJob(0, "skin", 5, 6, false);
    EXPECT_EQ(trace.track("driver"), driver);
    EXPECT_NE(trace.track("app"), driver);

    const std::vector<TraceTrack> tracks = trace.snapshot();
    ASSERT_EQ(tracks.size(), 3u);
    EXPECT_EQ(tracks[0].name, "seat 0");
    EXPECT_EQ(tracks[1].name, "worker 2");
    EXPECT_EQ(tracks[2].name, "driver");
    TraceEvent const& cull = tracks[1].events.at(0);
    EXPECT_STREQ(cull.name, "cull");
    EXPECT_EQ(cull.begin, 10);
    EXPECT_EQ(cull.end, 30);
    EXPECT_EQ(cull.kind, TraceEvent::Kind::StolenJob);
    EXPECT_EQ(cull.frame, -1);
    EXPECT_EQ(tracks[0].events.at(0).kind, TraceEvent::Kind::Job);
    EXPECT_EQ(tracks[2].events.at(0).kind, TraceEvent::Kind::Span);
    EXPECT_EQ(tracks[2].events.at(0).frame, 17);
}

TEST(JobTrace, PutsAJobBeforeThoseItRanWhileItWaited) {
    JobTrace trace(1);
    trace.recordJob(0, "first child", 10, 20, false);
    trace.recordJob(0, "second child", 20, 40, false);
    trace.recordJob(0, "only thing in its parent", 10, 40, false);
    trace.recordJob(0, "parent", 10, 40, false);
    trace.recordJob(0, "earlier", 5, 7, false);
    EXPECT_THAT(namesOf(trace.snapshot()[0]),
                ElementsAre("earlier", "parent", "only thing in its parent", "first child", "second child"));
}

TEST(JobTrace, PutsASpanBeforeThoseItContainsInWhateverOrderTheyWereTold) {
    JobTrace trace(0);
    const JobTrace::Track track = trace.track("app");
    trace.span(track, "frame", 10, 90);
    trace.span(track, "prepare", 10, 50);
    trace.span(track, "start", 0, 10);
    EXPECT_THAT(namesOf(trace.snapshot()[0]), ElementsAre("start", "frame", "prepare"));
}

TEST(JobTrace, DropsTheOldestAndCountsThem) {
    constexpr uint32_t kEvents = 16;
    JobTrace trace(1, kEvents);
    const JobTrace::Track track = trace.track("app");
    for (int64_t i = 0; i < 100; ++i) {
        trace.recordJob(0, "job", i, i + 1, false);
        if (i < 15) trace.span(track, "phase", i, i);
    }
    const std::vector<TraceTrack> tracks = trace.snapshot();
    ASSERT_EQ(tracks.size(), 2u);
    ASSERT_EQ(tracks[0].events.size(), kEvents - 1);
    EXPECT_EQ(tracks[0].events.front().begin, 85);
    EXPECT_EQ(tracks[0].events.back().begin, 99);
    EXPECT_EQ(tracks[0].dropped, 85u);
    EXPECT_EQ(tracks[1].events.size(), 15u);
    EXPECT_EQ(tracks[1].dropped, 0u);
    EXPECT_EQ(json::parse(written(tracks))["otherData"]["droppedEvents"], 85);
}

// Every field of event i follows from i, so a mixture of two events is detected. Also for the thread sanitizer. The
// smallest rings are overwritten fastest; larger ones give longer copies.
class JobTraceRace : public testing::TestWithParam<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Capacity, JobTraceRace, testing::Values(2, 8, 64), testing::PrintToStringParamName());

TEST_P(JobTraceRace, NeverShowsTornEventsToAReaderWhileJobsAreRecorded) {
    static constexpr std::array<const char*, 3> kNames{ "a", "b", "c" };
    JobTrace trace(2, GetParam());
    std::atomic<bool> stop = false;
    std::array<int64_t, 2> recorded{};
    std::vector<std::thread> writers;
    for (uint32_t seat = 0; seat < 2; ++seat) {
        writers.emplace_back([&trace, &stop, &count = recorded[seat], seat] {
            int64_t i = 0;
            for (; !stop.load(std::memory_order_relaxed) || i < 1000; ++i)
                trace.recordJob(seat, kNames[static_cast<size_t>(i % 3)], i, i * 3, i % 2 == 0);
            count = i;
        });
    }
    std::map<std::string, uint64_t> dropped;
    const auto check = [&] {
        for (TraceTrack const& track : trace.snapshot()) {
            EXPECT_GE(track.dropped, dropped[track.name]);
            dropped[track.name] = track.dropped;
            int64_t expected = static_cast<int64_t>(track.dropped);
            for (TraceEvent const& event : track.events) {
                ASSERT_EQ(event.begin, expected);
                ASSERT_EQ(event.end, expected * 3);
                ASSERT_STREQ(event.name, kNames[static_cast<size_t>(expected % 3)]);
                ASSERT_EQ(event.kind == TraceEvent::Kind::StolenJob, expected % 2 == 0);
                ++expected;
            }
        }
    };
    constexpr uint64_t kOverwritten = 300'000; // some ms of both, so that they run at the same time as this thread
    while ((dropped["seat 0"] < kOverwritten || dropped["seat 1"] < kOverwritten) && !HasFailure()) check();
    stop = true;
    for (std::thread& writer : writers) writer.join();
    check();
    EXPECT_EQ(dropped["seat 0"], static_cast<uint64_t>(recorded[0]) - (GetParam() - 1));
    EXPECT_EQ(dropped["seat 1"], static_cast<uint64_t>(recorded[1]) - (GetParam() - 1));
}

TEST(JobTrace, TakesSpansOfOneTrackFromManyThreads) {
    JobTrace trace(0);
    std::vector<std::thread> threads;
    for (int thread = 0; thread < 4; ++thread) {
        threads.emplace_back([&] {
            for (int i = 0; i < 1000; ++i) trace.span(trace.track("app"), "phase", i, i + 1);
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(trace.snapshot().at(0).events.size(), 4000u);
}

TEST(JobTrace, PutsJobsOfThreadsWithoutASeatOnTracksOfTheirNames) {
    JobTrace trace(1);
    for (const char* name : { "loader", "decoder", "loader" }) {
        std::thread([&] {
            nameThisThread(name);
            trace.recordJobHere("decode", 1, 2, true);
        }).join();
    }
    const std::vector<TraceTrack> tracks = trace.snapshot();
    ASSERT_EQ(tracks.size(), 2u);
    EXPECT_EQ(tracks[0].name, "loader");
    EXPECT_EQ(tracks[0].events.size(), 2u);
    EXPECT_EQ(tracks[0].events.at(0).kind, TraceEvent::Kind::StolenJob);
    EXPECT_EQ(tracks[1].name, "decoder");
}

TEST(JobTrace, KeepsTheThreadsOfTwoTracesApart) {
    JobTrace first(0), second(0);
    second.track("occupies the first number");
    std::thread([&] {
        nameThisThread("shared");
        for (int i = 0; i < 3; ++i) {
            first.recordJobHere("a", 1, 2, false);
            second.recordJobHere("b", 1, 2, false);
        }
    }).join();
    for (JobTrace const* trace : { &first, &second }) {
        const std::vector<TraceTrack> tracks = trace->snapshot();
        ASSERT_EQ(tracks.size(), 1u);
        EXPECT_EQ(tracks[0].name, "shared");
        EXPECT_EQ(tracks[0].events.size(), 3u);
    }
}

TEST(JobTraceDeathTest, RefusesSpansThatEndBeforeTheyBegin) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    JobTrace trace(0);
    EXPECT_DEATH(trace.span(trace.track("app"), "phase", 2, 1), "a span ends after it has begun");
    EXPECT_DEATH(trace.span(7, "phase", 1, 2), "a track that JobTrace::track\\(\\) gave");
    EXPECT_DEATH(JobTrace(1, 100), "a power of two");
}

// ---------------------------------------------------------------------------------------------- the file

TEST(ChromeTrace, HasAThreadForEachTrackAndACompleteEventForEachJob) {
    const TraceTrack worker{ "worker 0",
                             { { "cull", 1'000'123, 1'002'623, TraceEvent::Kind::Job },
                               { "skin", 1'003'000, 1'003'000, TraceEvent::Kind::StolenJob } } };
    const TraceTrack driver{ "driver",
                             { { "replay", 1'000'000, 5'000'007, TraceEvent::Kind::Span, 3 },
                               { "idle", 6'000'000, 6'000'001, TraceEvent::Kind::Span } } };
    const json file = json::parse(written({ worker, driver }));
    EXPECT_EQ(file["displayTimeUnit"], "ns");
    json const& events = file["traceEvents"];
    ASSERT_EQ(events.size(), 8u);
    EXPECT_EQ(events[0], json::parse(R"({"ph":"M","pid":1,"tid":1,"name":"thread_name","args":{"name":"worker 0"}})"));
    EXPECT_EQ(events[1],
              json::parse(R"({"ph":"M","pid":1,"tid":1,"name":"thread_sort_index","args":{"sort_index":1}})"));
    EXPECT_EQ(events[2], json::parse(R"({"ph":"X","pid":1,"tid":1,"cat":"job","name":"cull","ts":0.123,"dur":2.5,
                                         "args":{"stolen":false}})"));
    EXPECT_EQ(events[3], json::parse(R"({"ph":"X","pid":1,"tid":1,"cat":"job","name":"skin","ts":3.0,"dur":0.0,
                                         "args":{"stolen":true}})"));
    EXPECT_EQ(events[4]["args"]["name"], "driver");
    EXPECT_EQ(events[6], json::parse(R"({"ph":"X","pid":1,"tid":2,"cat":"span","name":"replay","ts":0.0,"dur":4000.007,
                                         "args":{"frame":3}})"));
    EXPECT_EQ(events[7]["args"], json::object());
}

// A double has 53 bits: nanoseconds of 200 days, written as microseconds, would lose their last digits.
TEST(ChromeTrace, WritesTimesOfLongRunsExactly) {
    const TraceTrack track{ "worker",
                            { { "first", 0, 1 }, { "last", 17'280'000'123'456'789, 17'280'000'123'456'790 } } };
    const std::string text = written({ track });
    EXPECT_THAT(text, HasSubstr(R"("ts":17280000123456.789,"dur":0.001)"));
}

TEST(ChromeTrace, EscapesNamesAndReplacesBytesThatAreNotUtf8) {
    const std::array<std::pair<const char*, std::string>, 9> cases{ {
            { "quote \" slash \\ tab \t bell \a", "quote \" slash \\ tab \t bell \a" },
            { "w\xc3\xb6rker \xe2\x82\xac \xf0\x9f\x8e\xa8", "w\xc3\xb6rker \xe2\x82\xac \xf0\x9f\x8e\xa8" },
            { "cut \xe2\x82", "cut \xef\xbf\xbd\xef\xbf\xbd" },
            { "overlong \xc0\xaf", "overlong \xef\xbf\xbd\xef\xbf\xbd" },
            { "\xe0\x80\xaf", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd" },
            { "\xed\xa0\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd" },                 // half of a UTF-16 pair
            { "\xf4\x90\x80\x80", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd" }, // beyond U+10FFFF
            { "\xff", "\xef\xbf\xbd" },
            { "", "" },
    } };
    for (auto const& [name, expected] : cases) {
        const json events = json::parse(written({ { name, { { name, 0, 1 } } } }))["traceEvents"];
        EXPECT_EQ(events[0]["args"]["name"], expected);
        EXPECT_EQ(events[2]["name"], expected);
    }
}

TEST(ChromeTrace, WritesTheSameBytesForTheSameTracks) {
    JobTrace trace(2);
    for (int64_t i = 0; i < 100; ++i)
        trace.recordJob(static_cast<uint32_t>(i % 2), "job", i * i % 97, i * i % 97 + i, i % 3 == 0);
    EXPECT_EQ(written(trace.snapshot()), written(trace.snapshot()));
}

TEST(ChromeTrace, WritesAFile) {
    const FakeRoot folder;
    const TraceTrack track{ "worker", { { "job", 0, 1 } } };
    ASSERT_TRUE(writeChromeTrace({ track }, folder.path() / "trace.json").ok());
    std::ostringstream text;
    text << std::ifstream(folder.path() / "trace.json").rdbuf();
    EXPECT_EQ(text.str(), written({ track }));
}

TEST(ChromeTrace, NamesTheFileThatCannotBeWritten) {
    const TraceTrack track{ "worker", { { "job", 0, 1 } } };
    const Result<void> missing = writeChromeTrace({ track }, "/no/such/folder/trace.json");
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, ErrorCode::Unreadable);
    EXPECT_THAT(missing.error().message, HasSubstr("'/no/such/folder/trace.json': No such file or directory"));
    const Result<void> full = writeChromeTrace({ track }, "/dev/full");
    ASSERT_FALSE(full.ok());
    EXPECT_THAT(full.error().message, HasSubstr("'/dev/full': No space left on device"));
}

} // namespace
} // namespace filament_core::jobs
