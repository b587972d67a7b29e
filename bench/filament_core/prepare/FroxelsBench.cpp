// SPDX-License-Identifier: Apache-2.0
// The cost of assigning lights to froxels: milliseconds of wall clock (medians), with 0 workers besides the caller, or 1.
// Lights of a hall of 60 x 10 x 60 metres, which the camera looks along; every eighth is a spot. `range`: centimetres.
#include "bench/filament_core/prepare/PrepareSetup.h"
#include "filament_core/prepare/Froxels.h"

#include <cmath>

namespace filament::prepare {
namespace {

std::vector<shader::PunctualLight> hall(uint32_t count, float range) {
    Random random(count);
    std::vector<shader::PunctualLight> lights(count);
    for (uint32_t i = 0; i < count; ++i) {
        const bool isSpot = i % 8 == 0;
        const float cosine = std::cos(0.5f);
        lights[i].positionRange = { random.within(-30, 30), random.within(-5, 5), random.within(-60, 0),
                                    1 / (range * range) };
        lights[i].colorIntensity = { 1, 1, 1, isSpot ? 1 : 0 };
        lights[i].directionScale = { 0, -1, 0, 10 };
        lights[i].offset = { -cosine * 10, 0, 0, 0 };
    }
    return lights;
}

void assign(benchmark::State& state) {
    const auto lights = hall(static_cast<uint32_t>(state.range(0)), static_cast<float>(state.range(1)) / 100);
    jobs::JobSystem jobs({ .workers = static_cast<int>(state.range(2)) });
    const ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } };
    const ViewSpace space = makeViewSpace(view);
    shader::FrameUniforms frame{};
    ViewCounts counts;
    Arena arena;
    Samples samples;
    for (auto _ : state) {
        arena.reset();
        counts = {};
        state.SetIterationTime(samples.time(
                [&] { benchmark::DoNotOptimize(assignLights(jobs, arena, space, view.size, lights, frame, counts)); }));
    }
    state.counters["ms"] = samples.wall() * 1e3;
    state.counters["entries"] = counts.froxelEntries;
    state.counters["longest"] = counts.longestFroxel;
    state.counters["froxels"] = counts.froxels;
}

BENCHMARK(assign)
        ->ArgNames({ "lights", "range", "workers" })
        ->ArgsProduct({ { 8, 64, 512, 4096 }, { 50, 200, 1000 }, { 0, 1 } })
        ->UseManualTime();

} // namespace
} // namespace filament::prepare
