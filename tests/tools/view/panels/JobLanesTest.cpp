// SPDX-License-Identifier: Apache-2.0
// Spans of threads as lanes: rows of what contains each other, what a window shows, and how the window moves.
#include "tools/view/panels/JobLanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace filament_core::view {
namespace {

JobSpan span(const char* name, double begin, double end, int64_t frame = -1) {
    return { name, begin, end, frame < 0 ? JobSpan::Kind::Job : JobSpan::Kind::Phase, frame };
}

JobLanes lanesOf(std::vector<JobSpan> spans) {
    const JobTrack track{ .name = "worker 0", .spans = std::move(spans) };
    return layOutJobs({ &track, 1 });
}

std::vector<uint32_t> rowsOf(JobLanes const& lanes) {
    std::vector<uint32_t> rows;
    for (JobBar const& bar : lanes.lanes.at(0).bars) rows.push_back(bar.row);
    return rows;
}

TEST(JobLanes, WhatASpanContainsLiesBelowIt) {
    const JobLanes lanes = lanesOf({ span("frame", 0, 10), span("cull", 1, 4), span("nodes", 2, 3), span("sort", 4, 6),
                                     span("keys", 5, 6), span("next", 10, 12) });
    EXPECT_EQ(rowsOf(lanes), (std::vector<uint32_t>{ 0, 1, 2, 1, 2, 0 }));
    EXPECT_EQ(lanes.lanes[0].rows, 3u);
    EXPECT_EQ(lanes.whole, (TimeWindow{ 0, 12 }));
}

TEST(JobLanes, SpansThatOverlapWithoutContainingEachOtherDoNotCoverEachOther) {
    const JobLanes lanes = lanesOf({ span("a", 0, 5), span("b", 3, 8), span("c", 6, 9) });
    EXPECT_EQ(rowsOf(lanes), (std::vector<uint32_t>{ 0, 1, 0 }));
}

TEST(JobLanes, NoTwoBarsOfARowEverOverlap) {
    std::mt19937 random(7);
    for (int run = 0; run < 100; ++run) {
        std::vector<JobSpan> spans;
        for (int i = 0; i < 40; ++i) {
            const double begin = static_cast<double>(random() % 100);
            spans.push_back(span("job", begin, begin + static_cast<double>(random() % 20)));
        }
        std::ranges::sort(spans, [](JobSpan const& a, JobSpan const& b) {
            return std::pair(a.beginSeconds, -a.endSeconds) < std::pair(b.beginSeconds, -b.endSeconds);
        });
        const JobLanes lanes = lanesOf(spans);
        std::vector<JobBar> const& bars = lanes.lanes[0].bars;
        ASSERT_EQ(bars.size(), spans.size());
        for (size_t i = 0; i < bars.size(); ++i) {
            EXPECT_LT(bars[i].row, lanes.lanes[0].rows);
            for (size_t j = 0; j < i; ++j)
                EXPECT_TRUE(bars[i].row != bars[j].row || bars[j].end <= bars[i].begin) << i << ' ' << j;
        }
    }
}

TEST(JobLanes, ThreadsComeInTheOrderOfTheFrame) {
    std::vector<JobTrack> tracks;
    for (const char* name : { "worker 10", "driver thread", "worker 2", "some thread", "app thread" })
        tracks.push_back({ .name = name, .spans = { span("job", 0, 1) } });
    tracks.push_back({ .name = "idle" });
    std::vector<std::string> names;
    for (JobLane const& lane : layOutJobs(tracks).lanes) names.push_back(lane.name);
    EXPECT_EQ(names,
              (std::vector<std::string>{ "app thread", "some thread", "driver thread", "worker 2", "worker 10" }));
    EXPECT_TRUE(layOutJobs({}).isEmpty());
}

TEST(JobLanes, AWindowCutsWhatSticksOut) {
    const JobLanes lanes =
            lanesOf({ span("early", 0, 1), span("long", 1, 9), span("inside", 3, 4), span("late", 9, 10) });
    const std::vector<JobBar> bars = visibleBars(lanes.lanes[0], { 2, 5 }, 0);
    ASSERT_EQ(bars.size(), 2u);
    EXPECT_EQ(bars[0].begin, 2);
    EXPECT_EQ(bars[0].end, 5);
    EXPECT_EQ(bars[1].begin, 3);
    EXPECT_EQ(bars[1].row, 1u) << "rows do not move with the window";
}

TEST(JobLanes, OfManyShortBarsAPixelShowsOne) {
    std::vector<JobSpan> spans;
    for (int i = 0; i < 10'000; ++i) spans.push_back(span("tiny", i * 1e-4, i * 1e-4 + 0.5e-4));
    const JobLanes lanes = lanesOf(spans);
    const std::vector<JobBar> bars = visibleBars(lanes.lanes[0], { 0, 1 }, 0.01);
    EXPECT_GE(bars.size(), 99u);
    EXPECT_LE(bars.size(), 101u);
    EXPECT_EQ(visibleBars(lanes.lanes[0], { 0.5, 0.501 }, 1e-5).size(), 10u) << "nearer, all are seen";
}

TEST(JobLanes, TheShareOfWorkIsThatOfTheWindow) {
    const JobLanes lanes = lanesOf({ span("a", 0, 2), span("inner", 0.5, 1.5), span("b", 3, 4) });
    EXPECT_DOUBLE_EQ(busyShare(lanes.lanes[0], { 0, 4 }), 0.75);
    EXPECT_DOUBLE_EQ(busyShare(lanes.lanes[0], { 1, 3.5 }), 0.6);
    EXPECT_EQ(busyShare(lanes.lanes[0], { 2, 2 }), 0);
    const JobLanes waits = lanesOf({ span("prepare frame", 0, 1, 1), span("wait for driver", 1, 4, 1) });
    EXPECT_DOUBLE_EQ(busyShare(waits.lanes[0], { 0, 4 }), 0.25) << "who waits does nothing";
}

TEST(JobLanes, TheNewestFramesBeginWithTheirFirstPhase) {
    std::vector<JobTrack> tracks{
        { .name = "app thread",
          .spans = { span("prepare", 1, 2, 1), span("prepare", 3, 4, 2), span("prepare", 5, 6, 3) } },
        { .name = "driver thread", .spans = { span("replay", 4, 4.5, 2), span("job", 6, 8) } }
    };
    EXPECT_EQ(newestFrames(layOutJobs(tracks), 2), (TimeWindow{ 3, 8 }));
    EXPECT_EQ(newestFrames(layOutJobs(tracks), 9), (TimeWindow{ 1, 8 }));
    EXPECT_EQ(newestFrames(lanesOf({ span("job", 2, 3) }), 2), (TimeWindow{ 2, 3 })) << "no frame is known";
}

TEST(JobLanes, ZoomingKeepsTheMomentUnderThePointer) {
    const TimeWindow whole{ 10, 20 };
    const TimeWindow closer = zoomed({ 10, 20 }, 14, 0.5, whole);
    EXPECT_DOUBLE_EQ(closer.seconds(), 5);
    EXPECT_DOUBLE_EQ((14 - closer.begin) / closer.seconds(), 0.4);
    EXPECT_EQ(zoomed(closer, 14, 100, whole), whole) << "no farther than everything";
    TimeWindow window = whole;
    for (int i = 0; i < 200; ++i) window = zoomed(window, 15, 0.5, whole);
    EXPECT_NEAR(window.seconds(), kShortestWindow, 1e-12);
    EXPECT_LE(window.begin, 15);
    EXPECT_GE(window.end, 15);
}

TEST(JobLanes, PanningStopsAtTheEnds) {
    const TimeWindow whole{ 10, 20 };
    EXPECT_EQ(panned({ 12, 14 }, 3, whole), (TimeWindow{ 15, 17 }));
    EXPECT_EQ(panned({ 12, 14 }, 100, whole), (TimeWindow{ 18, 20 }));
    EXPECT_EQ(panned({ 12, 14 }, -100, whole), (TimeWindow{ 10, 12 }));
    EXPECT_EQ(panned({ 0, 100 }, 1, whole), whole);
}

} // namespace
} // namespace filament_core::view
