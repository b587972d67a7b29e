// SPDX-License-Identifier: Apache-2.0
// The same work with 0, 1, 2 ... workers besides the caller; beyond the number of cores it must not get slower.
#include "bench/threading/Workloads.h"

#include "base/Assert.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

namespace filament_core::bench {
namespace {

/// Its work, and how many items that has.
struct Sized {
    RepeatedWork work;
    double items;
    std::string note;
};

Workload scaling(Settings const& settings, const char* what, unsigned workers, Work kindOfWork,
                 std::function<Sized(Runtime const&)> const& sized, const char* unit) {
    using enum RuntimeKind;
    Workload workload{ .name = fmt::format("scaling_{}_{}w", what, workers),
                       .title = fmt::format("{} with {} worker{}", what, workers, workers == 1 ? "" : "s"),
                       .unit = unit,
                       .kind = "scaling",
                       .x = static_cast<double>(workers),
                       .contenders = {},
                       .targets = {} };
    const std::array kinds{ Ours, OneTbb, OpenMp, Eigen, Asio, Serial };
    addRuntimes(workload, kinds, kindOfWork, [&](RuntimeKind kind) -> Contender {
        std::shared_ptr<Runtime> runtime = makeRuntime(kind, { .threads = workers + 1 });
        const auto [work, count, note] = sized(*runtime);
        return { toString(kind), timed(runtime, work, count, settings.sampleNs), note };
    });
    return workload;
}

std::function<Sized(Runtime const&)> loopOf(uint64_t items) {
    return [=](Runtime const&) -> Sized {
        return { [work = SpinWork::ofItems(20), items](Runtime& r, uint64_t repeats) { r.loop(work, items, repeats); },
                 static_cast<double>(items), "" };
    };
}

std::function<Sized(Runtime const&)> treeOf(uint32_t wanted) {
    return [=](Runtime const& runtime) -> Sized {
        const uint32_t leaves = std::min(wanted, runtime.affordableLeaves());
        const auto tree = [leaves](Runtime& r, uint64_t repeats) {
            for (uint64_t i = 0; i < repeats; ++i)
                FILAMENT_ASSERT(r.tree(static_cast<uint32_t>(std::bit_width(leaves)) - 1) == leaves,
                                "a tree visits all of its leaves");
        };
        return { tree, static_cast<double>(leaves - 1), scaledNote(leaves, wanted, "leaves") };
    };
}

} // namespace

void addScalingWorkloads(WorkloadList& list, Settings const& settings) {
    const unsigned most = std::max(settings.workers(), 3u);
    const uint64_t items = settings.quick ? 2'000 : 200'000;
    const uint32_t depth = settings.quick ? 6 : 13;
    for (unsigned workers = 0; workers <= most; ++workers)
        list.push_back({ fmt::format("scaling_loop_{}w", workers),
                         [=] { return scaling(settings, "loop", workers, Work::Loop, loopOf(items), "ns/item"); } });
    for (unsigned workers = 0; workers <= most; ++workers)
        list.push_back({ fmt::format("scaling_tree_{}w", workers), [=] {
                            return scaling(settings, "tree", workers, Work::Tree, treeOf(1u << depth), "ns/fork");
                        } });
}

} // namespace filament_core::bench
