// SPDX-License-Identifier: Apache-2.0
// Whether frames take the time that a cost table predicts: a table is measured, the time of each preset buys settings,
// and frames with them are drawn in turns with the defaults. Processor time: Mesa's devices run on the processor.
#include "tests/filament_core/engine/quality/MeasuredFloor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <utility>
#include <vector>

namespace filament_core {
namespace {

constexpr uint32_t kRounds = 31;

/// Ratio of the frame times of `quality` to those of the defaults: the median of the faster half of the rounds.
double ratioToDefault(Engine& engine, test::Floor& floor, Quality const& quality) {
    Renderer renderer(engine, { .passTimers = true });
    const Owned<SwapChain> target =
            engine.own(engine.create(SwapChainDesc{ .size = floor.view().size, .imageCount = 1 }));
    const auto milliseconds = [&](Quality const& drawn) {
        floor.view().quality = drawn;
        const std::clock_t before = std::clock();
        renderer.render(floor.scene(), floor.view(), target);
        engine.waitIdle();
        return static_cast<double>(std::clock() - before) * 1000 / CLOCKS_PER_SEC;
    };
    milliseconds(quality), milliseconds({});
    std::vector<std::pair<double, double>> rounds; // both together, and their ratio
    for (uint32_t round = 0; round < kRounds; ++round) {
        const double chosen = milliseconds(quality), standard = milliseconds({});
        rounds.emplace_back(chosen + standard, chosen / standard);
    }
    floor.view().quality = {};
    std::ranges::sort(rounds);
    rounds.resize(kRounds / 2);
    std::ranges::sort(rounds, {}, &std::pair<double, double>::second);
    return rounds[kRounds / 4].second;
}

bool measure(Backend backend) {
    auto engine = Engine::create({ .backend = backend, .workers = 1 });
    if (!engine) {
        fmt::print(stderr, "{}: {}\n", toString(backend), engine.error().message);
        return false;
    }
    test::Floor floor(*engine);
    const Result<QualityCosts> costs =
            measureQualityCosts(*engine, floor.scene(), floor.view(), test::measurementOfPresets(kRounds));
    if (!costs) {
        fmt::print(stderr, "{}: {}\n", toString(backend), costs.error().message);
        return false;
    }
    for (const QualityPreset preset : { QualityPreset::Low, QualityPreset::High, QualityPreset::Reference }) {
        const test::Bought bought = test::buyForPreset(preset, backend, *costs);
        const double measured =
                ratioToDefault(*engine, floor, bought.decision.quality) * costs->frameMilliseconds(backend);
        fmt::print("{} {}: budget {:.2f} ms, predicted {:.2f} ms, measured {:.2f} ms, {:+.1f} % of the budget\n",
                   toString(backend), toString(preset), bought.milliseconds, bought.decision.predicted.milliseconds,
                   measured, 100 * (measured / bought.milliseconds - 1));
    }
    return true;
}

} // namespace
} // namespace filament_core

int main(int argc, char**) {
    if (argc > 1) {
        std::puts("quality_bench: measures on both APIs; it has no options");
        return 0;
    }
    const bool isWhole = filament_core::measure(filament_core::Backend::Vulkan) &&
                         filament_core::measure(filament_core::Backend::Gles);
    return isWhole ? 0 : 1;
}
