// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/EffectTable.h"

#include "filament_core/prepare/DebugViews.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

using R = DemandReason;
using Stage = EffectStage;

// ------------------------------------------------------------------------------------------------ lighting

/// `reaching` lights of a kind reach into the view, `others` do not or are left out; some of those for their channels.
EffectDemand demandOfLights(uint32_t reaching, uint32_t others, uint32_t litDraws, uint32_t ofOtherChannels = 0) {
    others += ofOtherChannels;
    if (reaching == 0 && ofOtherChannels) return { false, R::OtherChannels, 0, others };
    if (reaching == 0) return { false, others ? R::LightsOutOfView : R::NotInScene, 0, others };
    if (litDraws == 0) return { false, R::NoLitSurface, reaching, others };
    return { true, reaching + others == 1 ? R::OnlyLight : R::LightsVisible, reaching, others };
}

EffectDemand demandOfSun(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    EffectDemand demand =
            demandOfLights(counts.suns - counts.sunsOfOtherChannels, 0, counts.litDraws, counts.sunsOfOtherChannels);
    if (demand.isNeeded && demand.count > 1) demand.reason = R::BrightestSun;
    return demand;
}

EffectDemand demandOfLightList(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    return demandOfLights(counts.lights, counts.lightsOutOfView + counts.lightsOverLimit, counts.litDraws,
                          counts.lightsOfOtherChannels);
}

EffectDemand demandOfAreaLights(DemandInput const& input) {
    return demandOfLights(input.counts.areaLights, input.counts.areaLightsLeftOut, input.counts.litDraws);
}

EffectDemand demandOfProfiles(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    EffectDemand demand = demandOfLights(counts.profiledLights, counts.profiledLightsLeftOut, counts.litDraws);
    demand.leftOut = counts.profilesOverLimit;
    if (demand.isNeeded && demand.leftOut) demand.reason = R::ProfilesOverBudget;
    return demand;
}

EffectDemand demandOfImages(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    EffectDemand demand = demandOfLights(counts.imagedLights, counts.imagedLightsLeftOut, counts.litDraws);
    demand.leftOut = counts.imagesOverLimit;
    if (demand.isNeeded && demand.leftOut) demand.reason = R::ImagesOverBudget;
    return demand;
}

EffectDemand demandOfShadows(DemandInput const& input) {
    ShadowCounts const& counts = input.shadows;
    if (!counts.isOn) return { .reason = R::SwitchedOff };
    if (counts.maps) return { true, R::ShadowsVisible, counts.maps, counts.mapsDrawn, counts.mapsOverBudget };
    if (counts.lights == 0) return { .reason = R::NoLightCasts };
    if (counts.receivers == 0) return { .reason = R::NoReceiver };
    return { false, R::NoCaster, counts.mapsWithoutCasters };
}

EffectDemand demandOfColoredShadows(DemandInput const& input) {
    ShadowCounts const& counts = input.shadows;
    if (!counts.isOn || !counts.isColorOn) return { .reason = R::SwitchedOff };
    if (counts.coloredMaps == 0) return { false, R::NoTransmission, counts.maps };
    return { true, R::ShadowsColored, counts.coloredMaps, counts.maps - counts.coloredMaps };
}

EffectDemand demandOfAreaShadows(DemandInput const& input) {
    ShadowCounts const& counts = input.shadows;
    if (!counts.isOn || !counts.isShapeOn) return { .reason = R::SwitchedOff };
    if (!counts.hasDepths) return { .reason = R::NoDepths };
    if (counts.areaMaps == 0) return { false, R::NoAreaCasts, 0, counts.maps };
    return { true, R::ShadowsOfShapes, counts.areaMaps, counts.maps - counts.areaMaps };
}

EffectDemand demandOfIndirectLight(DemandInput const& input) {
    EffectDemand demand = demandOfLights(input.hasIndirectLight ? 1 : 0, 0, input.counts.litDraws);
    if (demand.isNeeded) demand.reason = R::EnvironmentLights;
    return demand;
}

EffectDemand demandOfBoxes(DemandInput const& input, ProbeCounts const& probes) {
    if (probes.inScene == 0) return { .reason = R::NotInScene };
    if (input.counts.litDraws == 0) return { false, R::NoLitSurface, 0, probes.inScene };
    if (probes.used) return { true, R::ProbesInView, probes.used, probes.outOfReach, probes.leftOut };
    return { false, probes.leftOut ? R::ProbesUnusable : R::ProbesOutOfReach, 0, probes.outOfReach, probes.leftOut };
}

