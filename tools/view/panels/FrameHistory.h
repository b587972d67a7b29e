// SPDX-License-Identifier: Apache-2.0
/// FrameHistory: what the last frames cost and drew, for plots and for the job timeline.
///   In      Renderer::takeTimings() and Renderer::statistics(), after each frame.
///   Memory  the last kFrames frames, in place.   Thread: one.
#pragma once

#include <filament_core/Renderer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

/// Rows of the statistics panel.
enum class FrameNumber : uint8_t {
    FrameMilliseconds, ///< from the beginning of a frame to that of the next one
    PrepareMilliseconds,
    RecordMilliseconds,
    ReplayMilliseconds,
    DeviceMilliseconds,
    LatencyMilliseconds, ///< from the beginning of a frame until its commands have been replayed
    Draws,
    Triangles,
    Visible,
    Culled,
    Lights,
    Passes,
    DeviceMegabytes,
    Count,
};
const char* nameOf(FrameNumber number);
const char* unitOf(FrameNumber number); ///< "ms", "MB" or ""

class FrameHistory {
public:
    static constexpr size_t kFrames = 240;

    void addTimings(std::span<const FrameTimings> timings); ///< oldest first
    void addStatistics(FrameStatistics const& statistics, uint64_t deviceBytes);
    void clear();

    /// Values that are there, oldest first. Valid until the next add.
    std::span<const float> values(FrameNumber number) const;
    float latest(FrameNumber number) const; ///< 0: none
    /// The newest kTimings frames, oldest first.
    std::vector<FrameTimings> const& timings() const { return mTimings; }

    /// For ChangeMeter: what the newest timed frame took on the device if that is known, else on the driver thread.
    double latestMilliseconds() const;

private:
    static constexpr size_t kTimings = 8;
    struct Series {
        std::array<float, 2 * kFrames> values{}; ///< the newest are contiguous: moved back when the end is reached
        size_t end = 0, count = 0;
    };
    void put(FrameNumber number, double value);

    std::array<Series, static_cast<size_t>(FrameNumber::Count)> mSeries{};
    std::vector<FrameTimings> mTimings{};
};

// ---- the timeline

/// Who works: rows of the timeline, from the top.
enum class TimelineLane : uint8_t { App, Driver, Device, Workers };
const char* toString(TimelineLane lane);

struct TimelineBar {
    TimelineLane lane = TimelineLane::App;
    uint64_t frame = 0;
    std::string name{};        ///< "prepare", "record", "replay", "shadow maps"
    double begin = 0, end = 0; ///< milliseconds since the first bar begins
};

struct Timeline {
    std::vector<TimelineBar> bars{};
    double milliseconds = 0; ///< from the first beginning to the last end
};

/// The app prepares and records, then the driver thread replays. What only has a length (the device's passes, the mean
/// load of the workers) is shown from the beginning of what caused it.
Timeline timelineOf(std::span<const FrameTimings> timings);

} // namespace filament_core::view
