// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SceneDemand.h"

#include "base/Result.h"
#include "base/math/Elementary.h"

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

EffectDemand demandOfStencil(ViewCounts const& counts) {
    if (counts.stencilDraws == 0) return { .reason = DemandReason::NothingAsks };
    return { true, DemandReason::IsVisible, counts.stencilDraws };
}

EffectDemand demandOfTransparency(DemandInput const& input) {
    Quality const& quality = input.quality;
    if (!asksForAnyOrder(quality, DebugView::None)) return { .reason = DemandReason::SwitchedOff };
    if (!asksForAnyOrder(quality, input.debugView)) return { .reason = DemandReason::NothingAsks };
    const uint32_t objects = input.counts.anyOrderObjects;
    if (!overlaps(objects)) return { false, DemandReason::NothingOverlaps, objects };
    const bool isPeeled = quality.transparency == TransparencyOrder::Peeled;
    return { true, DemandReason::MayOverlap, objects, isPeeled ? quality.transparencyLayers : 0u };
}

EffectDemand demandOfDiscs(uint32_t inView, uint32_t outOfView) {
    if (inView) return { true, DemandReason::ShowsInSky, inView, outOfView };
    return { false, outOfView ? DemandReason::OutOfView : DemandReason::NotInScene, 0, outOfView };
}

EffectDemand demandOfOcclusion(DemandInput const& input) {
    if (!input.effects.ambientOcclusion.enabled) return { .reason = DemandReason::SwitchedOff };
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
    if (!readsMotion(input.counts, input.quality, input.effects, input.debugView))
        return { .reason = DemandReason::NothingAsks };
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

/// Of an effect of the picture; `shown`: the debug view that shows it.
EffectDemand demandOfPictureEffect(DemandInput const& input, bool isOn, DemandReason reason,
                                   DebugView shown = DebugView::None) {
    if (!isOn) return { .reason = DemandReason::SwitchedOff };
    if (input.debugView != DebugView::None && input.debugView != shown) return { .reason = DemandReason::NothingAsks };
    const bool shines = input.counts.visible > 0 || input.hasSky || input.discsInView > 0;
    if (!shines) return { .reason = DemandReason::NothingShines };
    return { true, reason };
}

EffectDemand demandOfBloom(DemandInput const& input) {
    Bloom const& bloom = input.effects.bloom;
    if (bloom.enabled && bloom.strength == 0) return { .reason = DemandReason::HasNoIntensity };
    EffectDemand demand = demandOfPictureEffect(input, bloom.enabled, DemandReason::SpreadsLight);
    if (demand.isNeeded && bloom.dirt && bloom.dirtStrength > 0) demand.count = 1;
    return demand;
}

EffectDemand demandOfFlare(DemandInput const& input) {
    LensFlare const& flare = input.effects.lensFlare;
    const bool hasGhosts = flare.ghostStrength > 0 && flare.ghostCount >= 1, hasHalo = flare.haloStrength > 0;
    if (flare.enabled && !hasGhosts && !hasHalo) return { .reason = DemandReason::HasNoIntensity };
    EffectDemand demand = demandOfPictureEffect(input, flare.enabled, DemandReason::ReflectsLight);
    if (!demand.isNeeded) return demand;
    demand.count = hasGhosts ? uint32_t{ flare.ghostCount } : 0;
    demand.others = hasHalo ? 1 : 0;
    return demand;
}

EffectDemand demandOfTaa(DemandInput const& input) {
    return demandOfPictureEffect(input, input.quality.antiAliasing == AntiAliasing::Taa, DemandReason::SmoothsEdges,
                                 DebugView::HistoryWeight);
}

EffectDemand demandOfFxaa(DemandInput const& input) {
    const bool isOn = input.quality.antiAliasing == AntiAliasing::Fxaa;
    const EffectDemand demand = demandOfPictureEffect(input, isOn, DemandReason::SmoothsEdges);
    if (demand.isNeeded && input.counts.visible == 0) return { .reason = DemandReason::NothingHasEdges };
    return demand;
}

EffectDemand demandOfUpscaling(DemandInput const& input) {
    const bool isOn =
            input.effects.resolution.upscaling != Upscaling::Off || input.quality.antiAliasing == AntiAliasing::Taa;
    if (!isOn) return { .reason = DemandReason::SwitchedOff };
    if (input.debugView != DebugView::None) return { .reason = DemandReason::NothingAsks };
    if (input.size == input.shownSize) return { .reason = DemandReason::IsNeutral };
    return { true, DemandReason::EnlargesPicture, input.size.x, input.size.y };
}

EffectDemand demandOfSharpening(DemandInput const& input) {
    Sharpening const& sharpening = input.effects.sharpening;
    if (sharpening.enabled && sharpening.strength == 0) return { .reason = DemandReason::HasNoIntensity };
    return demandOfPictureEffect(input, sharpening.enabled, DemandReason::ChangesPicture);
}

EffectDemand demandOfResolve(DemandInput const& input) {
    if (input.quality.msaaResolve == MsaaResolve::Average) return { .reason = DemandReason::SwitchedOff };
    if (input.samples == 1 || input.debugView != DebugView::None) return { .reason = DemandReason::NothingAsks };
    if (input.counts.visible == 0) return { .reason = DemandReason::NothingHasEdges };
    return { true, DemandReason::ResolvesSamples, input.samples };
}

EffectDemand demandOfMipBias(DemandInput const& input) {
    const float bias = mipBias(input.size, input.shownSize, input.quality, input.debugView);
    if (input.quality.mipBias == MipBias::Off) return { .reason = DemandReason::SwitchedOff };
    if (bias == 0) return { .reason = DemandReason::NothingAsks };
    return { true, DemandReason::SharpensTextures, static_cast<uint32_t>(std::lround(-100 * bias)) };
}

EffectDemand demandOfBand(DemandInput const& input) {
    if (!input.effects.guardBand.enabled) return { .reason = DemandReason::SwitchedOff };
    if (input.effects.guardBand.width == 0) return { .reason = DemandReason::HasNoIntensity };
    if (input.band == 0) return { .reason = DemandReason::NothingAsks };
    return { true, DemandReason::SurroundsPicture, input.band };
}

EffectDemand demandOfFocus(DemandInput const& input) {
    constexpr float kSharp = 0.5f; // pixels
    const EffectDemand demand = demandOfPictureEffect(input, input.effects.depthOfField.enabled,
                                                      DemandReason::IsOutOfFocus, DebugView::CircleOfConfusion);
    if (!demand.isNeeded) return demand;
    if (!(input.blurRadius > kSharp)) return { .reason = DemandReason::IsInFocus };
    return { true, demand.reason, static_cast<uint32_t>(std::ceil(input.blurRadius)) };
}

EffectDemand demandOfMotionBlur(DemandInput const& input) {
    MotionBlur const& blur = input.effects.motionBlur;
    const bool isNeutral = blur.shutterDegrees == 0 || blur.maxRadius == 0;
    if (blur.enabled && isNeutral) return { .reason = DemandReason::HasNoIntensity };
    const EffectDemand demand = demandOfPictureEffect(input, blur.enabled, DemandReason::MovesInView);
    if (!demand.isNeeded) return demand;
    if (input.moved == 0 && !input.cameraMoved) return { .reason = DemandReason::NothingMoves };
    return { true, input.moved ? DemandReason::MovesInView : DemandReason::CameraMoves, input.moved };
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
                                 Effect::DepthOfField, Effect::MotionBlur })
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
    case DebugView::CircleOfConfusion:
        return showsEffect(Effect::DepthOfField);
    case DebugView::HistoryWeight:
        return showsEffect(Effect::Taa);
    case DebugView::Histogram:
        return showsEffect(Effect::AutoExposure);
    default: // the picture, materials or triangles, which are always there
        return { true, DemandReason::ShowsEffect, 1, static_cast<uint32_t>(input.debugView) };
    }
}

