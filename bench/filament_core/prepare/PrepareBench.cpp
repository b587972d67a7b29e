// SPDX-License-Identifier: Apache-2.0
// The cost of preparing a frame, step by step and as a whole. Counters: nanoseconds per renderable, wall clock and all
// threads together (medians); everything is visible, except in cullSmall.
#include "bench/filament_core/prepare/PrepareSetup.h"
#include "filament_core/prepare/SelectLights.h"

namespace filament_core::prepare {
namespace {

/// Times `step`, which takes what `before` returns.
template <class Before, class Step>
void timeStep(benchmark::State& state, Setup& setup, Before&& before, Step&& step) {
    Samples samples;
    for (auto _ : state) {
        setup.arena.reset();
        auto input = before();
        state.SetIterationTime(samples.time([&] { benchmark::DoNotOptimize(step(input)); }));
    }
    samples.report(state, setup.count);
}

void cull(benchmark::State& state) {
    Setup setup(state);
    timeStep(
            state, setup, [] { return 0; }, [&](int) { return setup.cull(); });
}

/// At a resolution so low that most boxes are tested for covering a centre of a pixel.
void cullSmall(benchmark::State& state) {
    Setup setup(state);
    setup.view.size = { 16, 16 };
    setup.space = makeViewSpace(setup.view);
    timeStep(
            state, setup, [] { return 0; }, [&](int) { return setup.cull(); });
    state.counters["tooSmall"] = setup.counts.tooSmall;
}

void keys(benchmark::State& state) {
    Setup setup(state);
    timeStep(
            state, setup, [&] { return setup.cull(); },
            [&](VisibleItems const& visible) {
                return writeKeys(setup.jobs, setup.arena, setup.renderables(), visible);
            });
}

void sort(benchmark::State& state) {
    Setup setup(state);
    timeStep(
            state, setup, [&] { return setup.keys(); },
            [&](std::span<SortItem> items) { return sortItems(setup.jobs, setup.arena, items); });
}

void merge(benchmark::State& state) {
    Setup setup(state);
    DrawLists draws;
    timeStep(
            state, setup, [&] { return setup.order(); },
            [&](std::span<const SortItem> order) {
                return draws = mergeInstances(setup.jobs, setup.arena, setup.renderables(), order, setup.counts);
            });
    state.counters["draws"] = static_cast<double>(draws.opaque.size());
}

void objects(benchmark::State& state) {
    Setup setup(state);
    UploadMemory memory(setup.count);
    const ObjectList list{ setup.order(), setup.renderables().placement, setup.space.cameraWorld };
    Samples samples;
    for (auto _ : state) {
        state.SetIterationTime(samples.time([&] { writeObjects(setup.jobs, list, memory.objects()); }));
        benchmark::ClobberMemory();
    }
    samples.report(state, setup.count);
}

/// Point lights all over the scene, counters per light: shows how many of them are worth a job of their own.
void lights(benchmark::State& state) {
    scene::Lights points;
    Random random(7);
    for (int64_t i = 0; i < state.range(0); ++i) {
        points.records.push_back({ .type = scene::LightRecord::Type::Point,
                                   .positionWorld = { random.within(-20, 20), random.within(-20, 20), 0 },
                                   .intensity = static_cast<float>(random.within(1, 100)),
                                   .rangeMeters = 5 });
    }
    const ViewSpace space = makeViewSpace(BoxScene::cubeView(10'000));
    Arena arena;
    Samples samples;
    for (auto _ : state) {
        arena.reset();
        shader::FrameUniforms frame{};
        ViewCounts counts;
        state.SetIterationTime(samples.time(
                [&] { benchmark::DoNotOptimize(LightSelector(arena, points).select(space, frame, counts)); }));
    }
    samples.report(state, static_cast<uint32_t>(state.range(0)));
}
BENCHMARK(lights)->ArgName("lights")->Arg(16)->Arg(256)->Arg(4096)->UseManualTime();

/// The whole preparation: what a frame costs apart from recording.
void frame(benchmark::State& state) {
    Setup setup(state);
    UploadMemory memory(setup.count);
    Samples samples;
    for (auto _ : state) {
        setup.arena.reset();
        state.SetIterationTime(samples.time([&] {
            const FramePacket packet = prepareFrame(setup.jobs, setup.arena, setup.boxes.scene, setup.view);
            writeObjects(setup.jobs, packet.mainView().objects, memory.objects());
        }));
    }
    samples.report(state, setup.count);
}

/// Frames of `renderables` with shadow views besides the main one, each of which contains all of them; counters per
/// renderable and view.
void views(benchmark::State& state) {
    Setup setup(state);
    std::vector<ViewInput> inputs(static_cast<size_t>(state.range(3)), setup.view);
    for (ViewInput& input : std::span(inputs).subspan(1)) input.kind = ViewKind::Shadow;
    Samples samples;
    for (auto _ : state) {
        setup.arena.reset();
        state.SetIterationTime(samples.time(
                [&] { benchmark::DoNotOptimize(prepareFrame(setup.jobs, setup.arena, setup.boxes.scene, inputs)); }));
    }
    samples.report(state, setup.count * static_cast<uint32_t>(inputs.size()));
}
BENCHMARK(views)
        ->ArgNames({ kRenderables, kLooks, kWorkers, "views" })
        ->ArgsProduct({ { 10'000 }, { 1024 }, { 0, 1 }, { 1, 2, 5 } })
        ->UseManualTime();

void arguments(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({ kRenderables, kLooks, kWorkers })
            ->ArgsProduct({ { 1000, 10'000, 100'000 }, { 1, 1024 }, { 0, 1 } })
            ->UseManualTime();
}
BENCHMARK(cull)->Apply(arguments);
BENCHMARK(cullSmall)->Apply(arguments);
BENCHMARK(keys)->Apply(arguments);
BENCHMARK(sort)->Apply(arguments);
BENCHMARK(merge)->Apply(arguments);
BENCHMARK(objects)->Apply(arguments);
BENCHMARK(frame)->Apply(arguments);

} // namespace
} // namespace filament_core::prepare
