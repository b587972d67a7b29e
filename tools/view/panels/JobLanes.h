// SPDX-License-Identifier: Apache-2.0
/// JobLanes: jobTimeline() as what a panel draws: a lane for each thread, in which spans that contain each other lie in
/// rows below each other, and the window of time that is looked at.
///   Layout  of all spans, once for each reading, so that rows stay while the window moves. visibleBars() then picks
///           what a frame has to draw.
///   Time    seconds of the engine.
///   Thread  any; values.   Fails: never.   Cost: layOutJobs(): spans times rows; visibleBars(): spans of the lane.
#pragma once

#include <filament_core/JobTimeline.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::view {

/// Empty: end <= begin.
struct TimeWindow {
    double begin = 0, end = 0;
    double seconds() const { return end - begin; }
    friend bool operator==(TimeWindow const&, TimeWindow const&) = default;
};

struct JobBar {
    const char* name = "";
    double begin = 0, end = 0;
    uint32_t row = 0; ///< below the bars that contain it
    JobSpan::Kind kind = JobSpan::Kind::Job;
    int64_t frame = -1;
};

struct JobLane {
    std::string name{};
    std::vector<JobBar> bars{}; ///< by their beginnings
    uint32_t rows = 1;
    uint64_t lost = 0; ///< spans for which there was no room
};

struct JobLanes {
    std::vector<JobLane> lanes{}; ///< app thread, other threads of the program, driver thread, workers in their order
    TimeWindow whole{};           ///< from the first beginning to the last end; empty: there are no spans
    bool isEmpty() const { return lanes.empty(); }
};

/// Spans of one lane that overlap without containing each other (two threads of one name) get different rows, too.
JobLanes layOutJobs(std::span<const JobTrack> tracks);

/// Bars that the window touches, cut off at its ends. Of neighbours in a row that are shorter than `leastSeconds` and
/// begin within that time, only the first is there: a pixel shows one of them.
std::vector<JobBar> visibleBars(JobLane const& lane, TimeWindow const& window, double leastSeconds);

/// A phase in which the thread waits for another one.
bool isWait(JobBar const& bar);
/// The share of the window in which the thread did something, in [0, 1]: its row 0 without waits.
double busyShare(JobLane const& lane, TimeWindow const& window);

/// From the beginning of the `frames`-th last frame that has phases to the last end. None has: `whole`.
TimeWindow newestFrames(JobLanes const& lanes, uint32_t frames);

/// `factor` < 1 looks closer; the moment `at` stays where it is, if it can. Clamped to [kShortestWindow, whole], and
/// into `whole`.
TimeWindow zoomed(TimeWindow const& window, double at, double factor, TimeWindow const& whole);
TimeWindow panned(TimeWindow const& window, double seconds, TimeWindow const& whole);
inline constexpr double kShortestWindow = 1e-6;

} // namespace filament_core::view
