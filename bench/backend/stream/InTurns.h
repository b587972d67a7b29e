// SPDX-License-Identifier: Apache-2.0
/// measureInTurns: measures two implementations alternately in every iteration, so that a busy machine slows both. Uses
/// medians, so a pre-empted iteration has no effect.
///   Out   counters: ns (median of a, per item), and `ratio` (median of a / median of b).
#pragma once

#include "base/Statistics.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

namespace filament_core::bench {

template <class A, class B>
void measureInTurns(benchmark::State& state, size_t items, const char* ratio, A&& a, B&& b) {
    using Clock = std::chrono::steady_clock;
    const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
    std::vector<double> timesOfA, timesOfB;
    for (auto _ : state) {
        const Clock::time_point start = Clock::now();
        a();
        const Clock::time_point middle = Clock::now();
        b();
        timesOfA.push_back(seconds(middle - start));
        timesOfB.push_back(seconds(Clock::now() - middle));
        state.SetIterationTime(timesOfA.back());
    }
    const double medianOfA = median(timesOfA);
    state.counters["ns"] = medianOfA * 1e9 / static_cast<double>(items);
    state.counters[ratio] = medianOfA / median(timesOfB);
}

} // namespace filament_core::bench
