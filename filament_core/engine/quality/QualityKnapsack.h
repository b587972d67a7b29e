// SPDX-License-Identifier: Apache-2.0
/// QualityKnapsack: one option of every group, least error within a time: the multiple-choice knapsack, exactly.
///   Method  groups are added one after the other; of the partial sums only the Pareto set is kept, those that no other
///           one beats in time and error. Sums of whole numbers: what is dropped early could never have won.
///   Source  Kellerer, Pferschy, Pisinger 2004, "Knapsack Problems", section 11.5 (dominance in dynamic programs).
///   Ties    equal time and error: most defaults, then the earlier options of the earlier groups.
///   Limits  the Pareto set can be as large as the product of the options; tables that readQualityCosts() takes stay
///           below a million, measured ones below a thousand.
///   Thread  pure.
#pragma once

#include <filament/QualityBudget.h>

#include <cstdint>
#include <vector>

namespace filament::engine {

/// Values of one or two choices that belong together.
struct BudgetOption {
    struct Pick {
        QualityEffect const* effect;
        QualityCost const* cost;
    };
    std::vector<Pick> picks; ///< none: the group's choices stay as they are
    int64_t nanoseconds = 0; ///< more than the default's
    int64_t error = 0;       ///< squared, in 1e-12
    uint32_t changes = 0;    ///< picks that are not defaults
};

struct BudgetGroup {
    std::vector<BudgetOption> options; ///< never empty
};

struct BudgetPoint {
    int64_t nanoseconds = 0; ///< of the frame
    int64_t error = 0;
    uint32_t changes = 0;
    std::vector<uint16_t> options; ///< one of each group
};

/// The choices of the table as groups; `frameMilliseconds` is what a frame of defaults takes.
std::vector<BudgetGroup> budgetGroups(QualityCosts const& costs, Backend backend, double frameMilliseconds,
                                      Quality const& start);

/// All points that no other one beats, time ascending, error descending. Never empty.
std::vector<BudgetPoint> paretoPoints(std::vector<BudgetGroup> const& groups, double frameMilliseconds);

double millisecondsOf(int64_t nanoseconds);
double errorOf(int64_t squared);

} // namespace filament::engine
