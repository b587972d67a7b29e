// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PostProcessPass.h"

#include "base/math/Elementary.h"
#include "filament_core/passes/AppPass.h"
#include "filament_core/passes/FlarePass.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/ResolutionPass.h"
#include "filament_core/passes/ViewportBlitPass.h"
#include "filament_core/values/ToneShader.h"

#include <array>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using backend::Rect;
using framegraph::FrameGraph;
using framegraph::TextureId;
using prepare::Effect;

constexpr std::string_view kLightInputs[] = { "color" };
constexpr FullScreenInterface kLight{ .pass = "light", .inputs = kLightInputs };
constexpr FullScreenInterface kAlpha{ .pass = "alpha", .inputs = kLightInputs };
constexpr std::string_view kToneInputs[] = { "color", "table" };
constexpr FullScreenInterface kTone{ .pass = "tone map", .inputs = kToneInputs };
constexpr std::string_view kFinishInputs[] = { "color", "around", "spread", "dirt", "flare", "table", "exposure" };
constexpr std::string_view kFxaaInputs[] = { "picture" };
constexpr FullScreenParameter kFxaaValues[] = { { "grainStrength", ParameterType::Float },
                                                { "grainSize", ParameterType::Float } };
constexpr FullScreenInterface kFxaa{ .pass = "fxaa", .inputs = kFxaaInputs, .values = kFxaaValues };

/// What the passes of a frame do.
struct PostProcessSteps {
    bool isSceneLinear = false;
    bool hasAppPasses = false;                                     // after the tone mapper
    bool smoothsEdges = false, enlarges = false, sharpens = false; // in this order, after the others
    bool hasBloom = false, isDirty = false, hasFlare = false, isExposed = false, isGraded = false, hasVignette = false,
         hasFringes = false;
    bool hasToneValues = false;               // of a formula with numbers, or for a display other than sRGB
    bool hasGrain = false;                    // by the last pass, because the others take noise for edges
    bool hasTenBits = false, dithers = false; // dither: as grain

    bool hasLaterPass() const { return hasAppPasses || smoothsEdges || changesPixels(); }
    bool changesPixels() const { return enlarges || sharpens; }
    /// Whether more than a tone mapper is asked for.
    bool hasLens() const {
        return hasBloom || hasFlare || isExposed || isGraded || hasVignette || hasFringes || hasToneValues ||
               (hasGrain && !hasLaterPass());
    }
};

/// Steps of ten bits need no dither.
PostProcessSteps stepsOf(FrameContext const& context, Format target, bool isSceneLinear, bool enlarges) {
    prepare::SceneDemand const& demand = context.packet.demand;
    return { .isSceneLinear = isSceneLinear,
             .hasAppPasses = hasAppPasses(context, PassPlace::AfterToneMapping),
             .smoothsEdges = demand.needs(Effect::Fxaa),
             .enlarges = enlarges,
             .sharpens = demand.needs(Effect::Sharpening),
             .hasBloom = demand.needs(Effect::Bloom),
             .isDirty = static_cast<bool>(context.resources.dirt.texture),
             .hasFlare = demand.needs(Effect::LensFlare),
             .isExposed = demand.needs(Effect::AutoExposure),
             .isGraded = demand.needs(Effect::ColorGrading) && (isSceneLinear || !context.resources.toneTable),
             .hasVignette = demand.needs(Effect::Vignette),
             .hasFringes = demand.needs(Effect::ChromaticAberration),
             .hasToneValues = !isSceneLinear && !context.resources.toneTable && context.settings().display.hasNumbers,
             .hasGrain = demand.needs(Effect::Grain) && !isSceneLinear,
             .hasTenBits = target == Format::RGB10A2,
             .dithers = context.settings().display.dithers && target == Format::RGBA8 };
}

int32_t toneMapperOf(FrameContext const& context) {
    return context.resources.toneTable ? 0 : context.settings().display.toneMapper;
}

