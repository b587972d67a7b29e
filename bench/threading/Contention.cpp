// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Contention.h"

#include "bench/threading/Clock.h"
#include "bench/threading/ForkTree.h"
#include "bench/threading/SpinWork.h"
#include "jobsystem/JobSystem.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <span>

namespace filament_core::bench {
namespace {

using jobs::Contention;
using jobs::JobGroup;
using jobs::JobSystem;

constexpr uint32_t kWorkers[] = { 1, 2, 4, 8, 16 };
constexpr size_t kSlopeFrom = 2; // 4 workers
constexpr int kRepeats = 20;

/// Runs once and returns how many jobs that were.
struct CountedWork {
    const char* name;
    std::function<uint64_t(JobSystem&, bool quick)> run;
};

uint64_t batch(JobSystem& jobs, uint32_t count, double nanoseconds) {
    const auto steps = static_cast<uint64_t>(nanoseconds > 0 ? stepsFor(nanoseconds) : 0);
    JobGroup group(jobs);
    for (uint32_t i = 0; i < count; ++i) group.run<"job">([=] { keep(spinSteps(i, steps)); });
    group.wait();
    return count;
}

uint64_t frames(JobSystem& jobs, uint32_t count) {
    constexpr uint32_t kLoops = 4, kRanges = 32;
    const auto steps = static_cast<uint64_t>(stepsFor(5'000));
    for (uint32_t frame = 0; frame < count; ++frame) {
        for (uint32_t loop = 0; loop < kLoops; ++loop)
            parallelFor<"range">(jobs, kRanges, 1, [&](size_t begin, size_t) { keep(spinSteps(begin, steps)); });
        spinFor(300'000); // the app thread computes alone, and workers fall asleep
    }
    return uint64_t{ count } * kLoops * kRanges;
}

std::vector<CountedWork> allWork() {
    return {
        { "empty jobs", [](JobSystem& jobs, bool quick) { return batch(jobs, quick ? 1000 : 65'536, 0); } },
        { "jobs of 5 us", [](JobSystem& jobs, bool quick) { return batch(jobs, quick ? 100 : 2048, 5'000); } },
        { "tree", [](JobSystem& jobs, bool quick) { return uint64_t{ forkTree(jobs, quick ? 8 : 16) }; } },
        { "frames of four loops", [](JobSystem& jobs, bool quick) { return frames(jobs, quick ? 3 : 20); } },
    };
}

double slopeOf(std::span<const ContentionRow> rows, Contention kind) {
    const double first = rows[kSlopeFrom].byJob(kind), last = rows.back().byJob(kind);
    if (first <= 0 || last <= 0) return 0;
    return std::log(last / first) / std::log(static_cast<double>(rows.back().workers) / rows[kSlopeFrom].workers);
}

void printHead() {
    fmt::print("| work | workers |");
    for (size_t kind = 0; kind < jobs::kContentionKinds; ++kind)
        fmt::print(" {} |", jobs::nameOf(static_cast<Contention>(kind)));
    fmt::print("\n|---|---|");
    for (size_t kind = 0; kind < jobs::kContentionKinds; ++kind) fmt::print("---|");
    fmt::print("\n");
}

void print(std::string const& workload, std::string const& workers,
           std::function<std::string(Contention)> const& cell) {
    fmt::print("| {} | {} |", workload, workers);
    for (size_t kind = 0; kind < jobs::kContentionKinds; ++kind)
        fmt::print(" {} |", cell(static_cast<Contention>(kind)));
    fmt::print("\n");
}

} // namespace

std::vector<ContentionRow> measureContention(bool quick) {
    std::vector<ContentionRow> rows;
    printHead();
    for (CountedWork const& work : allWork()) {
        const size_t first = rows.size();
        for (const uint32_t workers : kWorkers) {
            JobSystem system({ .workers = static_cast<int>(workers), .threadName = "bench" });
            const jobs::AdoptedThread seat(system);
            work.run(system, true); // threads exist
            const jobs::ContentionCounts before = contentionOf(system);
            uint64_t done = 0;
            for (int i = 0; i < (quick ? 1 : kRepeats); ++i) done += work.run(system, quick);
            rows.push_back({ work.name, workers, done, contentionOf(system) - before });
            print(work.name, std::to_string(workers),
                  [&](Contention kind) { return fmt::format("{:.3g}", rows.back().byJob(kind)); });
        }
        const std::span<const ContentionRow> all(rows.data() + first, rows.size() - first);
        print(work.name, "slope", [&](Contention kind) { return fmt::format("{:.2f}", slopeOf(all, kind)); });
    }
    return rows;
}

} // namespace filament_core::bench
