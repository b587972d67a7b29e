// SPDX-License-Identifier: Apache-2.0
// Each choice of prepare compared with the plain alternative, measured in turns in one run. Counters named vs_* are
// ratios of medians of thread time; below 1 the engine is faster. If the results disagree, the benchmark fails.
#include "bench/filament_core/prepare/PrepareSetup.h"
#include "filament_core/prepare/LoadBoxes.h"

#include <cstring>

namespace filament_core::prepare {
namespace {

/// Eight boxes at a time, compared with one at a time, over the same columns.
void boxesAgainstScalar(benchmark::State& state) {
    Setup setup(state);
    scene::BoundsColumns const& bounds = setup.renderables().bounds;
    ViewSpace const& space = setup.space;
    const Frustum8 frustum(space.frustum);
    const size_t count = setup.count & ~size_t{ 7 };
    uint64_t lanes = 0, scalars = 0;
    Samples ours, scalar;
    for (auto _ : state) {
        state.SetIterationTime(ours.time([&] {
            for (size_t i = 0; i < count; i += 8) {
                lanes += static_cast<uint32_t>(std::popcount(
                        frustum.intersects(loadBoxes(bounds.four(i / 4), bounds.four(i / 4 + 1), space.cameraWorld))));
            }
        }));
        scalar.time([&] {
            for (size_t i = 0; i < count; ++i) {
                scalars += intersects(space.frustum, float3(bounds.centerAt(i) - space.cameraWorld),
                                      bounds.halfExtentAt(i));
            }
        });
    }
    if (lanes != scalars) state.SkipWithError("eight at a time and one at a time disagree");
    ours.report(state, setup.count);
    state.counters["vs_scalar"] = ours.threads() / scalar.threads();
}
BENCHMARK(boxesAgainstScalar)
        ->ArgNames({ kRenderables, kLooks, kWorkers })
        ->ArgsProduct({ { 1000, 10'000, 100'000 }, { 1 }, { 0 } })
        ->UseManualTime();

void sortAgainstStd(benchmark::State& state) {
    Setup setup(state);
    Samples ours, standard;
    for (auto _ : state) {
        setup.arena.reset();
        const std::span<SortItem> items = setup.keys();
        std::vector<SortItem> copy(items.begin(), items.end());
        std::span<const SortItem> order;
        state.SetIterationTime(ours.time([&] { order = sortItems(setup.jobs, setup.arena, items); }));
        standard.time([&] {
            std::sort(copy.begin(), copy.end(), [](SortItem const& a, SortItem const& b) {
                return a.key != b.key ? a.key < b.key : a.renderable < b.renderable;
            });
        });
        const auto same = [](SortItem const& a, SortItem const& b) { return a.renderable == b.renderable; };
        if (!std::ranges::equal(order, copy, same)) state.SkipWithError("sortItems and std::sort disagree");
    }
    ours.report(state, setup.count);
    state.counters["vs_std_sort"] = ours.threads() / standard.threads();
    state.counters["wall_vs_std_sort"] = ours.wall() / standard.wall();
}
BENCHMARK(sortAgainstStd)
        ->ArgNames({ kRenderables, kLooks, kWorkers })
        ->ArgsProduct({ { 32, 64, 128, 256, 512, 1000, 2000, 10'000, 100'000 }, { 1, 1024 }, { 0, 1 } })
        ->UseManualTime();

/// Objects written to upload memory directly, compared with objects written first and copied there.
void objectsAgainstCopy(benchmark::State& state) {
    Setup setup(state);
    UploadMemory first(setup.count), upload(setup.count);
    const ObjectList list{ setup.order(), setup.renderables().placement, setup.space.cameraWorld };
    Samples ours, copied;
    for (auto _ : state) {
        state.SetIterationTime(ours.time([&] { writeObjects(setup.jobs, list, upload.objects()); }));
        benchmark::ClobberMemory();
        copied.time([&] {
            writeObjects(setup.jobs, list, first.objects());
            std::memcpy(upload.objects().data(), first.objects().data(), first.objects().size_bytes());
        });
        benchmark::ClobberMemory();
    }
    ours.report(state, setup.count);
    state.counters["vs_copy"] = ours.threads() / copied.threads();
}
BENCHMARK(objectsAgainstCopy)
        ->ArgNames({ kRenderables, kLooks, kWorkers })
        ->ArgsProduct({ { 10'000, 100'000 }, { 1 }, { 0 } })
        ->UseManualTime();

} // namespace
} // namespace filament_core::prepare
