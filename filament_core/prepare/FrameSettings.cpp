// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/FrameSettings.h"

#include "base/Assert.h"
#include "base/math/Elementary.h"
#include "filament_core/prepare/DebugViews.h"
#include "filament_core/values/ToneShader.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

bool accumulatesFrames(Quality const& quality, DebugView debugView) {
    return quality.antiAliasing == AntiAliasing::Taa &&
           (debugView == DebugView::None || debugView == DebugView::HistoryWeight);
}

bool upscalesOverFrames(Quality const& quality, Upscaling upscaling, DebugView debugView) {
    return accumulatesFrames(quality, debugView) && upscaling == Upscaling::Off;
}

uint2 drawnSize(View const& view, Resolution const& resolution) {
    const bool isEnlarged = resolution.upscaling != Upscaling::Off || accumulatesFrames(view.quality, view.debugView);
    if (!isEnlarged || view.debugView != DebugView::None) return view.size;
    return min(max(uint2(float2(view.size) * resolution.scale + 0.5f), 1u), view.size);
}

/// Accumulation would have to cut the band off before it knows the image around it.
uint32_t guardBand(View const& view, Effects const& effects, uint2 drawn) {
    const bool isUpscaled =
            drawn != view.size && upscalesOverFrames(view.quality, effects.resolution.upscaling, view.debugView);
    if (!effects.guardBand.enabled || view.debugView != DebugView::None || isUpscaled) return 0;
    return static_cast<uint32_t>(std::ceil(effects.guardBand.width * static_cast<float>(drawn.y)));
}

DisplaySettings displayOf(DisplayTransform const& unlimited) {
    const DisplayTransform display = clamped(unlimited);
    return { .toneMapper = shaderToneMapper(display),
             .outputSpace = shaderOutputSpace(display),
             .toneCurve = shaderToneCurve(display.toneCurve),
             .whiteShare = whiteShareOf(display),
             .halfWhiteLight = halfWhiteLight(display),
             .hasNumbers = display.toneMapper == ToneMapper::Generic || display.outputSpace != OutputSpace::Srgb,
             .dithers = display.dither };
}

/// One layer that is peeled is what sorting draws.
Quality drawnQuality(Quality const& quality, bool isLit) {
    Quality drawn = quality;
    const bool isPeeled = drawn.transparency == TransparencyOrder::Peeled;
    if (isPeeled && drawn.transparencyLayers <= 1) drawn.transparency = TransparencyOrder::Sorted;
    if (isLit) return drawn;
    drawn.shadows = ShadowFilter::Off;
    drawn.refraction = RefractionSource::Environment;
    return drawn;
}

Effects drawnEffects(Effects const& effects, bool isLit) {
    Effects drawn = effects;
    if (isLit) return drawn;
    drawn.ambientOcclusion.enabled = false;
    drawn.screenSpaceReflections.enabled = false;
    return drawn;
}

/// Frames that are accumulated have more samples together than each has pixels: their textures may be as sharp as the
/// image that they become.
float mipBias(ViewInput const& view, bool accumulates) {
    if (view.quality.mipBias == MipBias::Off || !accumulates) return 0;
    const float2 scale = float2(view.inside()) / float2(view.shown());
    const float sharper = view.quality.mipBias == MipBias::Sharp ? 1.0f : 0.0f;
    return std::min(0.5f * elementary::log2(scale.x * scale.y), 0.0f) - sharper;
}

bool lightsFog(Fog const& fog) { return fog.enabled && fog.volumetric && fog.density > 0 && fog.maximumOpacity > 0; }

} // namespace

ViewInput viewInput(View const& view, Effects const& effects, uint64_t contents) {
    const uint2 drawn = drawnSize(view, effects.resolution);
    const uint32_t band = guardBand(view, effects, drawn);
    return { .camera = view.camera,
             .size = drawn + 2u * band,
             .shownSize = view.size,
             .band = band,
             .samples = view.samples,
             .occlusionCulling = view.occlusionCulling,
             .lodPixels = std::clamp(view.lod.pixels, 0.0f, LevelsOfDetail::kMostPixels),
             .timeSeconds = view.timeSeconds,
             .materialGlobals = view.materialGlobals,
             .section = view.section,
             .quality = view.quality,
             .effects = effects,
             .display = displayOf(view.display),
             .clearColor = view.clearColor,
             .viewport = view.viewport,
             .debugView = view.debugView,
             .givesNumbers = view.aov != Aov::None,
             .visibleLayers = view.visibleLayers,
             .contents = contents };
}

FrameSettings resolve(ViewInput const& main) {
    FILAMENT_ASSERT(main.samples == 1 || main.samples == 4, "a view has 1 or 4 samples a pixel");
    const bool accumulates = accumulatesFrames(main.quality, main.debugView),
               isImage = main.debugView == DebugView::None, isLit = showsLight(main.debugView, main.givesNumbers);
    FrameSettings settings{ .quality = drawnQuality(main.quality, isLit),
                            .effects = drawnEffects(main.effects, isLit),
                            .display = main.display,
                            .debugView = main.debugView,
                            .givesNumbers = main.givesNumbers,
                            .size = main.size,
                            .shownSize = main.shown(),
                            .band = main.band,
                            .samples = isImage || showsCoverage(main.debugView) ? main.samples : uint8_t{ 1 },
                            .maxTextureSize = main.maxTextureSize,
                            .clearColor = main.clearColor,
                            .viewport = main.viewport,
                            .accumulatesFrames = accumulates,
                            .upscalesOverFrames =
                                    upscalesOverFrames(main.quality, main.effects.resolution.upscaling, main.debugView),
                            .tracksMotion = accumulates || main.debugView == DebugView::Motion ||
                                            (main.effects.motionBlur.enabled && isImage),
                            .mipBias = mipBias(main, accumulates) };
    settings.fadesLevels = accumulates && main.lodPixels > 0 && settings.samples == 1 &&
                           settings.quality.depthPrepass != DepthPrepass::Off;
    settings.lightsFog = lightsFog(settings.effects.fog) && isLit;
    settings.composesAnyOrder = isImage && settings.quality.transparency != TransparencyOrder::Sorted;
    // Positions that are not relative to the camera are rounded by more than the margin of occluders.
    const bool isPrecise = settings.quality.depthRange == DepthRange::Reversed && settings.quality.cameraRelative;
    // Occluders are tested at the centres of pixels: with more samples a pixel they may leave some of them open.
    const bool isSampledOnce = settings.samples == 1 && settings.quality.antiAliasing != AntiAliasing::Sraa;
    settings.cullsOccluded = main.occlusionCulling && isImage && isSampledOnce && isPrecise;
    settings.cutsSections = main.section.isUsed();
    settings.cutsSlabs = cutsSlabs(main.section);
    settings.cullsCasters = main.occlusionCulling && main.quality.cameraRelative;
    return settings;
}

bool cutsSlabs(SectionPlanes const& section) {
    return section.caps && section.cut == SectionCut::Each &&
           std::ranges::count_if(section.planes, SectionPlanes::isPlane) > 1;
}

} // namespace filament_core::prepare