EffectDemand demandOfProbes(DemandInput const& input) {
    const bool isOff = input.probes.inScene > 0 && input.settings.quality.reflectionProbes == 0;
    return isOff ? EffectDemand{ .reason = R::SwitchedOff } : demandOfBoxes(input, input.probes);
}

EffectDemand demandOfGrids(DemandInput const& input) { return demandOfBoxes(input, input.grids); }

EffectDemand demandOfSky(DemandInput const& input) {
    return input.hasSky ? EffectDemand{ true, R::BackgroundVisible } : EffectDemand{};
}

EffectDemand demandOfDiscs(DemandInput const& input) {
    if (input.discsInView) return { true, R::DiscsInView, input.discsInView, input.discsOutOfView };
    return { false, input.discsOutOfView ? R::DiscsOutOfView : R::NotInScene, 0, input.discsOutOfView };
}

EffectDemand demandOfOcclusion(DemandInput const& input) {
    if (!input.settings.effects.ambientOcclusion.enabled) return { .reason = R::SwitchedOff };
    if (input.settings.effects.ambientOcclusion.intensity == 0) return { .reason = R::ZeroIntensity };
    if (input.counts.opaqueDraws == 0) return { .reason = R::NoOpaqueSurface };
    if (!input.hasIndirectLight || input.counts.opaqueLitDraws == 0) return { .reason = R::NoIndirectLight };
    return { true, R::OccludesIndirect, input.counts.opaqueLitDraws };
}

/// `draws` sample the scene's colour, if that is on.
EffectDemand demandOfSceneColor(uint32_t draws, bool isOn, uint32_t copiedPixels = 0) {
    if (draws == 0) return { .reason = R::Unrequested };
    if (!isOn) return { .reason = R::SwitchedOff };
    return { true, R::SamplesSceneColor, draws, copiedPixels };
}

EffectDemand demandOfRefraction(DemandInput const& input) {
    return demandOfSceneColor(input.counts.refractiveDraws,
                              input.settings.quality.refraction == RefractionSource::Screen, input.copiedPixels);
}

EffectDemand demandOfReflections(DemandInput const& input) {
    return demandOfSceneColor(input.counts.reflectiveDraws, input.settings.effects.screenSpaceReflections.enabled);
}

EffectDemand demandOfMotion(DemandInput const& input) {
    if (!input.settings.readsMotion(input.counts)) return { .reason = R::Unrequested };
    if (input.moved == 0) return { .reason = R::NothingMoves };
    return { true, R::ObjectsMove, input.moved };
}

EffectDemand demandOfContactShadows(DemandInput const& input) {
    ViewCounts const& counts = input.counts;
    if (counts.contactLights == 0) return { .reason = R::Unrequested };
    if (counts.litDraws == 0) return { .reason = R::NoLitSurface };
    if (counts.opaqueDraws == 0) return { .reason = R::NoOpaqueSurface };
    return { true, R::RequestedByLights, counts.contactLights };
}

EffectDemand demandOfFog(DemandInput const& input) {
    if (!input.settings.effects.fog.enabled) return { .reason = R::SwitchedOff };
    if (input.settings.effects.fog.density == 0 || input.settings.effects.fog.maximumOpacity == 0)
        return { .reason = R::ZeroDensity };
    return { true, R::CameraInFog };
}

EffectDemand demandOfVolumetricFog(DemandInput const& input) {
    const EffectDemand fog = demandOfFog(input);
    if (!fog.isNeeded) return fog;
    if (!input.settings.effects.fog.volumetric) return { .reason = R::SwitchedOff };
    if (input.counts.lights > 0 || input.cascades > 0)
        return { true, R::FogLights, input.counts.lights, input.cascades };
    if (input.settings.effects.fog.noiseAmplitude > 0) return { true, R::FogVaries };
    if (input.settings.effects.fog.attenuatesLight && input.counts.suns > 0) return { true, R::FogWeakensSun };
    return { .reason = R::FogUnshadowed };
}

// ------------------------------------------------------------------------------------------------ geometry

EffectDemand demandOfDraws(uint32_t draws, EffectDemand const& none) {
    return draws ? EffectDemand{ true, R::InView, draws } : none;
}

EffectDemand demandOfBlending(DemandInput const& input) {
    return demandOfDraws(input.counts.blendedDraws, { .reason = R::NotInView });
}

