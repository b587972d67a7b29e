// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/DemandRows.h"

#include "tools/view/panels/PanelText.h"

namespace filament_core::view {

std::vector<EffectDecision const*> demandRows(std::vector<EffectDecision> const& decisions,
                                              DemandFilter const& filter) {
    std::vector<EffectDecision const*> rows;
    for (EffectDecision const& decision : decisions) {
        if (filter.onlyActive && !isActive(decision)) continue;
        if (filter.onlyPasses && !isPass(decision)) continue;
        if (matchesFilter(decision.name + ' ' + decision.reason, filter.words)) rows.push_back(&decision);
    }
    return rows;
}

DemandTotals totalsOf(std::vector<EffectDecision> const& decisions) {
    DemandTotals totals;
    for (EffectDecision const& decision : decisions) {
        (isPass(decision) ? totals.passes : totals.effects) += 1;
        if (isActive(decision)) (isPass(decision) ? totals.ran : totals.needed) += 1;
        totals.milliseconds += decision.gpuMilliseconds;
        totals.attachmentBytes += decision.attachmentBytes;
    }
    return totals;
}

} // namespace filament_core::view