void addToneMapPass(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps, TextureId color,
                    TextureId target) {
    const std::array constants{ EffectConstant{ "dither", steps.dithers && !steps.hasLaterPass() },
                                EffectConstant{ "fromTable", static_cast<bool>(context.resources.toneTable) },
                                EffectConstant{ "toneMapper", toneMapperOf(context) } };
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = color },
                             FullScreenInput{ .name = "table", .image = context.resources.toneTable } };
    addFullScreenPass(graph, context,
                      { .name = "tone map",
                        .material = context.resources.effects->get("tonemap", constants, kTone),
                        .inputs = inputs,
                        .target = target });
}

/// At the corners of the image, red and blue lie `strength` of its height apart.
float fringePerPixel(ChromaticAberration const& aberration, uint2 size) {
    return aberration.strength * static_cast<float>(size.y) / glm::length(float2(size));
}

/// As finish.mat reads it: from a rectangle (0) by an ellipse (1/2) to a circle (1).
float4 shapeOf(Vignette const& vignette, uint2 size) {
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const float exponent = std::lerp(8.0f, 2.0f, std::min(2 * vignette.roundness, 1.0f));
    const float width = std::lerp(1.0f, aspect, std::max(2 * vignette.roundness - 1, 0.0f));
    return { vignette.midPoint, vignette.midPoint + 2 * vignette.feather, exponent, width };
}

/// Strength, the level of its texture that has as many texels as the image pixels, and that of its mean.
float3 dirtLevelsOf(FrameContext const& context, uint2 size) {
    DirtTexture const& dirt = context.resources.dirt;
    const float2 texels = float2(dirt.size) / float2(size);
    const float level = std::max(elementary::log2(std::max(texels.x, texels.y)), 0.0f);
    return { context.settings().effects.bloom.dirtStrength, level, static_cast<float>(dirt.levels - 1) };
}

/// Threshold, the share of light that is taken, and the coordinates of the flare's texture by those of the image.
float4 flareShareOf(FrameContext const& context, uint2 size) {
    LensFlare const& flare = context.settings().effects.lensFlare;
    const uint32_t block = flareBlock(size.y);
    const float2 covered = float2((size + block - 1u) / block * block);
    return { flare.threshold, flareShare(flare), float2(size) / covered };
}

/// Where the image lies in what is drawn around it, by factor (xy) and offset (zw).
float4 placeInBand(prepare::FramePacket const& packet) {
    const float2 whole(packet.settings.size);
    return { float2(packet.settings.insideSize()) / whole, static_cast<float>(packet.settings.band) / whole };
}

/// All that finish.mat reads, which is checked against this when it is loaded.
auto valuesOf(FrameContext const& context, uint2 drawn) {
    Effects const& effects = context.settings().effects;
    ColorGrading const& grading = effects.colorGrading;
    const double3x3 mix = matrixAfterNight(grading);
    prepare::DisplaySettings const& display = context.settings().display;
    const uint2 size = context.settings().shownSize;
    return std::array{
        FullScreenValue{ "bloomStrength", effects.bloom.strength },
        FullScreenValue{ "bloomThreshold", effects.bloom.threshold },
        FullScreenValue{ "dirtLevels", dirtLevelsOf(context, drawn) },
        FullScreenValue{ "flareShare", flareShareOf(context, drawn) },
        FullScreenValue{ "fringe", fringePerPixel(effects.chromaticAberration, size) },
        FullScreenValue{ "vignette", shapeOf(effects.vignette, size) },
        FullScreenValue{ "vignetteColor", effects.vignette.color },
        FullScreenValue{ "grainStrength", effects.grain.strength },
        FullScreenValue{ "grainSize", effects.grain.size },
        FullScreenValue{ "mixRed", shaderRow(mix, 0) },
        FullScreenValue{ "mixGreen", shaderRow(mix, 1) },
        FullScreenValue{ "mixBlue", shaderRow(mix, 2) },
        FullScreenValue{ "shadows", grading.shadows },
        FullScreenValue{ "midtones", grading.midtones },
        FullScreenValue{ "highlights", grading.highlights },
        FullScreenValue{ "tonalRanges", grading.tonalRanges },
        FullScreenValue{ "slope", grading.slope },
        FullScreenValue{ "offset", grading.offset },
        FullScreenValue{ "power", grading.power },
        FullScreenValue{ "contrastSaturationVibrance", float3(grading.contrast, grading.saturation, grading.vibrance) },
        FullScreenValue{ "shadowGamma", grading.shadowGamma },
        FullScreenValue{ "midPoint", grading.midPoint },
        FullScreenValue{ "highlightScale", grading.highlightScale },
        FullScreenValue{ "night", float2(grading.nightAdaptation, exposureBeforeNight(grading)) },
        FullScreenValue{ "toneCurve", display.toneCurve },
        FullScreenValue{ "whiteShare", display.whiteShare },
        FullScreenValue{ "spreadPlace", placeInBand(context.packet) },
    };
}

