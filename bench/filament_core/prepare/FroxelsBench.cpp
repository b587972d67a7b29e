// SPDX-License-Identifier: Apache-2.0
// The cost of assigning lights to froxels: milliseconds of wall clock (medians), with 0 workers besides the caller, or
// 1. `assign`: lights of a hall of 60 x 10 x 60 metres, which the camera looks along; every eighth is a spot. `range`:
// centimetres. `assignMoving`: lamps around a model of one metre that fills the screen, moved before every call.
#include "bench/filament_core/prepare/PrepareSetup.h"
#include "filament_core/prepare/Froxels.h"

#include <cmath>

namespace filament_core::prepare {
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

/// Times assignLights() for what `lightsOf(call)` returns.
template <class LightsOf>
void assignEachCall(benchmark::State& state, Camera const& camera, int workers, LightsOf&& lightsOf) {
    jobs::JobSystem jobs({ .workers = workers });
    const ViewInput view{ .camera = camera, .size = { 1280, 720 } };
    const ViewSpace space = makeViewSpace(view);
    shader::FrameUniforms frame{};
    ViewCounts counts;
    Arena arena;
    Samples samples;
    uint32_t call = 0;
    for (auto _ : state) {
        std::span<const shader::PunctualLight> lights = lightsOf(call++);
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

void assign(benchmark::State& state) {
    const auto lights = hall(static_cast<uint32_t>(state.range(0)), static_cast<float>(state.range(1)) / 100);
    assignEachCall(state, Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), static_cast<int>(state.range(2)),
                   [&](uint32_t) -> std::span<const shader::PunctualLight> { return lights; });
}

/// The lamps of FroxelBits.LittlestTokyoUnder4096LampsHasTheBitsOfOneList, each on a circle of its own.
void assignMoving(benchmark::State& state) {
    const auto count = static_cast<uint32_t>(state.range(0));
    Random random(count);
    std::vector<shader::PunctualLight> lights(count);
    std::vector<float3> centers(count);
    for (uint32_t i = 0; i < count; ++i) {
        const auto range = static_cast<float>(random.within(0.01, 0.07));
        centers[i] = { random.within(-0.4, 0.4), random.within(-0.4, 0.4), random.within(-0.4, 0.4) };
        lights[i].positionRange.w = 1 / (range * range);
        lights[i].colorIntensity = { 1, 1, 1, 0 };
    }
    assignEachCall(state, Camera::lookAt({ 0.9, 0.6, 1.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 }),
                   static_cast<int>(state.range(1)), [&](uint32_t call) {
                       for (uint32_t i = 0; i < count; ++i) {
                           const float angle = 0.05f * static_cast<float>(call) + static_cast<float>(i);
                           const float3 at = centers[i] + 0.05f * float3(std::cos(angle), std::sin(angle), 0);
                           lights[i].positionRange = float4(at - float3(0.9f, 0.6f, 1.5f), lights[i].positionRange.w);
                       }
                       return std::span<const shader::PunctualLight>(lights);
                   });
}

BENCHMARK(assignMoving)->ArgNames({ "lights", "workers" })->ArgsProduct({ { 512, 4096 }, { 0, 1 } })->UseManualTime();
BENCHMARK(assign)
        ->ArgNames({ "lights", "range", "workers" })
        ->ArgsProduct({ { 8, 64, 512, 4096 }, { 50, 200, 1000 }, { 0, 1 } })
        ->UseManualTime();

} // namespace
} // namespace filament_core::prepare
