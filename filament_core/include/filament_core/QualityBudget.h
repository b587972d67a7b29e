// SPDX-License-Identifier: Apache-2.0
/// QualityBudget: device time for one frame; chooseQuality() finds the setting with the smallest predicted error that
/// fits.
///   Model    time = frame + sum of the time that each choice adds; error = root of the sum of squares, because errors
///            from different causes are independent. If a time's confidence interval includes the default's time, the
///            two count as equal.
///   Method   exact: all combinations, by merging Pareto sets choice by choice. Times are whole nanoseconds and squared
///            errors whole units of 1e-12, so the result is the same on every machine.
///   Ties     smallest error, then shortest time, then most defaults, then the order of the table.
///   Joined   dfgTableSize only matters with splitSum=table, shBands only with diffuseIrradiance=sphericalHarmonics.
///            Choices that do not matter keep their default and cost nothing.
///   Fails    InvalidArgument: a budget that is not a positive number, a size of 0, a table without times for the
///            backend.
///   Thread   pure.  Cost: under a millisecond for the default table.
#pragma once

#include <filament_core/Quality.h>
#include <filament_core/QualityCosts.h>

#include <string>
#include <vector>

namespace filament_core {

struct QualityBudget {
    double gpuMilliseconds = 16;
    uint2 size{ 1280, 720 }; ///< of the frame; the table's times are scaled by the number of pixels
    Backend backend = Backend::Vulkan;
    /// Time of your own frame of `size` with default Quality, measured with RendererOptions::passTimers. The table then
    /// only provides ratios. 0: the time of the table's own frame.
    double frameMilliseconds = 0;
};

/// One choice that differs from the cheapest setting.
struct QualityStep {
    std::string name, from, to;
    double milliseconds = 0;                ///< time that it adds
    double errorBefore = 0, errorAfter = 0; ///< of the image, without and with this step, after all earlier ones
};

struct QualityPrediction {
    double milliseconds = 0, error = 0;
};

struct QualityDecision {
    Quality quality{};
    QualityPrediction predicted{};
    bool fits = true;               ///< false: even the cheapest setting, which was chosen, exceeds the budget
    std::vector<QualityStep> steps; ///< from the cheapest setting to the chosen one, best value first
    /// The steps to the next better setting; empty if there is none.
    std::vector<QualityStep> nextSteps;
    QualityPrediction next{};
    std::string explanation; ///< all of this as lines of text
};

/// `start` provides the choices that the table does not rate.
Result<QualityDecision> chooseQuality(QualityBudget const& budget, QualityCosts const& costs = defaultQualityCosts(),
                                      Quality const& start = {});

/// The table's prediction for one setting. InvalidArgument: a value that the table does not rate.
Result<QualityPrediction> predictQuality(Quality const& quality, QualityBudget const& budget,
                                         QualityCosts const& costs = defaultQualityCosts());

} // namespace filament_core
