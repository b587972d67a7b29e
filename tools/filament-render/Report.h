// SPDX-License-Identifier: Apache-2.0
/// Report: the measurements of a run, as report.json and as text.
///   Units   milliseconds unless a key says otherwise; "seconds" keys count from the start of the engine.
///   Thread  any; no shared state.
///   Fails   writeReport: Unreadable with the path.
#pragma once

#include "toolkit/pictures/ImageCompare.h"
#include "tools/filament-render/BackendRun.h"

#include <optional>
#include <span>
#include <string>

namespace filament_core::tools {

struct ReportInput {
    Options const& options;
    std::filesystem::path model, environment; ///< as loaded; the environment may be empty
    std::span<const BackendRun> runs;
    std::optional<ImageComparison> comparison;
    std::vector<std::string> errors; ///< why a requested backend is missing
};

Result<void> writeReport(std::filesystem::path const& path, ReportInput const& input);

/// The text that --timing prints.
std::string timingText(BackendRun const& run);

} // namespace filament_core::tools
