// SPDX-License-Identifier: Apache-2.0
// The cost of a job, and the gain from forking. The argument "workers" counts the threads besides the caller.
// Counters named vs_* are ratios of times measured side by side in the same run; below 1 the job system is faster.
#include "jobsystem/JobSystem.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace filament_core::jobs {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Measures a and b in turns and reports time(a) / time(b).
template <class A, class B>
void compareInTurns(benchmark::State& state, const char* counter, A&& a, B&& b) {
    double secondsA = 0, secondsB = 0;
    for (auto _ : state) {
        Clock::time_point start = Clock::now();
        a();
        const double elapsed = secondsSince(start);
        state.SetIterationTime(elapsed);
        secondsA += elapsed;
        start = Clock::now();
        b();
        secondsB += secondsSince(start);
    }
    state.counters[counter] = secondsA / secondsB;
}

int64_t serialFibonacci(int n) { return n < 2 ? n : serialFibonacci(n - 1) + serialFibonacci(n - 2); }

int64_t forkedFibonacci(JobSystem& jobs, int n) {
    if (n < 2) return n;
    int64_t left = 0;
    JobGroup group(jobs);
    group.run([&] { left = forkedFibonacci(jobs, n - 1); });
    const int64_t right = forkedFibonacci(jobs, n - 2);
    group.wait();
    return left + right;
}

void emptyJobs(benchmark::State& state) {
    JobSystem jobs({ .workers = static_cast<int>(state.range(0)) });
    constexpr int kJobs = 1000;
    for (auto _ : state) {
        JobGroup group(jobs);
        for (int i = 0; i < kJobs; ++i) group.run([] {});
    }
    state.SetItemsProcessed(state.iterations() * kJobs);
}
BENCHMARK(emptyJobs)->ArgName("workers")->Arg(0)->Arg(1)->Arg(3)->UseRealTime();

/// One job and its wait while the workers sleep: the latency of a frame's first fork.
void oneJob(benchmark::State& state) {
    JobSystem jobs({ .workers = static_cast<int>(state.range(0)) });
    for (auto _ : state) {
        JobGroup group(jobs);
        group.run([] {});
        group.wait();
    }
}
BENCHMARK(oneJob)->ArgName("workers")->Arg(0)->Arg(1)->Arg(3)->UseRealTime();

/// Only forks and joins: 8 361 jobs of one addition each. The ratio compares a job with a call.
void forkJoinTree(benchmark::State& state) {
    JobSystem jobs({ .workers = static_cast<int>(state.range(0)) });
    constexpr int kN = 19;
    compareInTurns(
            state, "vs_calls", [&] { benchmark::DoNotOptimize(forkedFibonacci(jobs, kN)); },
            [] { benchmark::DoNotOptimize(serialFibonacci(kN)); });
}
BENCHMARK(forkJoinTree)->ArgName("workers")->Arg(0)->Arg(1)->Arg(3)->UseManualTime();

/// A loop over 1 M values; with N cores vs_serial should approach 1 / N.
void parallelForOverMath(benchmark::State& state) {
    JobSystem jobs({ .workers = static_cast<int>(state.range(0)) });
    std::vector<float> values(1 << 20, 0.5f);
    const auto body = [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) values[i] = std::sqrt(values[i] * values[i] + 1e-6f);
    };
    const auto grain = static_cast<size_t>(state.range(1));
    compareInTurns(
            state, "vs_serial", [&] { parallelFor(jobs, values.size(), grain, body); },
            [&] { body(0, values.size()); });
}
BENCHMARK(parallelForOverMath)
        ->ArgNames({ "workers", "grain" })
        ->ArgsProduct({ { 0, 1, 3 }, { 64, 4096 } })
        ->UseManualTime();

} // namespace
} // namespace filament_core::jobs
