// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneDemand.h"

#include "base/Result.h"

namespace filament::prepare {
namespace {

/// `reaching` lights of a kind reach into the view, `others` do not or are left out.
EffectDemand demandOfLights(uint32_t reaching, uint32_t others, uint32_t litDraws) {
    if (reaching == 0) return { false, others ? DemandReason::OutOfView : DemandReason::NotInScene, 0, others };
    if (litDraws == 0) return { false, DemandReason::NothingLitVisible, reaching, others };
    return { true, DemandReason::ReachesLitSurfaces, reaching, others };
}

EffectDemand demandOfDraws(uint32_t draws) {
    return draws ? EffectDemand{ true, DemandReason::IsVisible, draws } : EffectDemand{};
}

std::string describeShining(Effect effect, EffectDemand const& demand) {
    if (effect == Effect::IndirectLight) return "the environment lights what is visible";
    if (effect == Effect::Sun && demand.count > 1)
        return fmt::format("the brightest of {}; the others are in the light list", demand.count);
    if (demand.count + demand.others == 1) return "shines on what is visible";
    return fmt::format("{} of {} shine on what is visible", demand.count, demand.count + demand.others);
}

} // namespace

SceneDemand findDemand(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    SceneDemand demand;
    const auto set = [&](Effect effect, EffectDemand const& of) { demand.effects[static_cast<size_t>(effect)] = of; };
    set(Effect::Sun, demandOfLights(counts.suns, 0, counts.litDraws));
    set(Effect::LightList,
        demandOfLights(counts.lights, counts.lightsOutOfView + counts.lightsOverLimit, counts.litDraws));
    set(Effect::IndirectLight, demandOfLights(input.hasIndirectLight ? 1 : 0, 0, counts.litDraws));
    if (input.hasSky) set(Effect::Sky, { true, DemandReason::FillsBackground });
    set(Effect::Blending, demandOfDraws(counts.blendedDraws));
    set(Effect::Deformation, demandOfDraws(input.deformed));
    return demand;
}

const char* nameOf(Effect effect) {
    static constexpr std::array<const char*, kEffects> kNames{ "sun", "light list", "indirect light",
                                                               "sky", "blending",   "deformation" };
    return kNames[static_cast<size_t>(effect)];
}

std::string describe(Effect effect, EffectDemand const& demand) {
    switch (demand.reason) {
    case DemandReason::ReachesLitSurfaces:
        return describeShining(effect, demand);
    case DemandReason::IsVisible:
        return fmt::format("{} in view", demand.count);
    case DemandReason::FillsBackground:
        return "fills what nothing covers";
    case DemandReason::NotInScene:
        return effect == Effect::Blending || effect == Effect::Deformation ? "none in view" : "none in the scene";
    case DemandReason::OutOfView:
        return fmt::format("none of {} reaches into the view", demand.others);
    case DemandReason::NothingLitVisible:
        return "no lit surface is visible";
    }
    return {};
}

} // namespace filament::prepare