EffectDemand demandOfDeformation(DemandInput const& input) {
    return demandOfDraws(input.deformed, { .reason = R::NotInView });
}

EffectDemand demandOfStencil(DemandInput const& input) {
    return demandOfDraws(input.counts.stencilDraws, { .reason = R::Unrequested });
}

EffectDemand demandOfTransparency(DemandInput const& input) {
    Quality const& quality = input.settings.quality;
    if (quality.transparency == TransparencyOrder::Sorted) return { .reason = R::SwitchedOff };
    if (!input.settings.composesAnyOrder) return { .reason = R::HiddenByDebugView };
    const uint32_t objects = input.counts.anyOrderObjects;
    if (!overlaps(objects)) return { false, R::NoOverlap, objects };
    const bool isPeeled = quality.transparency == TransparencyOrder::Peeled;
    return { true, R::MayOverlap, objects, isPeeled ? quality.transparencyLayers : 0u };
}

EffectDemand demandOfSplats(DemandInput const& input) {
    if (input.splatClouds == 0) return {};
    if (input.settings.debugView != DebugView::None) return { .reason = R::HiddenByDebugView };
    return demandOfDraws(input.splats, { .reason = R::NotInView });
}

EffectDemand demandOfPrepass(DemandInput const& input, SceneDemand const& demand) {
    if (input.counts.opaqueDraws == 0) return { .reason = R::NoOpaqueSurface };
    const auto readsDepth = [&](EffectRow const& row) { return row.has(kReadsDepth) && demand.needs(row.effect); };
    auto readers = static_cast<uint32_t>(std::ranges::count_if(kEffectTable, readsDepth));
    if (demand.needs(Effect::Taa) && input.cameraMoved) ++readers; // reprojects what stays where it is by its depth
    if (input.counts.fadingLevels > 0) ++readers;                  // each pixel shows the level that left its depth
    if (readers) return { true, R::DepthRead, readers };
    if (input.settings.quality.depthPrepass == DepthPrepass::On) return { true, R::PrepassEnabled };
    return { .reason = R::DepthUnread };
}

EffectDemand demandOfMipBias(DemandInput const& input) {
    const float bias = input.settings.mipBias;
    if (input.settings.quality.mipBias == MipBias::Off) return { .reason = R::SwitchedOff };
    if (bias == 0) return { .reason = R::Unrequested };
    return { true, R::SharpensTextures, static_cast<uint32_t>(std::lround(-100 * bias)) };
}

EffectDemand demandOfBand(DemandInput const& input) {
    if (!input.settings.effects.guardBand.enabled) return { .reason = R::SwitchedOff };
    if (input.settings.effects.guardBand.width == 0) return { .reason = R::ZeroWidth };
    if (input.settings.band == 0) return { .reason = R::Unrequested };
    return { true, R::GuardsImage, input.settings.band };
}

// ------------------------------------------------------------------------------------------------ post-processing

/// Of an effect of the image; `shown`: the debug view that shows it.
EffectDemand demandOfImageEffect(DemandInput const& input, bool isOn, DemandReason reason,
                                 DebugView shown = DebugView::None) {
    if (!isOn) return { .reason = R::SwitchedOff };
    if (input.settings.debugView != DebugView::None && input.settings.debugView != shown)
        return { .reason = R::HiddenByDebugView };
    const bool isAnythingVisible =
            input.counts.visible > 0 || input.hasSky || input.discsInView > 0 || input.splats > 0;
    if (!isAnythingVisible) return { .reason = R::NothingVisible };
    return { true, reason };
}

EffectDemand demandOfTaa(DemandInput const& input) {
    return demandOfImageEffect(input, input.settings.quality.antiAliasing == AntiAliasing::Taa, R::SmoothsEdges,
                               DebugView::HistoryWeight);
}

EffectDemand demandOfFxaa(DemandInput const& input) {
    const bool isOn = input.settings.quality.antiAliasing == AntiAliasing::Fxaa;
    const EffectDemand demand = demandOfImageEffect(input, isOn, R::SmoothsEdges);
    if (demand.isNeeded && input.counts.visible == 0) return { .reason = R::NoSurface };
    return demand;
}

