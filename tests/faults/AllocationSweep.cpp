// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/AllocationSweep.h"

#include "tests/faults/FaultStage.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace filament_core::test {
namespace {

/// Uses no heap memory itself, because live blocks are counted around it.
struct Outcome {
    bool struck = false;
    std::array<char, 160> text{};
};

Outcome runOnce(Sweep const& sweep, uint64_t at, std::function<std::unique_ptr<Scenario>()> const& make) {
    Outcome outcome;
    const std::unique_ptr<Scenario> scenario = make();
    AllocationFailure failure(sweep.whose, at, sweep.lasting, sweep.callers);
    const Result<void> result = scenario->act();
    outcome.struck = failure.stop();
    const std::string text = result.ok() ? "goes on" : result.error().message;
    text.copy(outcome.text.data(), outcome.text.size() - 1);
    if (!result.ok()) {
        EXPECT_TRUE(outcome.struck) << "an error although memory was there: " << text;
    }
    scenario->expectSound(result);
    return outcome;
}

std::string fileName(Sweep const& sweep) {
    std::string name = fmt::format("{} {}{}", sweep.name, toString(sweep.whose),
                                   sweep.lasting == Lasting::Onwards ? " onwards" : "");
    std::ranges::replace(name, ' ', '-');
    return name + ".txt";
}

} // namespace

uint64_t sweepAllocations(Sweep const& sweep, std::function<std::unique_ptr<Scenario>()> const& make) {
    const std::filesystem::path folder = faultFolder();
    std::filesystem::create_directories(folder);
    std::ofstream list(folder / fileName(sweep));
    runOnce(sweep, ~0u, make); // allocates what the process keeps
    const uint64_t stride = isStress() ? 1 : sweep.stride;
    uint64_t failed = 0;
    for (uint64_t at = 1;; at += stride) {
        const int64_t before = liveBlocks();
        const Outcome outcome = runOnce(sweep, at, make);
        const int64_t leaked = liveBlocks() - before;
        if (!outcome.struck) break;
        ++failed;
        const std::string site = AllocationFailure::lastSite();
        list << fmt::format("{:5} {}: {}\n", at, site, outcome.text.data());
        if (sweep.callers == Callers::All) {
            EXPECT_EQ(leaked, 0) << "blocks leaked";
        }
        if (!testing::Test::HasFailure()) continue;
        ADD_FAILURE() << sweep.name << ", " << toString(sweep.whose) << ", allocation " << at << " in " << site << ": "
                      << outcome.text.data();
        break;
    }
    list << failed << " allocations failed\n";
    return failed;
}

} // namespace filament_core::test