void addFinishPass(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps,
                   FrameTargets const& targets, TextureId target) {
    const bool hasTable = static_cast<bool>(context.resources.toneTable) && !steps.isSceneLinear;
    const std::array constants{
        EffectConstant{ "isSceneLinear", steps.isSceneLinear },
        EffectConstant{ "fromTable", hasTable },
        EffectConstant{ "toneMapper", toneMapperOf(context) },
        EffectConstant{ "dither", steps.dithers && !steps.hasLaterPass() },
        EffectConstant{ "autoExposure", steps.isExposed },
        EffectConstant{ "bloom", steps.hasBloom },
        EffectConstant{ "isDirty", steps.isDirty },
        EffectConstant{ "hasFlare", steps.hasFlare },
        EffectConstant{ "graded", steps.isGraded },
        EffectConstant{ "mapsGamut", steps.isGraded && context.settings().effects.colorGrading.gamutMapping },
        EffectConstant{ "aberration", steps.hasFringes },
        EffectConstant{ "hasVignette", steps.hasVignette },
        EffectConstant{ "grain", steps.hasGrain && !steps.hasLaterPass() },
        EffectConstant{ "outputSpace", hasTable ? 0 : context.settings().display.outputSpace },
        EffectConstant{ "adaptsToNight",
                        steps.isGraded && context.settings().effects.colorGrading.nightAdaptation > 0 },
    };
    const std::array inputs{
        FullScreenInput{ .name = "color", .texture = targets.color },
        FullScreenInput{ .name = "around",
                         .texture = steps.hasFringes ? targets.color : TextureId{},
                         .sampler = context.resources.samplers.bilinear },
        FullScreenInput{ .name = "spread",
                         .texture = targets.bloom,
                         .sampler = context.resources.samplers.bilinear,
                         .range = targets.bloom ? backend::oneLevel(0) : backend::TextureRange{} },
        FullScreenInput{ .name = "dirt",
                         .image = context.resources.dirt.texture,
                         .sampler = context.resources.samplers.trilinear },
        FullScreenInput{ .name = "flare", .texture = targets.flare, .sampler = context.resources.samplers.bilinear },
        FullScreenInput{ .name = "table", .image = context.resources.toneTable },
        FullScreenInput{ .name = "exposure", .texture = targets.exposure }
    };
    const auto values = valuesOf(context, sizeOf(graph, targets.color));
    const auto parameters = parametersOf(values);
    const FullScreenInterface given{ .pass = "finish", .inputs = kFinishInputs, .values = parameters };
    addFullScreenPass(graph, context,
                      { .name = "finish",
                        .material = context.resources.effects->get("finish", constants, given),
                        .inputs = inputs,
                        .values = values,
                        .target = target });
}

void addLightPass(FrameGraph& graph, FrameContext const& context, TextureId color, TextureId target) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = color } };
    addFullScreenPass(graph, context,
                      { .name = "light",
                        .material = context.resources.effects->get("light", {}, kLight),
                        .inputs = inputs,
                        .target = target });
}

