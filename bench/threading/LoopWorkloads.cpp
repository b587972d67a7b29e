// SPDX-License-Identifier: Apache-2.0
// Parallel loops over equal items, long and short.
#include "bench/threading/Workloads.h"

#include <fmt/format.h>

namespace filament_core::bench {
namespace {

struct Loop {
    const char* name;
    uint64_t count, quickCount;
    double itemNs;
    bool whole; ///< report the whole loop in microseconds, not an item
    std::vector<Target> targets;
};

Workload makeLoop(Settings const& settings, Loop const& loop) {
    const uint64_t count = settings.quick ? loop.quickCount : loop.count;
    const SpinWork work = SpinWork::ofItems(loop.itemNs);
    Workload workload{ .name = loop.name,
                       .title = fmt::format("parallel-for {} x {:g} ns", count, loop.itemNs),
                       .unit = loop.whole ? "us/loop" : "ns/item",
                       .kind = "jobs",
                       .contenders = {},
                       .targets = loop.targets };
    const auto repeated = [=](Runtime& r, uint64_t repeats) { r.loop(work, count, repeats); };
    addRuntimes(workload, kAllRuntimes, Work::Loop, [&](RuntimeKind kind) -> Contender {
        return { toString(kind), timed(makeRuntime(kind, { .threads = settings.threads }), repeated,
                                       loop.whole ? 1e3 : static_cast<double>(count), settings.sampleNs) };
    });
    return workload;
}

} // namespace

void addLoopWorkloads(WorkloadList& list, Settings const& settings) {
    const Target nearlyTwice{
        .contender = "serial", .figure = Figure::Ratio, .other = "ours", .limit = 1.9, .atLeast = true
    };
    const Loop loops[] = {
        { "loop_1M_1ns", 1'000'000, 20'000, 1, false, { nearlyTwice } },
        { "loop_1M_20ns", 1'000'000, 2'000, 20, false, {} },
        { "loop_8k_1ns", 8192, 8192, 1, true, { { .limit = 6 } } },
    };
    for (Loop const& loop : loops) list.push_back({ loop.name, [=] { return makeLoop(settings, loop); } });
}

} // namespace filament_core::bench
