// SPDX-License-Identifier: Apache-2.0
/// LatencyMeter: how long it takes from an input until its frame is in the window, and how many frames are on their
/// way.
///   In       when inputs come and frames are sent, by the caller's clock, in seconds; how many images the window has
///            taken, and when it took the last one by the engine's clock (EngineStatistics).
///   Clocks   tick alike but began at different times. The difference is the least that was seen between a present and
///            the look at it: so times are too long by at most the shortest such delay so far.
///   Limits   presents between two looks count as the last of them. Frames that are not seen after kLostSeconds are not
///            waited for: the window is hidden.
///   Memory   the last kFrames frames.   Thread: one; a plain value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace filament_core::view {

/// Over the history. No frames: all is 0.
struct Percentiles {
    uint32_t count = 0;
    double median = 0, p95 = 0, worst = 0; ///< nearest rank: values that occurred
};
Percentiles percentilesOf(std::vector<double> values);

class LatencyMeter {
public:
    static constexpr size_t kFrames = 240;
    static constexpr double kLostSeconds = 1;

    /// The next frame is the first that shows it; of several inputs the oldest counts.
    void input(double now);
    /// A frame was handed to the window system: the next present shows it.
    void sent(double now);
    /// `presents`: all that the window has taken since reset(). `lastPresentSeconds`: of the engine's clock; 0:
    /// unknown, then they are taken to happen now.
    void look(uint64_t presents, double lastPresentSeconds, double now);
    /// Another engine: its clock and its presents begin again. The history stays.
    void reset();

    bool isWaiting(double now) const; ///< for frames to be seen
    uint32_t framesInFlight() const { return static_cast<uint32_t>(mSent - mSeen); }
    Percentiles milliseconds() const { return percentilesOf({ mMilliseconds.begin(), mMilliseconds.end() }); }
    Percentiles inFlight() const { return percentilesOf({ mInFlight.begin(), mInFlight.end() }); }
    /// Milliseconds of the last frames with inputs, oldest first.
    std::vector<float> history() const { return { mMilliseconds.begin(), mMilliseconds.end() }; }

private:
    struct Waiting {
        uint64_t present = 0; ///< that shows it
        double inputSeconds = 0;
    };
    uint64_t mSent = 0, mSeen = 0;
    double mLastSent = 0;
    double mOffset = std::numeric_limits<double>::max(); ///< caller's clock - engine's clock
    std::optional<double> mOldestInput;                  ///< that no frame shows yet
    std::deque<Waiting> mWaiting;
    std::deque<double> mMilliseconds, mInFlight;
};

} // namespace filament_core::view
