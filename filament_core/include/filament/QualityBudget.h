// SPDX-License-Identifier: Apache-2.0
/// QualityBudget: device time for one frame; chooseQuality() finds the setting with the least predicted error in it.
///   Model    time = frame + sum of what each choice adds; error = root of the sum of the squares: what differs from
///            the truth for different reasons adds up like that. A time that its own confidence interval cannot tell
///            from the default's is the default's.
///   Method   all combinations, by merging Pareto sets choice by choice: exact. Times are whole nanoseconds and squared
///            errors whole units of 1e-12, so that the answer is the same on every machine.
///   Ties     least error, then least time, then most defaults, then the first in the order of the table.
///   Joined   dfgTableSize only counts with splitSum=table, shBands only with diffuseIrradiance=sphericalHarmonics:
///            what does not matter keeps its default and costs nothing.
///   Fails    InvalidArgument: a budget that is not a positive number, a size of 0, a table without times for the
///            backend.
///   Thread   pure.  Cost: under a millisecond for the default table.
#pragma once

#include <filament/Quality.h>
#include <filament/QualityCosts.h>

#include <string>
#include <vector>

namespace filament {

struct QualityBudget {
    double gpuMilliseconds = 16;
    uint2 size{ 1280, 720 }; ///< of the frame: the table's times are scaled by the pixels
    Backend backend = Backend::Vulkan;
    /// What one's own frame of `size` takes with default Quality, measured with RendererOptions::passTimers; the table
    /// then says only how the values compare. 0: the table's own frame.
    double frameMilliseconds = 0;
};

/// One choice that differs from the cheapest setting.
struct QualityStep {
    std::string name, from, to;
    double milliseconds = 0;                ///< what it costs
    double errorBefore = 0, errorAfter = 0; ///< of the whole picture, with the steps before it and with this one, too
};

struct QualityPrediction {
    double milliseconds = 0, error = 0;
};

struct QualityDecision {
    Quality quality{};
    QualityPrediction predicted{};
    bool fits = true;               ///< false: even the cheapest setting is over the budget; it is what was chosen
    std::vector<QualityStep> steps; ///< from the cheapest setting to the chosen one, best value first
    /// The next better setting, and what it takes: empty if there is none.
    std::vector<QualityStep> nextSteps;
    QualityPrediction next{};
    std::string explanation; ///< all of this as lines of text
};

/// `start` gives what the table does not rate.
Result<QualityDecision> chooseQuality(QualityBudget const& budget, QualityCosts const& costs = defaultQualityCosts(),
                                      Quality const& start = {});

/// What the table says about one setting. InvalidArgument: a value that it does not rate.
Result<QualityPrediction> predictQuality(Quality const& quality, QualityBudget const& budget,
                                         QualityCosts const& costs = defaultQualityCosts());

} // namespace filament