/// Effects that light surfaces, or that need their light.
void leaveOutLight(SceneDemand& demand) {
    for (const Effect effect :
         { Effect::Sun, Effect::LightList, Effect::AreaLights, Effect::LightProfiles, Effect::Shadows,
           Effect::ColoredShadows, Effect::IndirectLight, Effect::Sky, Effect::SunDisc, Effect::AmbientOcclusion,
           Effect::Refraction, Effect::Reflections, Effect::Motion, Effect::ContactShadows, Effect::Fog })
        demand.effects[static_cast<size_t>(effect)] = { .reason = DemandReason::NothingIsLit };
}

} // namespace

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
    set(Effect::Transparency, demandOfTransparency(input));
    set(Effect::Deformation, demandOfDraws(input.deformed));
    set(Effect::Stencil, demandOfStencil(counts));
    set(Effect::AmbientOcclusion, demandOfOcclusion(input));
    set(Effect::Refraction, demandOfPicture(counts.refractiveDraws,
                                            input.quality.refraction == RefractionSource::Screen, input.copiedPixels));
    set(Effect::Reflections, demandOfPicture(counts.reflectiveDraws, input.effects.screenSpaceReflections.enabled));
    set(Effect::Motion, demandOfMotion(input));
    set(Effect::ContactShadows, demandOfContactShadows(counts));
    set(Effect::Fog, demandOfFog(input));
    set(Effect::Taa, demandOfTaa(input));
    set(Effect::DepthOfField, demandOfFocus(input));
    set(Effect::MotionBlur, demandOfMotionBlur(input));
    set(Effect::AutoExposure, demandOfPictureEffect(input, input.effects.autoExposure.enabled,
                                                    DemandReason::MeasuresPicture, DebugView::Histogram));
    set(Effect::Bloom, demandOfBloom(input));
    set(Effect::LensFlare, demandOfFlare(input));
    setFinish(input, demand);
    set(Effect::Fxaa, demandOfFxaa(input));
    set(Effect::Upscaling, demandOfUpscaling(input));
    set(Effect::Sharpening, demandOfSharpening(input));
    set(Effect::MsaaResolve, demandOfResolve(input));
    set(Effect::MipBias, demandOfMipBias(input));
    set(Effect::GuardBand, demandOfBand(input));
    if (!showsLight(input.debugView)) leaveOutLight(demand);
    set(Effect::DepthPrepass, demandOfPrepass(input, readersOfDepth(input, demand)));
    set(Effect::DebugView, demandOfDebugView(input, demand));
    return demand;
}

} // namespace filament::prepare