/// Where objects have edges: beside them only the sky is, unless they are elsewhere on screen.
Rect pixelsWithEdges(prepare::FramePacket const& packet, PostProcessSteps const& steps, uint2 size) {
    const bool isKnown =
            size == packet.settings.size && !steps.hasFringes && !steps.hasAppPasses && packet.discs.empty();
    return isKnown ? packet.covered : Rect{ 0, 0, size.x, size.y };
}

scene::Material const& fxaaMaterial(FrameContext const& context, PostProcessSteps const& steps, bool smooths) {
    const std::array constants{ EffectConstant{ "isSceneLinear", steps.isSceneLinear },
                                EffectConstant{ "smooths", smooths },
                                EffectConstant{ "dither", steps.dithers && !steps.changesPixels() },
                                EffectConstant{ "grain", steps.hasGrain && !steps.changesPixels() } };
    return context.resources.effects->get("fxaa", constants, kFxaa);
}

void addFxaaPass(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps, TextureId picture,
                 TextureId target) {
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = picture } };
    Grain const& grain = context.settings().effects.grain;
    const std::array values{ FullScreenValue{ "grainStrength", grain.strength },
                             FullScreenValue{ "grainSize", grain.size } };
    const uint2 size = sizeOf(graph, target);
    const Rect withEdges = pixelsWithEdges(context.packet, steps, size);
    std::array<FullScreenTile, 5> tiles{ FullScreenTile{ withEdges, values } };
    size_t count = 1;
    // Pixels that cannot have edges are copied by the same pass: a copy reads one texel, the filter many.
    for (Rect const& rect : rectsAround(withEdges, size)) {
        if (rect.width > 0 && rect.height > 0) tiles[count++] = { rect, values, &fxaaMaterial(context, steps, false) };
    }
    addFullScreenPass(graph, context,
                      { .name = "fxaa",
                        .material = fxaaMaterial(context, steps, steps.smoothsEdges),
                        .inputs = inputs,
                        .target = target,
                        .tiles = std::span(tiles).first(count),
                        .fillsTarget = true });
}

/// Between the passes. Noise that comes later needs more than 8 bits until then, and sharpening would raise their
/// steps.
TextureId createUnfinished(FrameGraph& graph, PostProcessSteps const& steps, uint2 size, std::string_view name) {
    const bool isEightBit = !steps.isSceneLinear && !steps.hasAppPasses && !steps.dithers && !steps.hasGrain &&
                            !steps.sharpens && !steps.hasTenBits;
    return graph.createTexture({ .width = size.x,
                                 .height = size.y,
                                 .format = isEightBit ? Format::RGBA8 : Format::RGBA16F,
                                 .name = name });
}

/// Draws `target` from targets.color, by the cheapest pass that does what is asked for.
void addPicture(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps,
                FrameTargets const& targets, TextureId target) {
    if (steps.hasLens())
        addFinishPass(graph, context, steps, targets, target);
    else if (steps.isSceneLinear)
        addLightPass(graph, context, targets.color, target);
    else
        addToneMapPass(graph, context, steps, targets.color, target);
}

/// Colours divided by their alpha, or multiplied by it.
void addAlphaPass(FrameGraph& graph, FrameContext const& context, bool multiplies, TextureId color, TextureId target) {
    const std::array constants{ EffectConstant{ "multiplies", multiplies } };
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = color } };
    addFullScreenPass(graph, context,
                      { .name = "alpha",
                        .material = context.resources.effects->get("alpha", constants, kAlpha),
                        .inputs = inputs,
                        .target = target });
}

