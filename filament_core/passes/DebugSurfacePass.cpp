// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DebugSurfacePass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/SlabCaps.h"
#include "filament_core/prepare/DebugViews.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

struct ChosenSurfaces {
    ChosenSlabCaps slabCaps;
    ChosenDraws opaque, blended;
};

/// What of the surfaces is drawn, and to which targets.
struct DebugSurfaces {
    std::string_view name;
    DebugSlot debug = DebugSlot::Values;
    DebugView shown = DebugView::None;
    TextureId color, depth;
    bool keepsDepth = false; ///< what `depth` has already
    bool isOpaque = false;   ///< opaque ones alone
    uint8_t samples = 1;     ///< a pixel of `color`
    TextureId resolved{};    ///< of several samples a pixel: their mean
    TextureId resolvedDepth{};

    bool areNumbered() const { return debug == DebugSlot::Edges || debug == DebugSlot::Triangles; }
    bool mayShowCaps() const { return debug == DebugSlot::Values || debug == DebugSlot::Coverage; }
};

ChosenSurfaces chooseSurfaces(PassContext& pass, FrameContext const& context, DebugSurfaces const& surfaces,
                              PassBlock target, SlabBlocks const& slabs) {
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.debug = surfaces.debug;
    if (surfaces.areNumbered()) slot.edges = context.resources.edges;
    prepare::ViewPacket const& view = context.packet.mainView();
    const ChosenSlabCaps slabCaps = chooseSlabCaps(pass, context, slot, slabs, opaqueWithoutFade(context));
    if (surfaces.isOpaque)
        return { slabCaps, chooseDraws(pass, context, slot, target, opaqueWithoutFade(context)), {} };
    return { slabCaps, chooseDraws(pass, context, slot, target, view.opaque),
             chooseDraws(pass, context, slot, target, view.blended) };
}

void recordSurfaces(PassContext& pass, FrameContext const& context, ChosenSurfaces const& chosen) {
    const FrameView view = viewOf(context, 0);
    for (ChosenDraws const* list : { &chosen.opaque, &chosen.blended }) {
        const DrawContext draws{ view.group,
                                 list->passGroups,
                                 context.resources.instanceIds,
                                 context.deformations,
                                 context.settings().quality.textureFilter,
                                 {},
                                 !context.packet.numbered.empty() };
        if (list == &chosen.opaque) recordSlabCaps(pass, draws, chosen.slabCaps);
        recordDrawRanges(pass, draws, list->draws, list->pipelines);
    }
}

void addSurfaces(FrameGraph& graph, FrameContext const& context, DebugSurfaces const& to) {
    const PassBlock target = declareDebugTarget(context, graph.texture(to.color).desc, to.shown, to.samples);
    const bool hasSlabs = to.mayShowCaps() && showsSlabCaps(context);
    const SlabBlocks slabs = hasSlabs ? declareSlabCaps(context, target) : SlabBlocks{};
    graph.addPass(
            to.name,
            [&](PassBuilder& pass) {
                pass.writeColor(0, to.color, { .clear = std::array{ 0.0f, 0.0f, 0.0f, 0.0f }, .resolve = to.resolved });
                framegraph::DepthTarget depth{ .resolve = to.resolvedDepth };
                if (!to.keepsDepth)
                    depth.clear = context.settings().quality.depthRange == DepthRange::Reversed ? 0.0f : 1.0f;
                pass.writeDepth(to.depth, depth);
            },
            [of = &context, to, target, slabs](PassContext& pass) {
                return chooseSurfaces(pass, *of, to, target, slabs);
            },
            [of = &context](PassContext& pass, ChosenSurfaces const& chosen) { recordSurfaces(pass, *of, chosen); });
}

DebugSlot slotOf(DebugView shown) {
    if (prepare::showsCoverage(shown)) return DebugSlot::Coverage;
    return prepare::countsSurfaces(shown) ? DebugSlot::Counts : DebugSlot::Values;
}

