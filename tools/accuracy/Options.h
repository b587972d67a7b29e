// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-accuracy.
///   Fails   InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "toolkit/program/Shard.h"
#include "tools/accuracy/Measure.h"
#include "tools/accuracy/comparison/Comparison.h"
#include "tools/accuracy/interiors/InteriorTable.h"

#include <filesystem>
#include <optional>

namespace filament_core::accuracy {

struct Options {
    std::filesystem::path effects, scenes, out = "accuracy";
    std::filesystem::path page;                 ///< docs/accuracy.html; empty: OUT/accuracy.html
    std::vector<std::filesystem::path> include; ///< HTML fragments with further sections
    std::vector<std::string> effect;            ///< names; empty: all
    std::optional<tools::Shard> shard;          ///< --shard: only these rows; writes results.json and no page
    std::vector<std::filesystem::path> merge;   ///< shards; empty: measure
    bool list = false, plots = true;
    std::filesystem::path rooms; ///< --rooms: write the generated rooms into this folder, and measure nothing
    std::optional<ComparisonOptions> comparison; ///< --compare: this instead of the effects
    std::optional<InteriorOptions> interiors;    ///< --interiors: this instead of the effects
    MeasureOptions measure{};
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::accuracy
