// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneDemand.h"

#include "filament_core/prepare/DebugViews.h"
#include "filament_core/prepare/EffectTable.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::prepare {
bool SceneDemand::changesColor() const {
    return std::ranges::any_of(kEffectTable,
                               [&](EffectRow const& row) { return row.has(kChangesColor) && needs(row.effect); });
}

SceneDemand findDemand(DemandInput const& input) {
    SceneDemand demand;
    FrameSettings const& settings = input.settings;
    const bool isLit = showsLight(settings.debugView, settings.givesNumbers);
    const bool isMotion = givesMotion(settings.debugView, settings.givesNumbers);
    for (EffectRow const& row : kEffectTable) {
        if (!row.demand.alone) continue;
        const bool isShown = isMotion && row.effect == Effect::Motion;
        const bool isLeftOut = row.stage == EffectStage::Lighting && !isLit && !isShown;
        demand.effects[static_cast<size_t>(row.effect)] =
                isLeftOut ? EffectDemand{ .reason = DemandReason::UnlitDebugView } : row.demand.alone(input);
    }
    for (EffectRow const& row : kEffectTable) {
        // After all others: whether there is a depth prepass depends on the effects that read its depth.
        if (row.demand.byOthers) demand.effects[static_cast<size_t>(row.effect)] = row.demand.byOthers(input, demand);
    }
    return demand;
}

const char* nameOf(Effect effect) { return rowOf(effect).name; }

std::string describe(Effect effect, EffectDemand const& demand) {
    ReasonRow const& reason = rowOf(demand.reason);
    std::string text(demand.count == 1 && !reason.one.empty() ? reason.one : reason.text);
    if (demand.others) text += reason.others;
    if (demand.leftOut) text += reason.leftOut;
    const char* const shown = demand.others < kDebugViewCount ? toString(static_cast<DebugView>(demand.others)) : "";
    return fmt::format(fmt::runtime(text), fmt::arg("count", demand.count), fmt::arg("others", demand.others),
                       fmt::arg("leftOut", demand.leftOut), fmt::arg("all", demand.count + demand.others),
                       fmt::arg("hundredths", demand.count * 0.01), fmt::arg("debugView", shown),
                       fmt::arg("setting", rowOf(effect).setting), fmt::arg("unrequested", rowOf(effect).unrequested));
}

} // namespace filament_core::prepare
