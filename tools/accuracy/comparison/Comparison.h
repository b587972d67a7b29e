// SPDX-License-Identifier: Apache-2.0
/// Comparison: compares the engine's pictures with the path tracer's, and explains each difference by named
/// approximations.
///   In      rows of comparison/rows.json: a scene, samples, and how much may stay unexplained.
///   Out     for every row the pictures of its ladder (Ladder.h) and the contribution of each step.
///   Thread  one at a time; the reference works on the job system.
///   Fails   Unreadable, InvalidArgument: file, row, field. A row with missing assets is skipped with the reason.
///   Memory  the pictures of a row, ten of them.
///   Cost    for a row of 240 x 136 pixels and 256 samples, about 20 core seconds.
#pragma once

#include "tools/accuracy/Results.h"
#include "tools/accuracy/SceneLibrary.h"
#include "tools/accuracy/comparison/ClosedForms.h"
#include "tools/accuracy/comparison/Difference.h"
#include "tools/accuracy/comparison/Ladder.h"

#include <filament_core/Engine.h>

#include <functional>

namespace filament_core::accuracy {

/// One line of the table.
struct ComparisonRow {
    std::string name, title, scene;
    uint32_t samples = 256;         ///< a pixel, of the reference
    double unexplained = 0.02;      ///< most relative RMS difference that may stay without a name, beyond the noise
    std::vector<std::string> set{}; ///< settings of the engine, for all rungs
    std::string step{};             ///< that the row is about
    double limit = 1;               ///< most that this step may change, relative RMS
};

struct StepResult {
    std::string name, title, approximate, exact;
    double own = 0;   ///< RMS of what changes with this step
    double left = 0;  ///< RMS against the path tracer, once this and all steps before it are exact
    double share = 0; ///< of the whole squared difference; all shares add up to 1
    double bias = 0;  ///< mean: > 0 where the approximation is too bright
};

struct RowResult {
    ComparisonRow row;
    uint2 size{ 0, 0 };
    double rms = 0, bias = 0; ///< the engine's frame against the path tracer's
    double flip = 0;          ///< mean, of the tone-mapped pictures
    double eightBits = 0;     ///< RMS of what the engine's 8 bits a component change, in units of a display's white
    double noise = 0;         ///< RMS standard error of the reference that follows the engine, relative
    double tracedNoise = 0;   ///< noise of the path tracer's latest image
    double unexplained = 0;   ///< the step without a name, noise taken off
    double seconds = 0;       ///< of the references
    std::vector<StepResult> steps, alternatives;
    std::vector<Picture> pictures; ///< of the rungs, the path tracer's last
    bool isExplained() const { return unexplained <= row.unexplained; }
    /// RMS of the step that the row examines; 0 if it examines none.
    double stepError() const;
    bool isWithinLimit() const { return stepError() <= row.limit; }
};

struct ComparisonResults {
    std::string machine, commit, date;
    std::vector<ClosedForm> closedForms; ///< the path tracer's own check
    std::vector<RowResult> rows;
    std::vector<Skipped> skipped;
};

struct ComparisonOptions {
    std::filesystem::path rows, scenes;
    tools::SceneFolders folders{};
    std::vector<std::string> chosen{}; ///< names; empty: all
    Backend backend = Backend::Vulkan; ///< the other one draws the same bits
    uint2 size{ 240, 136 };
    uint32_t mostSamples = 1u << 20; ///< at most so many of the reference, whatever the row says
};

Result<std::vector<ComparisonRow>> readComparisonRows(std::filesystem::path const& file);

/// The current step, and the fraction done.
using ComparisonProgress = std::function<void(std::string const& what, double done)>;

Result<ComparisonResults> comparePictures(ComparisonOptions const& options, ComparisonProgress const& progress);

} // namespace filament_core::accuracy
