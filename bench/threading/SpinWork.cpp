// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/SpinWork.h"

#include "bench/threading/Clock.h"

#include <algorithm>
#include <limits>

namespace filament_core::bench {
namespace {

/// The fastest of many short loops, because disturbances only make them longer.
double measureStepNs() {
    constexpr uint64_t kSteps = 400'000;
    constexpr int kLoops = 50;
    double best = std::numeric_limits<double>::max();
    for (int loop = 0; loop < kLoops; ++loop) {
        const int64_t start = wallNow();
        keep(spinSteps(1, kSteps));
        best = std::min(best, static_cast<double>(wallNow() - start) / kSteps);
    }
    return best;
}

} // namespace

[[gnu::noinline]] uint64_t spinSteps(uint64_t value, uint64_t steps) {
    for (uint64_t step = 0; step < steps; ++step) {
        value += 0x9e37;
        asm volatile("" : "+r"(value));
    }
    return value;
}

double stepsFor(double nanoseconds) {
    static const double kStepNs = measureStepNs();
    return nanoseconds / kStepNs;
}

} // namespace filament_core::bench