EffectDemand demandOfDepthOfField(DemandInput const& input) {
    constexpr float kSharp = 0.5f; // pixels
    const EffectDemand demand = demandOfImageEffect(input, input.settings.effects.depthOfField.enabled, R::OutOfFocus,
                                                    DebugView::CircleOfConfusion);
    if (!demand.isNeeded) return demand;
    if (!(input.blurRadius > kSharp)) return { .reason = R::InFocus };
    return { true, demand.reason, static_cast<uint32_t>(std::ceil(input.blurRadius)) };
}

EffectDemand demandOfMotionBlur(DemandInput const& input) {
    MotionBlur const& blur = input.settings.effects.motionBlur;
    const bool isNeutral = blur.shutterDegrees == 0 || blur.maxRadius == 0;
    if (blur.enabled && isNeutral) return { .reason = R::ZeroIntensity };
    const EffectDemand demand = demandOfImageEffect(input, blur.enabled, R::ObjectsMove);
    if (!demand.isNeeded) return demand;
    if (input.moved == 0 && !input.cameraMoved) return { .reason = R::NothingMoves };
    return { true, input.moved ? R::ObjectsMove : R::CameraMoves, input.moved };
}

EffectDemand demandOfAutoExposure(DemandInput const& input) {
    return demandOfImageEffect(input, input.settings.effects.autoExposure.enabled, R::MeasuresLuminance,
                               DebugView::Histogram);
}

EffectDemand demandOfBloom(DemandInput const& input) {
    Bloom const& bloom = input.settings.effects.bloom;
    if (bloom.enabled && bloom.strength == 0) return { .reason = R::ZeroIntensity };
    const bool hasDirt = bloom.dirt && bloom.dirtStrength > 0;
    return demandOfImageEffect(input, bloom.enabled, hasDirt ? R::ScattersLightByDirt : R::ScattersLight);
}

EffectDemand demandOfFlare(DemandInput const& input) {
    LensFlare const& flare = input.settings.effects.lensFlare;
    const bool hasGhosts = flare.ghostStrength > 0 && flare.ghostCount >= 1, hasHalo = flare.haloStrength > 0;
    if (flare.enabled && !hasGhosts && !hasHalo) return { .reason = R::ZeroIntensity };
    EffectDemand demand = demandOfImageEffect(input, flare.enabled,
                                              !hasGhosts ? R::LensHalo
                                              : hasHalo  ? R::LensGhostsAndHalo
                                                         : R::LensGhosts);
    if (demand.isNeeded && hasGhosts) demand.count = flare.ghostCount;
    return demand;
}

/// Of an effect that changes the image wherever it is, nothing visible included.
EffectDemand demandOfGrade(DemandInput const& input, bool isOn, bool isNeutral, DemandReason neutral) {
    if (!isOn) return { .reason = R::SwitchedOff };
    if (isNeutral) return { .reason = neutral };
    if (input.settings.debugView != DebugView::None) return { .reason = R::HiddenByDebugView };
    return { true, R::ChangesImage };
}

EffectDemand demandOfAberration(DemandInput const& input) {
    ChromaticAberration const& aberration = input.settings.effects.chromaticAberration;
    return demandOfGrade(input, aberration.enabled, aberration.strength == 0, R::ZeroIntensity);
}

EffectDemand demandOfVignette(DemandInput const& input) {
    Vignette const& vignette = input.settings.effects.vignette;
    return demandOfGrade(input, vignette.enabled, vignette.color == float3(1), R::Neutral);
}

EffectDemand demandOfGrading(DemandInput const& input) {
    ColorGrading const& grading = input.settings.effects.colorGrading;
    const ColorGrading neutral{ .enabled = grading.enabled,
                                .tonalRanges = grading.tonalRanges, // of equal factors
                                .midPoint = grading.midPoint };     // of straight curves
    return demandOfGrade(input, grading.enabled, grading == neutral, R::Neutral);
}

EffectDemand demandOfGrain(DemandInput const& input) {
    return demandOfGrade(input, input.settings.effects.grain.enabled, input.settings.effects.grain.strength == 0,
                         R::ZeroIntensity);
}

EffectDemand demandOfUpscaling(DemandInput const& input) {
    const bool isOn = input.settings.effects.resolution.upscaling != Upscaling::Off ||
                      input.settings.quality.antiAliasing == AntiAliasing::Taa;
    if (!isOn) return { .reason = R::SwitchedOff };
    if (input.settings.debugView != DebugView::None) return { .reason = R::HiddenByDebugView };
    const uint2 drawn = input.settings.insideSize();
    if (drawn == input.settings.shownSize) return { .reason = R::Neutral };
    return { true, R::UpscalesImage, drawn.x, drawn.y };
}

