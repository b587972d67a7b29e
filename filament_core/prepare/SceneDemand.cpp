// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneDemand.h"

#include "base/math/Elementary.h"
#include "filament_core/prepare/DebugViews.h"
#include "filament_core/prepare/EffectTable.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament::prepare {
bool readsMotion(ViewCounts const& counts, Quality const& quality, Effects const& effects, DebugView debugView) {
    return debugView == DebugView::Motion || (effects.motionBlur.enabled && debugView == DebugView::None) ||
           (effects.screenSpaceReflections.enabled && counts.reflectiveDraws > 0) || gathersFrames(quality, debugView);
}

Quality drawnQuality(Quality const& quality, DebugView debugView) {
    Quality drawn = quality;
    if (showsLight(debugView)) return drawn;
    drawn.shadows = ShadowFilter::Off;
    drawn.refraction = RefractionSource::Environment;
    return drawn;
}

Effects drawnEffects(Effects const& effects, DebugView debugView) {
    Effects drawn = effects;
    if (showsLight(debugView)) return drawn;
    drawn.ambientOcclusion.enabled = false;
    drawn.screenSpaceReflections.enabled = false;
    return drawn;
}

float mipBias(uint2 size, uint2 shownSize, Quality const& quality, DebugView debugView) {
    if (quality.mipBias == MipBias::Off || !gathersFrames(quality, debugView)) return 0;
    const float2 scale = float2(size) / float2(shownSize);
    const float sharper = quality.mipBias == MipBias::Sharp ? 1.0f : 0.0f;
    return std::min(0.5f * elementary::log2(scale.x * scale.y), 0.0f) - sharper;
}

uint2 drawnSize(uint2 size, Resolution const& resolution, Quality const& quality, DebugView debugView) {
    const bool isEnlarged = resolution.upscaling != Upscaling::Off || gathersFrames(quality, debugView);
    if (!isEnlarged || debugView != DebugView::None) return size;
    return min(max(uint2(float2(size) * resolution.scale + 0.5f), 1u), size);
}

bool SceneDemand::changesColor() const {
    return std::ranges::any_of(kEffectTable,
                               [&](EffectRow const& row) { return row.has(kChangesColor) && needs(row.effect); });
}

SceneDemand findDemand(DemandInput const& input) {
    SceneDemand demand;
    const bool isLit = showsLight(input.debugView);
    for (EffectRow const& row : kEffectTable) {
        if (!row.demand.alone) continue;
        const bool isLeftOut = row.stage == EffectStage::Lighting && !isLit;
        demand.effects[static_cast<size_t>(row.effect)] =
                isLeftOut ? EffectDemand{ .reason = DemandReason::UnlitDebugView } : row.demand.alone(input);
    }
    for (EffectRow const& row : kEffectTable) {
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

} // namespace filament::prepare
