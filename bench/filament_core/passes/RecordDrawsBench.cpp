// SPDX-License-Identifier: Apache-2.0
// From a sorted draw list to commands: choosing pipelines, recording in ranges, replaying the result. `ns` is the
// median per draw. Counters named vs_* are ratios of medians measured in turns; below 1 means faster.
#include "bench/backend/stream/InTurns.h"
#include "tests/filament_core/passes/DrawFixture.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <tuple>

namespace filament_core::passes {
namespace {

using namespace backend;
using bench::measureInTurns;
using framegraph::PassContext;
using framegraph::RangeRecorder;
using prepare::DrawCall;

/// Sorted as by prepare: material, instance, geometry within a depth bucket. 16 materials, 128 instances, 1000
/// geometries; no two neighbours merge. About every 16th draw changes the material.
struct SortedList : DrawFixture {
    explicit SortedList(size_t count) : DrawFixture(16, 128, 1000) {
        std::mt19937 random(1);
        for (size_t i = 0; i < count; ++i) {
            draws.push_back(draw(static_cast<uint32_t>(random()), static_cast<uint32_t>(random()), 0));
        }
        constexpr size_t kBucket = 2000;
        for (size_t begin = 0; begin < count; begin += kBucket) {
            const auto order = [](DrawCall const& a, DrawCall const& b) {
                return std::tuple(a.material->material->id, a.material->id, a.geometry) <
                       std::tuple(b.material->material->id, b.material->id, b.geometry);
            };
            std::ranges::sort(std::span(draws).subspan(begin, std::min(kBucket, count - begin)), order);
        }
        for (size_t i = 0; i < count; ++i) draws[i].firstObject = static_cast<uint32_t>(i);
        CommandBuffer setup;
        pipelines = choose(draws, setup);
    }

    void record(CommandBuffer& commands, RangeRecorder* ranges) {
        commands.reset();
        PassContext pass(plan, commands, ranges);
        recordDrawRanges(pass, context, draws, pipelines);
    }

    std::vector<DrawCall> draws;
    std::vector<PipelineHandle> pipelines;
};

void arguments(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({ "draws", "workers" })->ArgsProduct({ { 1000, 10'000, 100'000 }, { 0, 1, 3 } })->UseManualTime();
}

void choosePipelinesInAFrameThatMakesNone(benchmark::State& state) {
    SortedList list(static_cast<size_t>(state.range(0)));
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(1)) });
    const jobs::AdoptedThread seat(jobs);
    RangeRecorder ranges(jobs);
    CommandBuffer setup;
    const auto chooseWith = [&](RangeRecorder* recorder) {
        PassContext pass(list.plan, setup, recorder);
        list.arena.reset();
        benchmark::DoNotOptimize(choosePipelines(pass, list.arena, PipelineSource(*list.DrawFixture::pipelines),
                                                 list.slot, list.draws, 0));
    };
    measureInTurns(
            state, list.draws.size(), "vs_serial", [&] { chooseWith(&ranges); }, [&] { chooseWith(nullptr); });
}
BENCHMARK(choosePipelinesInAFrameThatMakesNone)->Apply(arguments);

void recordDrawsInRanges(benchmark::State& state) {
    SortedList list(static_cast<size_t>(state.range(0)));
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(1)) });
    const jobs::AdoptedThread seat(jobs);
    RangeRecorder ranges(jobs);
    CommandBuffer parallel, serial;
    measureInTurns(
            state, list.draws.size(), "vs_serial", [&] { list.record(parallel, &ranges); },
            [&] { list.record(serial, nullptr); });
    state.counters["commandsPerDraw"] =
            static_cast<double>(serial.commandCount()) / static_cast<double>(list.draws.size());
}
BENCHMARK(recordDrawsInRanges)->Apply(arguments);

/// Replays the stream of the parallel recording on the null driver, as the driver thread does; compared with the serial
/// one.
void replayRecordedDraws(benchmark::State& state) {
    SortedList list(static_cast<size_t>(state.range(0)));
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(1)) });
    RangeRecorder ranges(jobs);
    CommandBuffer parallel, serial;
    list.record(parallel, &ranges);
    list.record(serial, nullptr);
    ReplayProgress progress;
    struct Silent final : ResultSink {
        void onReadback(Ticket, std::span<const std::byte>) override {}
        void onTimer(Ticket, uint64_t) override {}
        void onError(DriverErrorKind, std::string_view) override {}
    } sink;
    const std::unique_ptr<Driver> driver = createNullDriver(sink);
    const WatchedReplay watched(progress);
    measureInTurns(
            state, list.draws.size(), "vs_recordedSerially", [&] { driver->execute(parallel.view()); },
            [&] { driver->execute(serial.view()); });
}
BENCHMARK(replayRecordedDraws)->Apply(arguments);

} // namespace
} // namespace filament_core::passes
