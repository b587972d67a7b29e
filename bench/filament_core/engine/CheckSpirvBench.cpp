// SPDX-License-Identifier: Apache-2.0
// Checking a package that is not the engine's own, which happens once a material: small beside compiling it.
#include "filament_core/engine/materials/CheckSpirv.h"

#include "shaders/package/EngineMaterials.h"

#include <benchmark/benchmark.h>

namespace filament_core::engine {
namespace {

void checkPackage(benchmark::State& state) {
    const auto package = shader::readPackage(shader::engineMaterial("gltf_lit_opaque"));
    if (!package) return state.SkipWithError(package.error().message.c_str());
    for (auto _ : state) {
        const Result<void> checked = checkSpirv(*package);
        if (!checked) return state.SkipWithError(checked.error().message.c_str());
    }
    state.counters["variants"] = static_cast<double>(package->variants.size());
}
BENCHMARK(checkPackage)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace filament_core::engine
