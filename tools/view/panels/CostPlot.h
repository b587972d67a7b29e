// SPDX-License-Identifier: Apache-2.0
/// CostPlot: what settings of quality cost in one scene: the time of a frame and the error of its image, a point for
/// each; and the geometry of the plot that a panel draws.
///   Points   a point has the whole quality that was measured, so that a click makes exactly that the document's
///            setting.
///   Error    root mean square of the differences of red, green and blue from the reference, as displayed, in [0, 1].
///   Thread   any; values.   Fails: never.
#pragma once

#include <filament_core/Math.h>
#include <filament_core/View.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::view {

struct QualitySetting {
    std::string name{}; ///< "shadows=pcf5", "samples=4", "preset high", "as it is": the label of the point
    Quality quality{};
    uint8_t samples = 1; ///< View::samples
};

/// The view's own setting first, then each value of each choice that differs from it, samples, and the presets of
/// quality. Values that give the same quality as an earlier one are left out.
std::vector<QualitySetting> settingsToMeasure(View const& view);

bool hasSetting(View const& view, QualitySetting const& setting);
void applySetting(View& view, QualitySetting const& setting);

struct MeasuredSetting {
    QualitySetting setting{};
    double milliseconds = 0; ///< median of the rounds so far
    std::optional<double> error{};
    uint32_t rounds = 0; ///< 0: not measured yet

    bool isMeasured() const { return rounds > 0 && error.has_value(); }
};

struct CostPlot {
    enum class State : uint8_t { Idle, Measuring, Finished, Cancelled, Failed };
    State state = State::Idle;
    std::vector<MeasuredSetting> points{};
    std::string device{};         ///< "gles: llvmpipe (...)"
    std::string clock{};          ///< "device time" or "driver thread's time"
    std::string reference{};      ///< "path tracer: 256 of 256 samples, ...", "the most exact setting"
    std::string doing{};          ///< of Measuring: "shadows=pcf5, round 2 of 7"
    std::string error{};          ///< of Failed: one line
    uint32_t done = 0, total = 0; ///< settings times rounds
    bool isBusy() const { return state == State::Measuring; }
};

/// The points that no other one beats in both time and error, fastest first. Of equal points the first.
std::vector<size_t> paretoFront(std::span<const MeasuredSetting> points);

/// Where the numbers are on the screen: time to the right, error upwards.
struct PlotScale {
    float2 origin{ 0 }, size{ 0 }; ///< of the area of the plot: its upper left corner
    double leastX = 0, mostX = 1, leastY = 0, mostY = 1;

    float2 place(double x, double y) const;
};

/// All measured points, with a margin around them; zero is in it where it is near.
PlotScale scaleOf(std::span<const MeasuredSetting> points, float2 origin, float2 size);

/// Round numbers (1, 2 or 5 times a power of ten) in [least, most]: at most `count` + 1, at least 1 if count > 0.
std::vector<double> ticksOf(double least, double most, uint32_t count);

/// The nearest measured point within `reach` pixels.
std::optional<size_t> nearestPoint(std::span<const MeasuredSetting> points, PlotScale const& scale, float2 at,
                                   float reach);

/// Two lines: name, time and error; then the differences from the first point.
std::string describe(std::span<const MeasuredSetting> points, size_t index);

} // namespace filament_core::view
