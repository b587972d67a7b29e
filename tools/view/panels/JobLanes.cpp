// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/JobLanes.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>

namespace filament_core::view {
namespace {

/// Of the lanes, from the top: the order of a frame.
uint32_t rankOf(std::string_view name) {
    if (name == "app thread") return 0;
    if (name == "driver thread") return 2;
    return name.starts_with("worker") ? 3 : 1; // 1: jobs of the program's threads, under their own names
}

/// "worker 2" before "worker 10".
bool liesAbove(JobLane const& a, JobLane const& b) {
    const auto key = [](JobLane const& lane) {
        return std::tuple(rankOf(lane.name), lane.name.size(), std::string_view(lane.name));
    };
    return key(a) < key(b);
}

/// The first row that is free then; `ends` has the last end of each row.
uint32_t freeRow(std::vector<double>& ends, double begin) {
    const auto row = std::ranges::find_if(ends, [&](double end) { return end <= begin; });
    if (row != ends.end()) return static_cast<uint32_t>(row - ends.begin());
    ends.push_back(0);
    return static_cast<uint32_t>(ends.size() - 1);
}

JobLane laneOf(JobTrack const& track) {
    JobLane lane{ .name = track.name, .lost = track.lost };
    std::vector<double> ends;
    for (JobSpan const& span : track.spans) {
        const uint32_t row = freeRow(ends, span.beginSeconds);
        ends[row] = span.endSeconds;
        lane.bars.push_back({ span.name, span.beginSeconds, span.endSeconds, row, span.kind, span.frame });
    }
    lane.rows = std::max(static_cast<uint32_t>(ends.size()), 1u);
    return lane;
}

/// Keeps the length.
TimeWindow within(TimeWindow window, TimeWindow const& whole) {
    const double seconds = std::min(window.seconds(), whole.seconds());
    window.begin = std::clamp(window.begin, whole.begin, std::max(whole.begin, whole.end - seconds));
    window.end = window.begin + seconds;
    return window;
}

} // namespace

JobLanes layOutJobs(std::span<const JobTrack> tracks) {
    JobLanes result;
    double first = std::numeric_limits<double>::max(), last = std::numeric_limits<double>::lowest();
    for (JobTrack const& track : tracks) {
        if (track.spans.empty()) continue;
        result.lanes.push_back(laneOf(track));
        for (JobSpan const& span : track.spans) {
            first = std::min(first, span.beginSeconds);
            last = std::max(last, span.endSeconds);
        }
    }
    std::ranges::stable_sort(result.lanes, liesAbove);
    if (!result.lanes.empty()) result.whole = { first, last };
    return result;
}

std::vector<JobBar> visibleBars(JobLane const& lane, TimeWindow const& window, double leastSeconds) {
    std::vector<JobBar> bars;
    std::vector<double> covered(lane.rows,
                                std::numeric_limits<double>::lowest()); // up to where a short bar stands for others
    for (JobBar bar : lane.bars) {
        if (bar.begin >= window.end) break;
        if (bar.end <= window.begin) continue;
        bar.begin = std::max(bar.begin, window.begin);
        bar.end = std::min(bar.end, window.end);
        const bool isShort = bar.end - bar.begin < leastSeconds;
        if (isShort && bar.begin < covered[bar.row]) continue;
        if (isShort) covered[bar.row] = bar.begin + leastSeconds;
        bars.push_back(bar);
    }
    return bars;
}

bool isWait(JobBar const& bar) {
    return bar.kind == JobSpan::Kind::Phase && std::string_view(bar.name).starts_with("wait");
}

double busyShare(JobLane const& lane, TimeWindow const& window) {
    if (!(window.seconds() > 0)) return 0;
    double busy = 0;
    for (JobBar const& bar : lane.bars) {
        if (bar.row != 0 || isWait(bar)) continue;
        busy += std::max(0.0, std::min(bar.end, window.end) - std::max(bar.begin, window.begin));
    }
    return std::min(busy / window.seconds(), 1.0);
}

TimeWindow newestFrames(JobLanes const& lanes, uint32_t frames) {
    int64_t newest = -1;
    const auto visitPhases = [&](auto&& visit) {
        for (JobLane const& lane : lanes.lanes)
            for (JobBar const& bar : lane.bars)
                if (bar.frame >= 0) visit(bar);
    };
    visitPhases([&](JobBar const& bar) { newest = std::max(newest, bar.frame); });
    TimeWindow window = lanes.whole;
    if (newest < 0) return window;
    const int64_t first = newest - static_cast<int64_t>(frames) + 1;
    window.begin = window.end;
    visitPhases([&](JobBar const& bar) {
        if (bar.frame >= first) window.begin = std::min(window.begin, bar.begin);
    });
    return window;
}

TimeWindow zoomed(TimeWindow const& window, double at, double factor, TimeWindow const& whole) {
    const double longest = std::max(whole.seconds(), kShortestWindow);
    const double seconds = std::clamp(window.seconds() * factor, kShortestWindow, longest);
    const double share = window.seconds() > 0 ? (at - window.begin) / window.seconds() : 0.5;
    const double begin = at - share * seconds;
    return within({ begin, begin + seconds }, whole);
}

TimeWindow panned(TimeWindow const& window, double seconds, TimeWindow const& whole) {
    return within({ window.begin + seconds, window.end + seconds }, whole);
}

} // namespace filament_core::view