/// With samples of its own; `targets` has the mean.
void addCoveragePass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const uint8_t samples = context.settings().samples;
    const Format depth = needsStencil(context) ? Format::D32FS8 : Format::D32F;
    targets.sceneDepth = targets.depth = createLike(graph, targets.color, depth, 1, "depth");
    addSurfaces(
            graph, context,
            { .name = "debug surfaces",
              .debug = DebugSlot::Coverage,
              .shown = context.settings().debugView,
              .color = createLike(graph, targets.color, graph.texture(targets.color).desc.format, samples, "samples"),
              .depth = createLike(graph, targets.color, depth, samples, "depth of samples"),
              .samples = samples,
              .resolved = targets.color,
              .resolvedDepth = context.keepsDepth ? targets.depth : TextureId{} });
}

/// Of what `targets.depth` shows, in the place of its values.
void addTriangleNumbers(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const TextureId numbers = createLike(graph, targets.color, Format::RGBA32F, 1, "triangles");
    addSurfaces(graph, context,
                { .name = "triangles",
                  .debug = DebugSlot::Triangles,
                  .shown = context.settings().debugView,
                  .color = numbers,
                  .depth = targets.depth,
                  .keepsDepth = true });
    targets.color = numbers;
}

} // namespace

void addDebugSurfacePass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (context.settings().samples > 1) return addCoveragePass(graph, context, targets);
    const DebugView shown = context.settings().debugView;
    const bool isStencilUsed = needsStencil(context);
    const bool hasDepth = targets.depth && !isStencilUsed;
    if (!hasDepth)
        targets.depth = createLike(graph, targets.color, isStencilUsed ? Format::D32FS8 : Format::D32F, 1, "depth");
    targets.sceneDepth = targets.depth;
    addSurfaces(graph, context,
                { .name = "debug surfaces",
                  .debug = slotOf(shown),
                  .shown = shown,
                  .color = targets.color,
                  .depth = targets.depth,
                  .keepsDepth = hasDepth });
    if (prepare::numbersTriangles(shown) && context.resources.edges) addTriangleNumbers(graph, context, targets);
}

void addTrianglePass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.resources.edges) { // the depths alone, for who reads them
        if (!targets.sceneDepth && context.keepsDepth) addDebugSurfacePass(graph, context, targets);
        return;
    }
    targets.triangles = createLike(graph, targets.color, Format::RGBA16F, 1, "triangles");
    const TextureId depth = createLike(graph, targets.color, Format::D32F, 1, "depth of triangles");
    if (!targets.sceneDepth) targets.sceneDepth = depth;
    addSurfaces(graph, context,
                { .name = "triangles",
                  .debug = DebugSlot::Edges,
                  .shown = context.settings().debugView,
                  .color = targets.triangles,
                  .depth = depth });
}

TextureId addNormalsPass(FrameGraph& graph, FrameContext const& context, uint2 size) {
    const auto create = [&](Format format, std::string_view name) {
        return graph.createTexture({ .width = size.x, .height = size.y, .format = format, .name = name });
    };
    const TextureId stored = create(Format::RGBA16F, "stored normals"), normals = create(Format::RGBA16F, "normals");
    addSurfaces(graph, context,
                { .name = "normals",
                  .shown = DebugView::Normals,
                  .color = stored,
                  .depth = create(needsStencil(context) ? Format::D32FS8 : Format::D32F, "depth of normals"),
                  .isOpaque = true });
    constexpr std::string_view kInputs[] = { "value" };
    const std::array constants{ EffectConstant{ "view", static_cast<int32_t>(DebugView::Normals) },
                                EffectConstant{ "isEncoded", false }, EffectConstant{ "isNumber", true } };
    const std::array inputs{ FullScreenInput{ .name = "value", .texture = stored } };
    addFullScreenPass(graph, context,
                      { .name = "normals",
                        .material = context.resources.effects->get("debug_material", constants,
                                                                   { .pass = "normals", .inputs = kInputs }),
                        .inputs = inputs,
                        .target = normals });
    return normals;
}

} // namespace filament_core::passes
