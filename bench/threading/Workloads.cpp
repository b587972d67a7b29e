// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Workloads.h"

#include "bench/threading/Clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::bench {
namespace {

/// Wakes the threads, and brings the core back to full speed after settle() slept.
void warmUp(Runtime& runtime) {
    runtime.emptyJobs(std::min(runtime.affordableJobs(), 64u), 1);
    spinFor(100'000);
}

double timeWork(Runtime& runtime, RepeatedWork const& work, uint64_t repeats) {
    const int64_t start = wallNow();
    work(runtime, repeats);
    return static_cast<double>(wallNow() - start);
}

/// How often `work` fits into a sample.
uint64_t calibrateRepeats(Runtime& runtime, RepeatedWork const& work, double sampleNs) {
    constexpr uint64_t kMost = 1 << 24;
    uint64_t repeats = 1;
    double took = timeWork(runtime, work, repeats);
    while (took < sampleNs / 4 && repeats < kMost) took = timeWork(runtime, work, repeats *= 2);
    return std::clamp<uint64_t>(static_cast<uint64_t>(static_cast<double>(repeats) * sampleNs / took), 1, kMost);
}

} // namespace

WorkloadList allWorkloads(Settings const& settings) {
    WorkloadList list;
    addJobWorkloads(list, settings);
    addLoopWorkloads(list, settings);
    addUnevenWorkloads(list, settings);
    addWakeUpWorkloads(list, settings);
    addScalingWorkloads(list, settings);
    addCommandWorkloads(list, settings);
    addFrameWorkloads(list, settings);
    return list;
}

Sampler timed(std::shared_ptr<Runtime> const& runtime, RepeatedWork const& work, double items, double sampleNs) {
    return [=, repeats = uint64_t{ 0 }](std::vector<double>& figures) mutable {
        runtime->enter();
        warmUp(*runtime);
        if (repeats == 0) repeats = calibrateRepeats(*runtime, work, sampleNs);
        figures.push_back(timeWork(*runtime, work, repeats) / (static_cast<double>(repeats) * items));
        settle();
        runtime->leave();
    };
}

double timeOnce(Runtime& runtime, std::function<void(Runtime&)> const& work) {
    runtime.enter();
    warmUp(runtime);
    const double took = timeWork(
            runtime, [&](Runtime& r, uint64_t) { work(r); }, 1);
    settle();
    runtime.leave();
    return took;
}

std::string scaledNote(uint32_t done, uint32_t wanted, const char* what) {
    return done >= wanted ? std::string() : fmt::format("{} of {} {}, scaled", done, wanted, what);
}

} // namespace filament_core::bench
