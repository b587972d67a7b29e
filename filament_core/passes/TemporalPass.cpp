// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/TemporalPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/Reprojection.h"

#include <array>

namespace filament_core::passes {
namespace {

constexpr std::string_view kInputs[] = { "color", "history", "depth", "motion" };
constexpr FullScreenParameter kValues[] = { { "lastFromPixel", ParameterType::Float4x4 },
                                            { "perPixel", ParameterType::Float2 },
                                            { "jitter", ParameterType::Float2 },
                                            { "weight", ParameterType::Float },
                                            { "ramp", ParameterType::Float },
                                            { "perSample", ParameterType::Float2 } };
constexpr FullScreenInterface kInterface{ .pass = "taa", .inputs = kInputs, .values = kValues };

/// What is known of the surfaces of a part of the image.
struct KnownSurfaces {
    bool hasDepth = false, hasMotion = false;
};

scene::Material const& temporalMaterial(FrameContext const& context, KnownSurfaces surfaces, bool isEnlarged,
                                        bool showsShares) {
    const bool isElsewhere = context.packet.last.isElsewhere;
    // A still camera and still objects need no depth: pixels stay where they are.
    const bool hasDepth = surfaces.hasDepth && (isElsewhere || surfaces.hasMotion);
    const std::array constants{ EffectConstant{ "isElsewhere", isElsewhere },
                                EffectConstant{ "hasDepth", hasDepth },
                                EffectConstant{ "isFixed", context.packet.accumulation.isFixed },
                                EffectConstant{ "hasMotion", surfaces.hasMotion },
                                EffectConstant{ "isEnlarged", isEnlarged },
                                EffectConstant{ "showsShares", showsShares } };
    return context.resources.effects->get("taa", constants, kInterface);
}

} // namespace

bool isUpscaledOverFrames(FrameContext const& context) {
    return context.packet.demand.needs(prepare::Effect::Taa) && context.settings().isUpscaledOverFrames();
}

void addTemporalPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Taa)) return;
    const bool isEnlarged = isUpscaledOverFrames(context);
    const uint2 size = isEnlarged ? context.settings().shownSize : context.settings().size;
    const framegraph::History history = graph.history(
            { .width = size.x, .height = size.y, .format = backend::Format::RGBA16F, .name = "accumulated color" }, {},
            context.packet.accumulation.weight == 1);
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "history",
                                              .texture = history.previous,
                                              .sampler = context.resources.samplers.bilinear },
                             FullScreenInput{ .name = "depth", .texture = targets.prepassDepth },
                             FullScreenInput{ .name = "motion", .texture = targets.motionVectors } };
    const std::array values{ FullScreenValue{ "lastFromPixel", lastFromPixel(context, double2(1)) },
                             FullScreenValue{ "perPixel", 1.0f / float2(size) },
                             FullScreenValue{ "jitter", context.packet.accumulation.jitterPixels },
                             FullScreenValue{ "weight", context.packet.accumulation.weight },
                             FullScreenValue{ "ramp", context.packet.accumulation.ramp },
                             FullScreenValue{ "perSample", 1.0f / float2(context.settings().size) } };
    const auto add = [&](std::string_view name, bool showsShares, framegraph::TextureId target) {
        const KnownSurfaces there{ static_cast<bool>(targets.prepassDepth), static_cast<bool>(targets.motionVectors) };
        scene::Material const &around = temporalMaterial(context, {}, isEnlarged, showsShares),
                              &material = temporalMaterial(context, there, isEnlarged, showsShares);
        std::array<FullScreenTile, 5> tiles{ FullScreenTile{ context.packet.covered, values } };
        size_t count = 1;
        for (backend::Rect const& rect : rectsAround(context.packet.covered, size))
            if (rect.width > 0 && rect.height > 0) tiles[count++] = { rect, values, &around };
        // The covered part is one of the smaller image. Where nothing is different beside objects, one draw will do.
        const bool isOne = isEnlarged || &around == &material || count == 1;
        addFullScreenPass(graph, context,
                          { .name = name,
                            .material = material,
                            .inputs = inputs,
                            .values = values,
                            .target = target,
                            .tiles = std::span(tiles).first(isOne ? 0 : count),
                            .fillsTarget = true });
    };
    add("taa", false, history.current);
    if (context.settings().debugView == DebugView::HistoryWeight) {
        targets.historyWeight = graph.createTexture(
                { .width = size.x, .height = size.y, .format = backend::Format::RGBA16F, .name = "history share" });
        add("taa shares", true, targets.historyWeight);
    }
    targets.color = history.current;
}

} // namespace filament_core::passes
