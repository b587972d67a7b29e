// SPDX-License-Identifier: Apache-2.0
/// QualityKnapsack: picks one option of every group with the least error in a given time: the multiple-choice knapsack,
/// solved exactly.
///   Method  groups are added one after the other, keeping only the Pareto set of partial sums: those that no other sum
///           beats in both time and error. Sums are integers, so a dropped sum could never have won.
///   Source  Kellerer, Pferschy, Pisinger 2004, "Knapsack Problems", section 11.5 (dominance in dynamic programs).
///   Ties    equal time and error: most defaults, then the earlier options of the earlier groups.
///   Limits  the Pareto set can be as large as the product of the options; tables accepted by readQualityCosts() stay
///           below a million, measured ones below a thousand.
///   Thread  pure.
#pragma once

#include <filament_core/QualityBudget.h>

#include <cstdint>
#include <vector>

namespace filament_core::engine {

/// Values of one choice, or of two choices that depend on each other.
struct BudgetOption {
    struct Pick {
        QualityEffect const* effect;
        QualityCost const* cost;
    };
    std::vector<Pick> picks; ///< none: the group's choices do not change
    int64_t nanoseconds = 0; ///< in addition to the default's
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
    std::vector<uint16_t> options; ///< one per group
};

/// The choices of the table as groups; `frameMilliseconds` is the time of a frame with defaults.
std::vector<BudgetGroup> budgetGroups(QualityCosts const& costs, Backend backend, double frameMilliseconds,
                                      Quality const& start);

/// All points that no other point beats, by ascending time and descending error. Never empty.
std::vector<BudgetPoint> paretoPoints(std::vector<BudgetGroup> const& groups, double frameMilliseconds);

double millisecondsOf(int64_t nanoseconds);
double errorOf(int64_t squared);

} // namespace filament_core::engine
