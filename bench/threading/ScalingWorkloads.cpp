// SPDX-License-Identifier: Apache-2.0
// The same work with 0, 1, 2 ... workers besides the caller; beyond the number of cores it must not get slower.
#include "bench/threading/Workloads.h"

#include "base/Assert.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::bench {
namespace {

Workload scaling(Settings const& settings, const char* what, unsigned workers, RepeatedWork const& work, double items,
                 const char* unit) {
    using enum RuntimeKind;
    Workload workload{ .name = fmt::format("scaling_{}_{}w", what, workers),
                       .title = fmt::format("{} with {} worker{}", what, workers, workers == 1 ? "" : "s"),
                       .unit = unit,
                       .kind = "scaling",
                       .x = static_cast<double>(workers),
                       .contenders = {},
                       .targets = {} };
    for (const RuntimeKind kind : { Ours, OneTbb, OpenMp, Serial })
        workload.contenders.push_back({ toString(kind), timed(makeRuntime(kind, { .threads = workers + 1 }), work,
                                                              items, settings.sampleNs) });
    return workload;
}

} // namespace

void addScalingWorkloads(WorkloadList& list, Settings const& settings) {
    const unsigned most = std::max(settings.workers(), 3u);
    const uint64_t items = settings.quick ? 2'000 : 200'000;
    const uint32_t depth = settings.quick ? 6 : 13;
    for (unsigned workers = 0; workers <= most; ++workers)
        list.push_back({ fmt::format("scaling_loop_{}w", workers), [=] {
                            const RepeatedWork loop = [work = SpinWork::ofItems(20), items](Runtime& r,
                                                                                            uint64_t repeats) {
                                r.loop(work, items, repeats);
                            };
                            return scaling(settings, "loop", workers, loop, static_cast<double>(items), "ns/item");
                        } });
    for (unsigned workers = 0; workers <= most; ++workers)
        list.push_back({ fmt::format("scaling_tree_{}w", workers), [=] {
                            const RepeatedWork tree = [depth](Runtime& r, uint64_t repeats) {
                                for (uint64_t i = 0; i < repeats; ++i)
                                    FILAMENT_ASSERT(r.tree(depth) == 1u << depth, "a tree visits all of its leaves");
                            };
                            return scaling(settings, "tree", workers, tree, (1u << depth) - 1, "ns/fork");
                        } });
}

} // namespace filament_core::bench