EffectDemand demandOfSharpening(DemandInput const& input) {
    Sharpening const& sharpening = input.settings.effects.sharpening;
    if (sharpening.enabled && sharpening.strength == 0) return { .reason = R::ZeroIntensity };
    return demandOfImageEffect(input, sharpening.enabled, R::ChangesImage);
}

EffectDemand demandOfResolve(DemandInput const& input) {
    if (input.settings.quality.msaaResolve == MsaaResolve::Average) return { .reason = R::SwitchedOff };
    if (input.settings.samples == 1 || input.settings.debugView != DebugView::None) return { .reason = R::Unrequested };
    if (input.counts.visible == 0) return { .reason = R::NoSurface };
    return { true, R::ResolvesSamples, input.settings.samples };
}

EffectDemand demandOfReconstruction(DemandInput const& input) {
    FrameSettings const& settings = input.settings;
    const EffectDemand demand =
            demandOfImageEffect(input, settings.quality.antiAliasing == AntiAliasing::Sraa, R::SmoothsEdges);
    if (!demand.isNeeded) return demand;
    if (input.counts.opaqueDraws == 0) return { .reason = R::NoOpaqueSurface };
    if (settings.samples > 1) return { false, R::HasSamples, settings.samples };
    constexpr uint32_t kDepths = 2; // a side of each pixel
    if (std::max(settings.size.x, settings.size.y) > settings.maxTextureSize / kDepths)
        return { false, R::TooLarge, kDepths * kDepths };
    return demand;
}

EffectDemand demandOfDebugView(DemandInput const& input, SceneDemand const& demand) {
    ViewCounts const& counts = input.counts;
    const uint32_t lights = counts.litDraws ? counts.lights : 0; // otherwise no list is made
    switch (input.settings.debugView) {
    case DebugView::None:
        return {};
    case DebugView::Cascades:
        return { true, input.cascades ? R::DebugCascades : R::DebugNoCascades, input.cascades };
    case DebugView::Atlas:
        return { true, input.shadows.maps ? R::DebugAtlas : R::DebugNoAtlas, input.shadows.maps, input.atlasSize };
    case DebugView::Froxels:
        if (counts.froxels == 0) return { true, R::DebugNoFroxels, lights };
        return { true, R::DebugFroxels, counts.longestFroxel, counts.froxels };
    case DebugView::Lights:
        return { true, R::DebugLights, lights };
    default:
        DebugViewRow const& row = rowOf(input.settings.debugView);
        const bool isIdle = row.content == DebugContent::Effect && !demand.needs(row.effect);
        return { true, isIdle ? R::DebugEffectIdle : R::DebugViewShown, 0,
                 static_cast<uint32_t>(input.settings.debugView) };
    }
}

} // namespace

