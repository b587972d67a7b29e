// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/FrameHistory.h"

#include <algorithm>
#include <limits>

namespace filament_core::view {
namespace {

constexpr std::array kNumberNames{ "frame",     "prepare", "record", "replay", "device", "latency",      "draws",
                                   "triangles", "visible", "culled", "lights", "passes", "device memory" };
static_assert(kNumberNames.size() == static_cast<size_t>(FrameNumber::Count));

} // namespace

const char* nameOf(FrameNumber number) { return kNumberNames[static_cast<size_t>(number)]; }
const char* unitOf(FrameNumber number) {
    if (number <= FrameNumber::LatencyMilliseconds) return "ms";
    return number == FrameNumber::DeviceMegabytes ? "MB" : "";
}

void FrameHistory::put(FrameNumber number, double value) {
    Series& series = mSeries[static_cast<size_t>(number)];
    if (series.end == series.values.size()) {
        std::copy(series.values.end() - kFrames, series.values.end(), series.values.begin());
        series.end = kFrames;
    }
    series.values[series.end++] = static_cast<float>(value);
    series.count = std::min(series.count + 1, kFrames);
}

void FrameHistory::addTimings(std::span<const FrameTimings> timings) {
    for (FrameTimings const& frame : timings) {
        if (!mTimings.empty()) {
            put(FrameNumber::FrameMilliseconds, (frame.beginSeconds - mTimings.back().beginSeconds) * 1e3);
        }
        put(FrameNumber::PrepareMilliseconds, frame.prepareMilliseconds);
        put(FrameNumber::RecordMilliseconds, frame.recordMilliseconds);
        put(FrameNumber::ReplayMilliseconds, frame.replayMilliseconds);
        put(FrameNumber::DeviceMilliseconds, frame.gpuMilliseconds);
        put(FrameNumber::LatencyMilliseconds, (frame.replayEndSeconds - frame.beginSeconds) * 1e3);
        if (mTimings.size() == kTimings) mTimings.erase(mTimings.begin());
        mTimings.push_back(frame);
    }
}

void FrameHistory::addStatistics(FrameStatistics const& statistics, uint64_t deviceBytes) {
    put(FrameNumber::Draws, statistics.draws);
    put(FrameNumber::Triangles, statistics.triangles);
    put(FrameNumber::Visible, statistics.visible);
    put(FrameNumber::Culled, statistics.culled);
    put(FrameNumber::Lights, statistics.lights);
    put(FrameNumber::Passes, statistics.passesRun);
    put(FrameNumber::DeviceMegabytes, static_cast<double>(deviceBytes) / 1e6);
}

void FrameHistory::clear() { *this = {}; }

std::span<const float> FrameHistory::values(FrameNumber number) const {
    Series const& series = mSeries[static_cast<size_t>(number)];
    return { series.values.data() + series.end - series.count, series.count };
}

float FrameHistory::latest(FrameNumber number) const {
    const std::span<const float> all = values(number);
    return all.empty() ? 0 : all.back();
}

double FrameHistory::latestMilliseconds() const {
    if (mTimings.empty()) return 0;
    return mTimings.back().gpuMilliseconds > 0 ? mTimings.back().gpuMilliseconds : mTimings.back().replayMilliseconds;
}

// ---- the timeline

const char* toString(TimelineLane lane) {
    constexpr std::array kNames{ "app", "driver", "device", "workers" };
    return kNames[static_cast<size_t>(lane)];
}

Timeline timelineOf(std::span<const FrameTimings> timings) {
    Timeline timeline;
    if (timings.empty()) return timeline;
    double first = std::numeric_limits<double>::max();
    for (FrameTimings const& frame : timings) first = std::min(first, frame.beginSeconds);
    const auto add = [&](FrameTimings const& frame, TimelineLane lane, std::string name, double begin, double length) {
        if (!(length > 0)) return;
        timeline.bars.push_back({ lane, frame.frame, std::move(name), begin, begin + length });
        timeline.milliseconds = std::max(timeline.milliseconds, begin + length);
    };
    for (FrameTimings const& frame : timings) {
        const double begin = (frame.beginSeconds - first) * 1e3, replay = (frame.replayBeginSeconds - first) * 1e3;
        add(frame, TimelineLane::App, "prepare", begin, frame.prepareMilliseconds);
        add(frame, TimelineLane::App, "record", begin + frame.prepareMilliseconds, frame.recordMilliseconds);
        add(frame, TimelineLane::Workers, "jobs", begin, frame.workerBusyMilliseconds);
        add(frame, TimelineLane::Driver, "replay", replay, (frame.replayEndSeconds - frame.replayBeginSeconds) * 1e3);
        double pass = replay;
        for (PassTiming const& timing : frame.passes) {
            add(frame, TimelineLane::Device, timing.name, pass, timing.gpuMilliseconds);
            pass += timing.gpuMilliseconds;
        }
    }
    return timeline;
}

} // namespace filament_core::view
