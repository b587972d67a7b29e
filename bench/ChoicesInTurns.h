// SPDX-License-Identifier: Apache-2.0
/// ChoicesInTurns: frames with several choices, each measured once a round, so that a busy machine slows all of them.
///   Out   of each choice and figure: the least, the median, and the median of its ratios to the first choice in the
///         same round.
#pragma once

#include "base/Statistics.h"

#include <filament_core/Engine.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

namespace filament_core::bench {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Of each of `frames`, until the device has finished it.
template <class Draw>
double millisecondsPerFrame(Engine& engine, int frames, Draw&& draw) {
    const Clock::time_point begin = Clock::now();
    for (int i = 0; i < frames; ++i) {
        draw();
        engine.waitIdle();
    }
    return millisecondsSince(begin) / frames;
}

template <size_t Choices, size_t Figures = 1>
class ChoicesInTurns {
public:
    /// `measure(choice)`: its figures, a std::array.
    template <class Measure>
    ChoicesInTurns(int rounds, Measure&& measure) {
        for (int round = 0; round < rounds; ++round) {
            for (size_t choice = 0; choice < Choices; ++choice) {
                const std::array<double, Figures> figures = measure(choice);
                for (size_t i = 0; i < Figures; ++i) mSamples[i][choice].push_back(figures[i]);
            }
        }
    }

    double least(size_t choice, size_t figure = 0) const { return std::ranges::min(mSamples[figure][choice]); }
    double median(size_t choice, size_t figure = 0) const { return filament_core::median(mSamples[figure][choice]); }
    double ratio(size_t choice, size_t figure = 0) const {
        return filament_core::median(pairedRatios(mSamples[figure][choice], mSamples[figure][0]));
    }

private:
    std::array<std::array<std::vector<double>, Choices>, Figures> mSamples;
};

} // namespace filament_core::bench