constexpr std::array<EffectRow, kEffects> kEffectTable{ {
        { Effect::Sun, "sun", Stage::Lighting, demandOfSun },
        { Effect::LightList, "light list", Stage::Lighting, demandOfLightList },
        { Effect::AreaLights, "area lights", Stage::Lighting, demandOfAreaLights },
        { Effect::LightProfiles, "light profiles", Stage::Lighting, demandOfProfiles },
        { Effect::LightImages, "light images", Stage::Lighting, demandOfImages },
        { Effect::Shadows, "shadows", Stage::Lighting, demandOfShadows, "shadows=off" },
        { Effect::ColoredShadows, "coloured shadows", Stage::Lighting, demandOfColoredShadows, "coloredShadows=off" },
        { Effect::AreaShadows, "area shadows", Stage::Lighting, demandOfAreaShadows, "areaShadows=center" },
        { Effect::IndirectLight, "indirect light", Stage::Lighting, demandOfIndirectLight },
        { Effect::ReflectionProbes, "reflection probes", Stage::Lighting, demandOfProbes, "reflectionProbes=0" },
        { Effect::IrradianceGrids, "irradiance grids", Stage::Lighting, demandOfGrids },
        { Effect::Sky, "sky", Stage::Lighting, demandOfSky },
        { Effect::SunDisc, "sun disc", Stage::Lighting, demandOfDiscs },
        { Effect::Blending, "blending", Stage::Geometry, demandOfBlending },
        { Effect::Transparency, "transparency", Stage::Geometry, demandOfTransparency, "transparency=sorted" },
        { Effect::Splats, "splats", Stage::Geometry, demandOfSplats },
        { Effect::Deformation, "deformation", Stage::Geometry, demandOfDeformation },
        { Effect::Stencil, "stencil", Stage::Geometry, demandOfStencil, "", 0, "nothing in view has a stencil state" },
        { Effect::DepthPrepass, "depth prepass", Stage::Geometry, demandOfPrepass },
        { Effect::AmbientOcclusion, "ambient occlusion", Stage::Lighting, demandOfOcclusion, "ambientOcclusion=off",
          kReadsDepth },
        { Effect::Refraction, "refraction", Stage::Lighting, demandOfRefraction, "refraction=environment", 0,
          "nothing in view refracts the picture" },
        { Effect::Reflections, "reflections", Stage::Lighting, demandOfReflections, "screenSpaceReflections=off",
          kReadsDepth, "nothing in view reflects the picture" },
        { Effect::Motion, "motion", Stage::Lighting, demandOfMotion, "", kReadsDepth,
          "no effect looks at the last picture" },
        { Effect::ContactShadows, "contact shadows", Stage::Lighting, demandOfContactShadows, "", kReadsDepth,
          "no light in view asks for them" },
        { Effect::Fog, "fog", Stage::Lighting, demandOfFog, "fog=off" },
        { Effect::VolumetricFog, "volumetric fog", Stage::Lighting, demandOfVolumetricFog, "fog.volumetric=off" },
        { Effect::Taa, "taa", Stage::PostProcess, demandOfTaa, "antiAliasing", kChangesColor },
        { Effect::DepthOfField, "depth of field", Stage::PostProcess, demandOfDepthOfField, "depthOfField=off",
          kReadsDepth | kChangesColor },
        { Effect::MotionBlur, "motion blur", Stage::PostProcess, demandOfMotionBlur, "motionBlur=off",
          kReadsDepth | kChangesColor },
        { Effect::AutoExposure, "auto exposure", Stage::PostProcess, demandOfAutoExposure, "autoExposure=off",
          kChangesColor },
        { Effect::Bloom, "bloom", Stage::PostProcess, demandOfBloom, "bloom=off", kChangesColor },
        { Effect::ChromaticAberration, "chromatic aberration", Stage::PostProcess, demandOfAberration,
          "chromaticAberration=off", kChangesColor },
        { Effect::Vignette, "vignette", Stage::PostProcess, demandOfVignette, "vignette=off", kChangesColor },
        { Effect::ColorGrading, "color grading", Stage::PostProcess, demandOfGrading, "colorGrading=off",
          kChangesColor },
        { Effect::Grain, "grain", Stage::PostProcess, demandOfGrain, "grain=off" }, // of codes: light stays as it is
        { Effect::Fxaa, "fxaa", Stage::PostProcess, demandOfFxaa, "antiAliasing", kChangesColor },
        { Effect::Upscaling, "upscaling", Stage::PostProcess, demandOfUpscaling, "resolution.upscaling=off",
          kChangesColor },
        { Effect::Sharpening, "sharpening", Stage::PostProcess, demandOfSharpening, "sharpening=off", kChangesColor },
        { Effect::LensFlare, "lens flare", Stage::PostProcess, demandOfFlare, "lensFlare=off", kChangesColor },
        { Effect::MsaaResolve, "msaa resolve", Stage::PostProcess, demandOfResolve, "msaaResolve=average", 0,
          "pixels have one sample" }, // by the colour pass
        { Effect::Sraa, "sraa", Stage::PostProcess, demandOfReconstruction, "antiAliasing",
          kReadsDepth | kChangesColor },
        { Effect::MipBias, "mip bias", Stage::Geometry, demandOfMipBias, "mipBias=off", 0,
          "no frames are accumulated into more pixels than they have" },
        { Effect::GuardBand, "guard band", Stage::Geometry, demandOfBand, "guardBand=off", kChangesColor,
          "nothing looks beside the picture, a debug view is shown, the target has depth, or accumulation "
          "enlarges the picture" },
        { Effect::DebugView, "debug view", Stage::PostProcess, demandOfDebugView },
} };

static_assert(std::ranges::all_of(kEffectTable,
                                  [](EffectRow const& row) {
                                      return &row - kEffectTable.data() == static_cast<std::ptrdiff_t>(row.effect);
                                  }),
              "every effect has a row, in the order of the enumerators");

} // namespace filament_core::prepare
