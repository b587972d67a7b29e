// SPDX-License-Identifier: Apache-2.0
/// Workloads: the list of everything that threading_bench measures. README.md describes each one.
///   Memory  a workload is created before its first round and destroyed after its last, with its threads and engines.
///   Fails   make() says why a workload cannot run on this machine.
#pragma once

#include "base/Result.h"
#include "bench/threading/Contenders.h"
#include "bench/threading/Runtime.h"
#include "bench/threading/Workload.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace filament_core::bench {

struct WorkloadEntry {
    std::string name;
    std::function<Result<Workload>()> make;
};
using WorkloadList = std::vector<WorkloadEntry>;

WorkloadList allWorkloads(Settings const& settings);

void addJobWorkloads(WorkloadList& list, Settings const& settings);     ///< JobWorkloads.cpp: empty jobs, tree, chain
void addLoopWorkloads(WorkloadList& list, Settings const& settings);    ///< LoopWorkloads.cpp
void addUnevenWorkloads(WorkloadList& list, Settings const& settings);  ///< UnevenWorkloads.cpp: power law, hogged core
void addWakeUpWorkloads(WorkloadList& list, Settings const& settings);  ///< WakeUpWorkloads.cpp
void addScalingWorkloads(WorkloadList& list, Settings const& settings); ///< ScalingWorkloads.cpp
void addCommandWorkloads(WorkloadList& list, Settings const& settings); ///< CommandWorkloads.cpp: record and replay
void addFrameWorkloads(WorkloadList& list, Settings const& settings);   ///< FrameWorkloads.cpp: renderables

/// Does its work `repeats` times.
using RepeatedWork = std::function<void(Runtime& runtime, uint64_t repeats)>;

/// One figure per round: nanoseconds of `work` over its `items`, repeated until a sample takes Settings::sampleNs. The
/// runtime is warmed up before it and goes to sleep after it; neither is counted.
Sampler timed(std::shared_ptr<Runtime> const& runtime, RepeatedWork const& work, double items, double sampleNs);

/// timed() once, without repetition, for work that takes milliseconds. Returns nanoseconds.
double timeOnce(Runtime& runtime, std::function<void(Runtime&)> const& work);

/// "64 of 1024 jobs, scaled", or empty if nothing was scaled.
std::string scaledNote(uint32_t done, uint32_t wanted, const char* what);

} // namespace filament_core::bench
