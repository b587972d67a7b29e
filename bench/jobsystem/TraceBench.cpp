// SPDX-License-Identifier: Apache-2.0
// What a timeline costs per job, and what querying the machine's topology costs at start-up.
#include "jobsystem/CpuQuota.h"
#include "jobsystem/JobSystem.h"
#include "jobsystem/JobTrace.h"
#include "jobsystem/Topology.h"

#include <benchmark/benchmark.h>

namespace filament_core::jobs {
namespace {

/// The part of a traced job other than its clock reads.
void recordJob(benchmark::State& state) {
    JobTrace trace(1);
    int64_t time = 0;
    for (auto _ : state) {
        trace.recordJob(0, "job", time, time + 1, false);
        ++time;
    }
}
BENCHMARK(recordJob);

/// The whole of it: two clock reads and the record.
void traceJob(benchmark::State& state) {
    JobTrace trace(1);
    for (auto _ : state) {
        const int64_t begin = JobTrace::now();
        benchmark::ClobberMemory();
        trace.recordJob(0, "job", begin, JobTrace::now(), false);
    }
}
BENCHMARK(traceJob);

/// A batch of empty jobs with and without a timeline: the difference is the cost of tracing a job.
void batchOf1000(benchmark::State& state) {
    JobSystem jobs({ .workers = static_cast<int>(state.range(0)), .trace = state.range(1) != 0 });
    const AdoptedThread seat(jobs);
    JobGroup group(jobs);
    for (auto _ : state) {
        for (int i = 0; i < 1000; ++i) group.run<"empty">([] {});
        group.wait();
    }
    state.SetItemsProcessed(state.iterations() * 1000);
}
BENCHMARK(batchOf1000)->ArgNames({ "workers", "trace" })->ArgsProduct({ { 0, 1 }, { 0, 1 } })->UseRealTime();

void readClock(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(JobTrace::now());
}
BENCHMARK(readClock);

void span(benchmark::State& state) {
    JobTrace trace(0);
    const JobTrace::Track track = trace.track("app");
    for (auto _ : state) trace.span(track, "phase", 0, 1, 2);
}
BENCHMARK(span);

/// A full ring while nothing else runs.
void snapshot(benchmark::State& state) {
    JobTrace trace(1);
    for (int64_t i = 0; i < JobTrace::kEventsPerTrack; ++i) trace.recordJob(0, "job", i, i + 1, false);
    for (auto _ : state) benchmark::DoNotOptimize(trace.snapshot());
}
BENCHMARK(snapshot)->Unit(benchmark::kMillisecond);

void quotaOfCgroups(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(cpuQuota());
}
BENCHMARK(quotaOfCgroups)->Unit(benchmark::kMicrosecond);

void cpuBudget(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(readCpuBudget());
}
BENCHMARK(cpuBudget)->Unit(benchmark::kMicrosecond);

/// The first call of the process loads hwloc; one iteration, so run it alone: --benchmark_filter=firstTopology
void firstTopology(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(readTopology());
}
BENCHMARK(firstTopology)->Iterations(1)->Unit(benchmark::kMicrosecond);

void topology(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(readTopology());
}
BENCHMARK(topology)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace filament_core::jobs
