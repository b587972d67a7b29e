// SPDX-License-Identifier: Apache-2.0
/// Report: what a run measured, as report.json and as text.
///   Units   milliseconds unless a key says otherwise; "seconds" keys count from the start of the engine.
///   Thread  any; no shared state.
///   Fails   writeReport: Unreadable with the path.
#pragma once

#include "tools/filament-render/BackendRun.h"
#include "tools/imgdiff/ImageCompare.h"

#include <optional>
#include <span>
#include <string>

namespace filament::tools {

struct ReportInput {
    Options const& options;
    std::filesystem::path model, environment; ///< as loaded; the environment may be empty
    std::span<const BackendRun> runs;
    std::optional<ImageComparison> comparison;
    std::vector<std::string> errors; ///< why a backend that was asked for is not there
};

Result<void> writeReport(std::filesystem::path const& path, ReportInput const& input);

/// What --timing prints.
std::string timingText(BackendRun const& run);

} // namespace filament::tools
