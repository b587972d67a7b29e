// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneDemand.h"

#include "base/Result.h"

#include <algorithm>
#include <cmath>

namespace filament::prepare {
namespace {

/// `reaching` lights of a kind reach into the view, `others` do not or are left out; some of those for their channels.
EffectDemand demandOfLights(uint32_t reaching, uint32_t others, uint32_t litDraws, uint32_t ofOtherChannels = 0) {
    others += ofOtherChannels;
    if (reaching == 0 && ofOtherChannels) return { false, DemandReason::OtherChannels, 0, others };
    if (reaching == 0) return { false, others ? DemandReason::OutOfView : DemandReason::NotInScene, 0, others };
    if (litDraws == 0) return { false, DemandReason::NothingLitVisible, reaching, others };
    return { true, DemandReason::ReachesLitSurfaces, reaching, others };
}

EffectDemand demandOfShadows(ShadowCounts const& counts) {
    if (!counts.isOn) return { .reason = DemandReason::SwitchedOff };
    if (counts.maps)
        return { true, DemandReason::DarkensWhatIsVisible, counts.maps, counts.mapsDrawn, counts.mapsOverBudget };
    if (counts.lights == 0) return { .reason = DemandReason::NotInScene };
    if (counts.receivers == 0) return { .reason = DemandReason::NothingReceives };
    return { false, DemandReason::NothingCasts, counts.mapsWithoutCasters };
}

EffectDemand demandOfColoredShadows(ShadowCounts const& counts) {
    if (!counts.isOn || !counts.isColorOn) return { .reason = DemandReason::SwitchedOff };
    if (counts.coloredMaps == 0) return { false, DemandReason::NothingTransmits, counts.maps };
    return { true, DemandReason::TintsShadows, counts.coloredMaps, counts.maps - counts.coloredMaps };
}

EffectDemand demandOfDraws(uint32_t draws) {
    return draws ? EffectDemand{ true, DemandReason::IsVisible, draws } : EffectDemand{};
}

EffectDemand demandOfDiscs(uint32_t inView, uint32_t outOfView) {
    if (inView) return { true, DemandReason::ShowsInSky, inView, outOfView };
    return { false, outOfView ? DemandReason::OutOfView : DemandReason::NotInScene, 0, outOfView };
}

EffectDemand demandOfOcclusion(DemandInput const& input) {
    if (input.quality.ao == AmbientOcclusionTerm::Off) return { .reason = DemandReason::SwitchedOff };
    if (input.effects.ambientOcclusion.intensity == 0) return { .reason = DemandReason::HasNoIntensity };
    if (input.counts.opaqueDraws == 0) return { .reason = DemandReason::NothingOpaque };
    if (!input.hasIndirectLight || input.counts.opaqueLitDraws == 0) return { .reason = DemandReason::NothingIndirect };
    return { true, DemandReason::DarkensIndirectLight, input.counts.opaqueLitDraws };
}

/// `draws` see the picture, if that is on.
EffectDemand demandOfPicture(uint32_t draws, bool isOn, uint32_t copiedPixels = 0) {
    if (draws == 0) return { .reason = DemandReason::NothingAsks };
    if (!isOn) return { .reason = DemandReason::SwitchedOff };
    return { true, DemandReason::SeesPicture, draws, copiedPixels };
}

EffectDemand demandOfMotion(DemandInput const& input) {
    if (!readsMotion(input.counts, input.quality, input.debugView)) return { .reason = DemandReason::NothingAsks };
    if (input.moved == 0) return { .reason = DemandReason::NothingMoves };
    return { true, DemandReason::MovesInView, input.moved };
}

EffectDemand demandOfContactShadows(ViewCounts const& counts) {
    if (counts.contactLights == 0) return { .reason = DemandReason::NothingAsks };
    if (counts.litDraws == 0) return { .reason = DemandReason::NothingLitVisible };
    if (counts.opaqueDraws == 0) return { .reason = DemandReason::NothingOpaque };
    return { true, DemandReason::LightsAskForIt, counts.contactLights };
}

EffectDemand demandOfFog(DemandInput const& input) {
    if (!input.effects.fog.enabled) return { .reason = DemandReason::SwitchedOff };
    if (input.effects.fog.density == 0 || input.effects.fog.maximumOpacity == 0)
        return { .reason = DemandReason::HasNoDensity };
    return { true, DemandReason::LiesInBetween };
}

/// Of an effect of the picture.
EffectDemand demandOfPictureEffect(DemandInput const& input, bool isOn, DemandReason reason) {
    if (!isOn) return { .reason = DemandReason::SwitchedOff };
    if (input.debugView != DebugView::None) return { .reason = DemandReason::NothingAsks };
    const bool shines = input.counts.visible > 0 || input.hasSky || input.discsInView > 0;
    if (!shines) return { .reason = DemandReason::NothingShines };
    return { true, reason };
}

EffectDemand demandOfBloom(DemandInput const& input) {
    if (input.effects.bloom.enabled && input.effects.bloom.strength == 0)
        return { .reason = DemandReason::HasNoIntensity };
    return demandOfPictureEffect(input, input.effects.bloom.enabled, DemandReason::SpreadsLight);
}

EffectDemand demandOfTaa(DemandInput const& input) {
    return demandOfPictureEffect(input, input.quality.antiAliasing == AntiAliasing::Taa, DemandReason::SmoothsEdges);
}

EffectDemand demandOfFxaa(DemandInput const& input) {
    const bool isOn = input.quality.antiAliasing == AntiAliasing::Fxaa;
    const EffectDemand demand = demandOfPictureEffect(input, isOn, DemandReason::SmoothsEdges);
    if (demand.isNeeded && input.counts.visible == 0) return { .reason = DemandReason::NothingHasEdges };
    return demand;
}

EffectDemand demandOfFocus(DemandInput const& input) {
    constexpr float kSharp = 0.5f; // pixels
    const EffectDemand demand =
            demandOfPictureEffect(input, input.effects.depthOfField.enabled, DemandReason::IsOutOfFocus);
    if (!demand.isNeeded) return demand;
    if (!(input.blurRadius > kSharp)) return { .reason = DemandReason::IsInFocus };
    return { true, demand.reason, static_cast<uint32_t>(std::ceil(input.blurRadius)) };
}

/// Of an effect that changes the picture wherever it is, nothing visible included.
EffectDemand demandOfFinish(DemandInput const& input, bool isOn, bool isNeutral, DemandReason neutral) {
    if (!isOn) return { .reason = DemandReason::SwitchedOff };
    if (isNeutral) return { .reason = neutral };
    if (input.debugView != DebugView::None) return { .reason = DemandReason::NothingAsks };
    return { true, DemandReason::ChangesPicture };
}

bool isNeutral(Grading grading) {
    const Grading neutral{ .enabled = grading.enabled,
                           .tonalRanges = grading.tonalRanges, // of equal factors
                           .midPoint = grading.midPoint };     // of straight curves
    return grading == neutral;
}

void setFinish(DemandInput const& input, SceneDemand& demand) {
    Effects const& effects = input.effects;
    const auto set = [&](Effect effect, bool isOn, bool isNeutral, DemandReason neutral) {
        demand.effects[static_cast<size_t>(effect)] = demandOfFinish(input, isOn, isNeutral, neutral);
    };
    ChromaticAberration const& aberration = effects.chromaticAberration;
    set(Effect::ChromaticAberration, aberration.enabled, aberration.strength == 0, DemandReason::HasNoIntensity);
    set(Effect::Vignette, effects.vignette.enabled, effects.vignette.color == float3(1), DemandReason::IsNeutral);
    set(Effect::Grading, effects.grading.enabled, isNeutral(effects.grading), DemandReason::IsNeutral);
    set(Effect::Grain, effects.grain.enabled, effects.grain.strength == 0, DemandReason::HasNoIntensity);
}

/// How many effects read the depths.
uint32_t readersOfDepth(DemandInput const& input, SceneDemand const& demand) {
    uint32_t readers = demand.needs(Effect::Taa) && input.cameraMoved ? 1 : 0;
    for (const Effect effect : { Effect::AmbientOcclusion, Effect::Reflections, Effect::Motion, Effect::ContactShadows,
                                 Effect::DepthOfField })
        readers += demand.needs(effect) ? 1 : 0;
    return readers;
}

/// `readers` of the depths run.
EffectDemand demandOfPrepass(DemandInput const& input, uint32_t readers) {
    if (input.counts.opaqueDraws == 0) return { .reason = DemandReason::NothingOpaque };
    if (readers) return { true, DemandReason::DepthIsRead, readers };
    if (input.quality.depthPrepass == DepthPrepass::On) return { true, DemandReason::SwitchedOn };
    return { .reason = DemandReason::DepthIsUnread };
}

EffectDemand demandOfDebugView(DemandInput const& input, SceneDemand const& demand) {
    ViewCounts const& counts = input.counts;
    const uint32_t lights = counts.litDraws ? counts.lights : 0; // otherwise no list is made
    const auto showsEffect = [&](Effect effect) -> EffectDemand {
        return { true, DemandReason::ShowsEffect, demand.needs(effect), static_cast<uint32_t>(input.debugView) };
    };
    switch (input.debugView) {
    case DebugView::None:
        return {};
    case DebugView::Cascades:
        return { true, DemandReason::ShowsCascades, input.cascades };
    case DebugView::Atlas:
        return { true, DemandReason::ShowsAtlas, input.shadows.maps, input.atlasSize };
    case DebugView::Froxels:
        return { true, DemandReason::ShowsFroxels, counts.froxels ? counts.longestFroxel : lights, counts.froxels };
    case DebugView::Lights:
        return { true, DemandReason::ShowsLights, lights };
    case DebugView::Occlusion:
    case DebugView::BentNormals:
        return showsEffect(Effect::AmbientOcclusion);
    case DebugView::Reflections:
        return showsEffect(Effect::Reflections);
    case DebugView::Refraction:
        return showsEffect(Effect::Refraction);
    case DebugView::Motion:
        return showsEffect(Effect::Motion);
    case DebugView::Fog:
        return showsEffect(Effect::Fog);
    }
    return {};
}

std::string describeDebugView(EffectDemand const& demand) {
    switch (demand.reason) {
    case DemandReason::ShowsCascades:
        return demand.count ? fmt::format("debugView=cascades: {} of the sun", demand.count)
                            : "debugView=cascades: none, the sun has no shadow map";
    case DemandReason::ShowsAtlas:
        return demand.count ? fmt::format("debugView=atlas: {} maps in {} x {} texels", demand.count, demand.others,
                                          demand.others)
                            : "debugView=atlas: black, there is no atlas ('shadows' says why)";
    case DemandReason::ShowsFroxels:
        return demand.others ? fmt::format("debugView=froxels: at most {} lights", demand.count)
                             : fmt::format("debugView=froxels: no grid, {} lights everywhere", demand.count);
    case DemandReason::ShowsEffect:
        return fmt::format("debugView={}{}", toString(static_cast<DebugView>(demand.others)),
                           demand.count ? "" : ": its effect does not run (its line says why)");
    default:
        return fmt::format("debugView=lights: at most {}", demand.count);
    }
}

std::string describeShining(Effect effect, EffectDemand const& demand) {
    if (effect == Effect::IndirectLight) return "the environment lights what is visible";
    if (effect == Effect::Sun && demand.count > 1)
        return fmt::format("the brightest of {}; the others are in the light list", demand.count);
    if (demand.leftOut)
        return fmt::format("{} in view; {} of them are dark: their profiles take more than 16 MiB", demand.count,
                           demand.leftOut);
    if (demand.count + demand.others == 1) return "shines on what is visible";
    return fmt::format("{} of {} shine on what is visible", demand.count, demand.count + demand.others);
}

} // namespace

bool readsMotion(ViewCounts const& counts, Quality const& quality, DebugView debugView) {
    return debugView == DebugView::Motion || (quality.ssr && counts.reflectiveDraws > 0) ||
           gathersFrames(quality, debugView);
}

SceneDemand findDemand(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    SceneDemand demand;
    const auto set = [&](Effect effect, EffectDemand const& of) { demand.effects[static_cast<size_t>(effect)] = of; };
    set(Effect::Sun,
        demandOfLights(counts.suns - counts.sunsOfOtherChannels, 0, counts.litDraws, counts.sunsOfOtherChannels));
    set(Effect::LightList, demandOfLights(counts.lights, counts.lightsOutOfView + counts.lightsOverLimit,
                                          counts.litDraws, counts.lightsOfOtherChannels));
    set(Effect::AreaLights, demandOfLights(counts.areaLights, counts.areaLightsLeftOut, counts.litDraws));
    EffectDemand profiles = demandOfLights(counts.profiledLights, counts.profiledLightsLeftOut, counts.litDraws);
    profiles.leftOut = counts.profilesOverLimit;
    set(Effect::LightProfiles, profiles);
    set(Effect::Shadows, demandOfShadows(input.shadows));
    set(Effect::ColoredShadows, demandOfColoredShadows(input.shadows));
    set(Effect::IndirectLight, demandOfLights(input.hasIndirectLight ? 1 : 0, 0, counts.litDraws));
    if (input.hasSky) set(Effect::Sky, { true, DemandReason::FillsBackground });
    set(Effect::SunDisc, demandOfDiscs(input.discsInView, input.discsOutOfView));
    set(Effect::Blending, demandOfDraws(counts.blendedDraws));
    set(Effect::Deformation, demandOfDraws(input.deformed));
    set(Effect::AmbientOcclusion, demandOfOcclusion(input));
    set(Effect::Refraction, demandOfPicture(counts.refractiveDraws,
                                            input.quality.refraction == RefractionSource::Screen, input.copiedPixels));
    set(Effect::Reflections, demandOfPicture(counts.reflectiveDraws, input.quality.ssr));
    set(Effect::Motion, demandOfMotion(input));
    set(Effect::ContactShadows, demandOfContactShadows(counts));
    set(Effect::Fog, demandOfFog(input));
    set(Effect::Taa, demandOfTaa(input));
    set(Effect::DepthOfField, demandOfFocus(input));
    set(Effect::AutoExposure,
        demandOfPictureEffect(input, input.effects.autoExposure.enabled, DemandReason::MeasuresPicture));
    set(Effect::Bloom, demandOfBloom(input));
    setFinish(input, demand);
    set(Effect::Fxaa, demandOfFxaa(input));
    set(Effect::DepthPrepass, demandOfPrepass(input, readersOfDepth(input, demand)));
    set(Effect::DebugView, demandOfDebugView(input, demand));
    return demand;
}

namespace {

const char* describeSwitch(Effect effect) {
    switch (effect) {
    case Effect::ColoredShadows:
        return "switched off: coloredShadows=off";
    case Effect::AmbientOcclusion:
        return "switched off: ao=off";
    case Effect::Refraction:
        return "switched off: refraction=environment";
    case Effect::Reflections:
        return "switched off: ssr=off";
    case Effect::Fog:
        return "switched off: fog=off";
    case Effect::Taa:
    case Effect::Fxaa:
        return "switched off: antiAliasing";
    case Effect::DepthOfField:
        return "switched off: depthOfField=off";
    case Effect::AutoExposure:
        return "switched off: autoExposure=off";
    case Effect::Bloom:
        return "switched off: bloom=off";
    case Effect::ChromaticAberration:
        return "switched off: chromaticAberration=off";
    case Effect::Vignette:
        return "switched off: vignette=off";
    case Effect::Grading:
        return "switched off: grading=off";
    case Effect::Grain:
        return "switched off: grain=off";
    default:
        return "switched off: shadows=off";
    }
}

const char* describeNobody(Effect effect) {
    switch (effect) {
    case Effect::Refraction:
        return "nothing in view refracts the picture";
    case Effect::Reflections:
        return "nothing in view reflects the picture";
    case Effect::Taa:
    case Effect::DepthOfField:
    case Effect::AutoExposure:
    case Effect::Bloom:
    case Effect::ChromaticAberration:
    case Effect::Vignette:
    case Effect::Grading:
    case Effect::Grain:
    case Effect::Fxaa:
        return "a debug view is shown";
    case Effect::Motion:
        return "no effect looks at the last picture";
    default:
        return "no light in view asks for them";
    }
}

} // namespace

const char* nameOf(Effect effect) {
    static constexpr std::array<const char*, kEffects> kNames{ "sun",
                                                               "light list",
                                                               "area lights",
                                                               "light profiles",
                                                               "shadows",
                                                               "coloured shadows",
                                                               "indirect light",
                                                               "sky",
                                                               "sun disc",
                                                               "blending",
                                                               "deformation",
                                                               "depth prepass",
                                                               "ambient occlusion",
                                                               "refraction",
                                                               "reflections",
                                                               "motion",
                                                               "contact shadows",
                                                               "fog",
                                                               "taa",
                                                               "depth of field",
                                                               "auto exposure",
                                                               "bloom",
                                                               "fringes",
                                                               "vignette",
                                                               "grading",
                                                               "grain",
                                                               "fxaa",
                                                               "debug view" };
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
    case DemandReason::DarkensWhatIsVisible:
        return fmt::format("{} map{}, {} of them drawn in this frame{}", demand.count, demand.count == 1 ? "" : "s",
                           demand.others,
                           demand.leftOut ? fmt::format("; {} do not fit: shadowAtlasMegabytes", demand.leftOut) : "");
    case DemandReason::TintsShadows:
        return fmt::format("light passes through casters in {} of {} maps", demand.count, demand.count + demand.others);
    case DemandReason::NothingTransmits:
        return fmt::format("no light passes through what casts ({} maps)", demand.count);
    case DemandReason::ShowsInSky:
        return fmt::format("{} of {} in view", demand.count, demand.count + demand.others);
    case DemandReason::ShowsCascades:
    case DemandReason::ShowsAtlas:
    case DemandReason::ShowsFroxels:
    case DemandReason::ShowsLights:
    case DemandReason::ShowsEffect:
        return describeDebugView(demand);
    case DemandReason::DepthIsRead:
        return demand.count == 1 ? "an effect reads the depths"
                                 : fmt::format("{} effects read the depths", demand.count);
    case DemandReason::SwitchedOn:
        return "depthPrepass=on";
    case DemandReason::DarkensIndirectLight:
        return fmt::format("darkens indirect light of {} draws", demand.count);
    case DemandReason::SeesPicture:
        return fmt::format("{} in view see{} the picture{}", demand.count, demand.count == 1 ? "s" : "",
                           demand.others ? fmt::format(", of which {} pixels are copied", demand.others) : "");
    case DemandReason::LightsAskForIt:
        return fmt::format("{} light{} for them", demand.count, demand.count == 1 ? " asks" : "s ask");
    case DemandReason::LiesInBetween:
        return "lies between the camera and what is visible";
    case DemandReason::MovesInView:
        return fmt::format("{} in view moved", demand.count);
    case DemandReason::SpreadsLight:
        return "spreads light of what is visible";
    case DemandReason::SmoothsEdges:
        return "smooths the edges of what is visible";
    case DemandReason::ChangesPicture:
        return "changes the whole picture";
    case DemandReason::IsOutOfFocus:
        return fmt::format("something visible is out of focus, by at most {} pixel{}", demand.count,
                           demand.count == 1 ? "" : "s");
    case DemandReason::IsInFocus:
        return "everything visible is in focus";
    case DemandReason::MeasuresPicture:
        return "measures how bright the picture is";
    case DemandReason::IsNeutral:
        return "its values change nothing";
    case DemandReason::NothingHasEdges:
        return "no surface is visible";
    case DemandReason::NothingShines:
        return "nothing is visible, not even a sky";
    case DemandReason::NothingMoves:
        return "nothing in view moves by itself";
    case DemandReason::DepthIsUnread:
        return "no effect reads depths";
    case DemandReason::NothingIndirect:
        return "no indirect light is seen";
    case DemandReason::NothingOpaque:
        return "nothing opaque is visible";
    case DemandReason::NothingAsks:
        return describeNobody(effect);
    case DemandReason::HasNoDensity:
        return "its density or opacity is 0";
    case DemandReason::HasNoIntensity:
        return "its intensity is 0";
    case DemandReason::SwitchedOff:
        return describeSwitch(effect);
    case DemandReason::NothingReceives:
        return "no surface in view receives shadows";
    case DemandReason::NothingCasts:
        return fmt::format("nothing that casts lies in the way of the light ({} maps tried)", demand.count);
    case DemandReason::NotInScene:
        if (effect == Effect::Shadows) return "no light that reaches what is visible casts shadows";
        return effect == Effect::Blending || effect == Effect::Deformation ? "none in view" : "none in the scene";
    case DemandReason::OtherChannels:
        return fmt::format("none of {} is on a channel of what is visible", demand.others);
    case DemandReason::OutOfView:
        if (effect == Effect::SunDisc) return fmt::format("none of {} is in view", demand.others);
        return fmt::format("none of {} reaches into the view", demand.others);
    case DemandReason::NothingLitVisible:
        return "no lit surface is visible";
    }
    return {};
}

} // namespace filament::prepare
