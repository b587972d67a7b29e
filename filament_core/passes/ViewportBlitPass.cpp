// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ViewportBlitPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/SectionDepthPass.h"

#include <array>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::InitialContents;
using prepare::FrameSettings;

constexpr std::string_view kPlaceInputs[] = { "picture" };
constexpr FullScreenParameter kPlaceValues[] = { { "offset", ParameterType::Int2 } };
constexpr FullScreenInterface kPlace{ .pass = "place", .inputs = kPlaceInputs, .values = kPlaceValues };

constexpr std::string_view kDepthInputs[] = { "depth" };
constexpr FullScreenInterface kTargetDepth{ .pass = "target depth", .inputs = kDepthInputs };
constexpr float kNothingMeters = 1e30f; // kFarDistance of shaders/lib/distance.glsl

/// Load operation of the target.
struct Clearing {
    bool clears = false;
    float4 color{ 0 };
};

void place(FrameGraph& graph, FrameContext const& context, std::string_view material, framegraph::TextureId picture,
           framegraph::TextureId target, Clearing const& clearing, OutputPart const& part = {}) {
    FrameSettings const& settings = context.settings();
    const uint2 offset = settings.viewport ? settings.viewport->offset : uint2(0), size = settings.shownSize;
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = picture } };
    const std::array values{ FullScreenValue{ "offset", int2(offset) } };
    const std::array tiles{ FullScreenTile{
            .rect = { static_cast<int32_t>(offset.x), static_cast<int32_t>(offset.y), size.x, size.y },
            .values = values } };
    addFullScreenPass(graph, context,
                      { .name = "place",
                        .material = context.resources.effects->get(material, {}, kPlace),
                        .inputs = inputs,
                        .target = target,
                        .level = part.level,
                        .layer = part.layer,
                        .tiles = tiles,
                        .fillsTarget = !settings.viewport,
                        .clears = clearing.clears,
                        .clearColor = clearing.color });
}

bool fillsTarget(FrameSettings const& settings, FrameOutput const& output) {
    return !settings.viewport ||
           (settings.shownSize == uint2(output.width, output.height) && !settings.isTranslucent());
}

bool isCleared(filament_core::Viewport const& viewport, FrameOutput const& output) {
    return viewport.contents == TargetContents::Clear || !output.hasContents;
}

/// Of a view in a part of its target. Two bits are not enough for the alpha of one that is translucent.
Format formatOfView(FrameSettings const& settings, Format target) {
    return target == Format::RGB10A2 && settings.isTranslucent() ? Format::RGBA16F : target;
}

} // namespace

framegraph::TextureId importOutput(FrameGraph& graph, FrameOutput const& output, bool isKept) {
    OutputPart const& part = output.part;
    if (!part.isOne)
        return graph.importTexture(output.texture,
                                   { .width = output.width,
                                     .height = output.height,
                                     .format = output.format,
                                     .levels = output.srgbLevels,
                                     .name = "output" },
                                   isKept ? InitialContents::Keep : InitialContents::Undefined);
    return graph.importTexture(output.texture,
                               { .width = part.width,
                                 .height = part.height,
                                 .format = output.format,
                                 .levels = part.levels,
                                 .layers = part.layers,
                                 .type = part.kind,
                                 .name = "output" },
                               InitialContents::Keep);
}

void beginViewportBlit(FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                       FrameTargets& targets) {
    FrameSettings const& settings = context.settings();
    const bool fills = fillsTarget(settings, output) && !output.part.isOne;
    const bool isKept = !fills && settings.viewport && !isCleared(*settings.viewport, output);
    targets.target = importOutput(graph, output, isKept);
    // A view that fills its target is drawn there directly. Others need an image of their own: passes write whole
    // targets.
    targets.output = fills ? targets.target
                           : graph.createTexture({ .width = settings.shownSize.x,
                                                   .height = settings.shownSize.y,
                                                   .format = formatOfView(settings, output.format),
                                                   .name = "view" });
}

void addViewportBlitPass(FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                         FrameTargets const& targets) {
    if (targets.output == targets.target) return;
    FrameSettings const& settings = context.settings();
    Clearing clearing;
    if (settings.viewport) clearing = { isCleared(*settings.viewport, output), settings.viewport->clearColor };
    place(graph, context, settings.isTranslucent() ? "place_over" : "place", targets.output, targets.target, clearing,
          output.part);
}

void addGuardBandCutPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const uint2 size = context.settings().insideSize();
    const framegraph::TextureId inside = graph.createTexture(
            { .width = size.x, .height = size.y, .format = Format::RGBA16F, .name = "without its band" });
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = targets.color } };
    const std::array values{ FullScreenValue{ "offset", -int2(static_cast<int32_t>(context.settings().band)) } };
    addFullScreenPass(graph, context,
                      { .name = "guard band",
                        .material = context.resources.effects->get("place", {}, kPlace),
                        .inputs = inputs,
                        .values = values,
                        .target = inside });
    targets.color = inside;
}

void addTargetDepth(FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                    FrameTargets const& targets) {
    if (!output.depth) return;
    FrameSettings const& settings = context.settings();
    const bool fills = !settings.viewport || settings.shownSize == uint2(output.width, output.height);
    const bool isCleared = !fills && (settings.viewport->contents == TargetContents::Clear || !output.hasDepths);
    const framegraph::TextureId whole = graph.importTexture(
            output.depth, { .width = output.width, .height = output.height, .format = Format::R32F, .name = "depths" },
            fills || isCleared ? InitialContents::Undefined : InitialContents::Keep);
    const framegraph::TextureId drawn = fills ? whole
                                              : graph.createTexture({ .width = settings.shownSize.x,
                                                                      .height = settings.shownSize.y,
                                                                      .format = Format::R32F,
                                                                      .name = "view depths" });
    const bool isScaled = sizeOf(graph, targets.sceneDepth) != settings.shownSize;
    const std::array constants{ EffectConstant{ "isScaled", isScaled } };
    const framegraph::TextureId depth = depthWithCaps(graph, context, targets.sceneDepth);
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = depth } };
    addFullScreenPass(graph, context,
                      { .name = "target depth",
                        .material = context.resources.effects->get("linear_depth", constants, kTargetDepth),
                        .inputs = inputs,
                        .target = drawn });
    if (!fills) place(graph, context, "place", drawn, whole, { isCleared, float4(kNothingMeters, 0, 0, 0) });
}

} // namespace filament_core::passes
