// SPDX-License-Identifier: Apache-2.0
// The cost of a job: alone, in batches, as a tree of forks, as a chain. The jobs do nothing.
#include "bench/threading/Workloads.h"

#include "base/Assert.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace filament_core::bench {
namespace {

std::shared_ptr<Runtime> runtimeOf(RuntimeKind kind, Settings const& settings) {
    return makeRuntime(kind, { .threads = settings.threads });
}

Workload batch(Settings const& settings, std::string name, uint32_t jobs, std::vector<Target> targets) {
    Workload workload{ .name = std::move(name),
                       .title = jobs == 1 ? "single empty job" : fmt::format("batch of {} empty jobs", jobs),
                       .unit = "ns/job",
                       .kind = "jobs",
                       .contenders = {},
                       .targets = std::move(targets) };
    addRuntimes(workload, kAllRuntimes, Work::Jobs, [&](RuntimeKind kind) -> Contender {
        auto runtime = runtimeOf(kind, settings);
        const uint32_t count = std::min(jobs, runtime->affordableJobs());
        const auto work = [count](Runtime& r, uint64_t repeats) { r.emptyJobs(count, repeats); };
        return { toString(kind), timed(runtime, work, count, settings.sampleNs), scaledNote(count, jobs, "jobs") };
    });
    return workload;
}

Workload forkJoinTree(Settings const& settings) {
    const uint32_t depth = settings.quick ? 8 : 16;
    Workload workload{ .name = "tree_64k",
                       .title = fmt::format("fork-join tree, {} leaves", 1u << depth),
                       .unit = "ns/fork",
                       .kind = "jobs",
                       .contenders = {},
                       .targets = { { .limit = 25 }, { .figure = Figure::Ratio, .other = "tbb", .limit = 0.7 } } };
    addRuntimes(workload, kAllRuntimes, Work::Tree, [&](RuntimeKind kind) -> Contender {
        auto runtime = runtimeOf(kind, settings);
        const uint32_t leaves = std::min(1u << depth, runtime->affordableLeaves());
        const auto work = [leaves](Runtime& r, uint64_t repeats) {
            for (uint64_t i = 0; i < repeats; ++i)
                FILAMENT_ASSERT(r.tree(static_cast<uint32_t>(std::bit_width(leaves)) - 1) == leaves,
                                "a fork-join tree has visited all of its leaves when it returns");
        };
        return { toString(kind), timed(runtime, work, leaves - 1, settings.sampleNs),
                 scaledNote(leaves, 1u << depth, "leaves") };
    });
    return workload;
}

using ChainOf = void (Runtime::*)(uint32_t links, uint64_t repeats);

Workload chain(Settings const& settings, const char* name, const char* of, Work kindOfWork, ChainOf chainOf,
               std::vector<Target> targets) {
    const uint32_t wanted = settings.quick ? 100 : 10'000;
    Workload workload{ .name = name,
                       .title = fmt::format("chain of {} {}", wanted, of),
                       .unit = "ns/link",
                       .kind = "jobs",
                       .contenders = {},
                       .targets = std::move(targets) };
    addRuntimes(workload, kAllRuntimes, kindOfWork, [&](RuntimeKind kind) -> Contender {
        auto runtime = runtimeOf(kind, settings);
        const uint32_t links = std::min(wanted, runtime->affordableJobs());
        const auto work = [=](Runtime& r, uint64_t repeats) { (r.*chainOf)(links, repeats); };
        return { toString(kind), timed(runtime, work, links, settings.sampleNs), scaledNote(links, wanted, "links") };
    });
    return workload;
}

} // namespace

void addJobWorkloads(WorkloadList& list, Settings const& settings) {
    const Target notSlower{ .figure = Figure::Ratio, .other = "tbb", .limit = 1.0 };
    list.push_back({ "single_job", [=] { return batch(settings, "single_job", 1, { notSlower }); } });
    list.push_back(
            { "batch_1k", [=] {
                 Target quarterFaster = notSlower;
                 quarterFaster.limit = 0.75;
                 return batch(settings, "batch_1k", settings.quick ? 64 : 1024, { { .limit = 75 }, quarterFaster });
             } });
    list.push_back({ "batch_64k", [=] { return batch(settings, "batch_64k", settings.quick ? 256 : 65'536, {}); } });
    list.push_back({ "tree_64k", [=] { return forkJoinTree(settings); } });
    list.push_back({ "chain_10k", [=] {
                        return chain(settings, "chain_10k", "continuations", Work::Chain, &Runtime::chain,
                                     { notSlower });
                    } });
    list.push_back(
            { "graph_10k", [=] { return chain(settings, "graph_10k", "groups", Work::Graph, &Runtime::graph, {}); } });
    list.push_back(
            { "relay_10k", [=] { return chain(settings, "relay_10k", "jobs", Work::Relay, &Runtime::relay, {}); } });
}

} // namespace filament_core::bench
