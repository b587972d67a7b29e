// SPDX-License-Identifier: Apache-2.0
// The cost of baking an environment of 1024 x 512, step by step, and of loading it again. Needs no assets: the sky is
// analytic.
#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/environment/Environment.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/tables/DfgTable.h"

#include <benchmark/benchmark.h>

#include <filesystem>

#include <unistd.h>

namespace filament_core::assets {
namespace {

struct Fixture {
    jobs::JobSystem jobs;
    HdrImage sky = makeAnalyticSky({}, jobs).value();
    IblCube cube = cubeFromEquirect(sky, 256, jobs);
};

Fixture& fixture() {
    static Fixture instance;
    return instance;
}

void projectPicture(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(cubeFromEquirect(fixture().sky, 256, fixture().jobs));
}
BENCHMARK(projectPicture)->Unit(benchmark::kMillisecond)->UseRealTime();

void prefilter(benchmark::State& state) {
    const auto pieces = static_cast<uint32_t>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(prefilterSpecular(fixture().cube, 256, pieces, fixture().jobs));
}
BENCHMARK(prefilter)
        ->ArgName("pieces")
        ->Arg(128)
        ->Arg(256)
        ->Arg(512)
        ->Arg(1024)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();

void projectSh(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(irradianceSh(fixture().cube[0], fixture().jobs));
}
BENCHMARK(projectSh)->Unit(benchmark::kMillisecond)->UseRealTime();

void dfgTable(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(bakeDfgTable(fixture().jobs));
}
BENCHMARK(dfgTable)->Unit(benchmark::kMillisecond)->UseRealTime();

void load(benchmark::State& state, bool warm) {
    const auto folder = std::filesystem::temp_directory_path() / ("ibl-bench-" + std::to_string(::getpid()));
    EnvironmentOptions options{ .cacheDirectory = folder / "cache" };
    if (!writeHdr(folder / "sky.hdr", fixture().sky) || !loadEnvironment(folder / "sky.hdr", fixture().jobs, options)) {
        state.SkipWithError("the folder for temporary files cannot be written");
        return;
    }
    options.useCache = warm;
    for (auto _ : state) benchmark::DoNotOptimize(loadEnvironment(folder / "sky.hdr", fixture().jobs, options));
    std::filesystem::remove_all(folder);
}
BENCHMARK_CAPTURE(load, cold, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(load, warm, true)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace filament_core::assets