/// addPicture() for light that is multiplied by alpha: tone mappers and gradings are of colours, not of shares of them.
void addTranslucentPicture(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps,
                           FrameTargets const& targets, TextureId target) {
    const uint2 size = sizeOf(graph, targets.color);
    FrameTargets straight = targets;
    straight.color = graph.createTexture(
            { .width = size.x, .height = size.y, .format = Format::RGBA16F, .name = "straight light" });
    addAlphaPass(graph, context, false, targets.color, straight.color);
    const Format format = graph.texture(target).desc.format;
    const TextureId picture = graph.createTexture({ .width = size.x,
                                                    .height = size.y,
                                                    .format = steps.hasTenBits ? Format::RGBA16F : format, // for alpha
                                                    .name = "straight picture" });
    addPicture(graph, context, steps, straight, picture);
    addAlphaPass(graph, context, true, picture, target);
}

/// Draws `target` from targets.color.
void addPictureOfView(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps,
                      FrameTargets const& targets, TextureId target) {
    const bool isLight = steps.isSceneLinear && !steps.hasLens();
    if (context.settings().isTranslucent() && !isLight)
        addTranslucentPicture(graph, context, steps, targets, target);
    else
        addPicture(graph, context, steps, targets, target);
}

/// What follows the tone mapper, from `picture`.
void addLaterPasses(FrameGraph& graph, FrameContext const& context, PostProcessSteps const& steps,
                    FrameTargets& targets, TextureId picture) {
    if (steps.hasAppPasses) {
        // The noise of the frame comes last, by the filter of edges, which copies where it has nothing to smooth.
        const bool isLast = !steps.smoothsEdges && !steps.changesPixels() && !steps.dithers && !steps.hasGrain;
        picture = addAppPasses(graph, context, targets, PassPlace::AfterToneMapping, picture,
                               isLast ? targets.output : TextureId{});
        if (isLast) return;
    }
    // Edges are smoothed before the image grows, since upscaling would take their steps for detail. Sharpening is last:
    // it makes up for the blur of upscaling. This is the order of FidelityFX Super Resolution 1 (Lottes 2021).
    if (steps.smoothsEdges || !steps.changesPixels()) {
        const TextureId smooth = steps.changesPixels()
                                         ? createUnfinished(graph, steps, sizeOf(graph, picture), "smooth")
                                         : targets.output;
        addFxaaPass(graph, context, steps, picture, smooth);
        picture = smooth;
    }
    const LastStep last{ .isSceneLinear = steps.isSceneLinear, .hasGrain = steps.hasGrain, .dithers = steps.dithers };
    if (steps.enlarges) {
        const TextureId large = steps.sharpens ? createUnfinished(graph, steps, sizeOf(graph, targets.output), "large")
                                               : targets.output;
        addUpscalingPass(graph, context, { picture, large },
                         steps.sharpens ? LastStep{ .isSceneLinear = steps.isSceneLinear } : last);
        picture = large;
    }
    if (steps.sharpens) addSharpeningPass(graph, context, { picture, targets.output }, last);
}

/// From targets.color to targets.output.
void addAllPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, bool isSceneLinear) {
    const uint2 size = sizeOf(graph, targets.color), shown = sizeOf(graph, targets.output);
    const PostProcessSteps steps =
            stepsOf(context, graph.texture(targets.target).desc.format, isSceneLinear, size != shown);
    if (!steps.hasLaterPass()) return addPictureOfView(graph, context, steps, targets, targets.output);
    TextureId picture = targets.color;
    if (steps.hasLens() || !steps.isSceneLinear) {
        picture = createUnfinished(graph, steps, size, steps.smoothsEdges ? "with edges" : "with few pixels");
        addPictureOfView(graph, context, steps, targets, picture);
    }
    addLaterPasses(graph, context, steps, targets, picture);
}

} // namespace

void addPostProcessPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, bool isSceneLinear) {
    if (targets.color == targets.output) return;
    if (!hasAppPasses(context, PassPlace::Last)) return addAllPasses(graph, context, targets, isSceneLinear);
    const TextureId output = targets.output;
    targets.output = createLike(graph, output, graph.texture(output).desc.format, 1, "before the last passes");
    addAllPasses(graph, context, targets, isSceneLinear);
    addAppPasses(graph, context, targets, PassPlace::Last, targets.output, output);
    targets.output = output;
}

} // namespace filament_core::passes
