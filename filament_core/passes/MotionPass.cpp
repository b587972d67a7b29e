// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/MotionPass.h"

#include "filament_core/passes/ChosenDraws.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using prepare::DrawCall;

PassSlot slotOf(PassContext& pass, prepare::FrameSettings const& settings) {
    return { .layout = pass.passLayout(),
             .subpass = pass.subpass(),
             .depthRange = settings.quality.depthRange,
             .motionOnly = true,
             .cutsSections = settings.cutsSections };
}

/// With the material that draws each.
std::span<const DrawCall> drawsOf(FrameContext const& context) {
    const std::span<DrawCall> draws = context.arena->copy(context.packet.views[context.packet.motionView].opaque);
    for (DrawCall& draw : draws) {
        if (!draw.material->material->package.findVariant(shader::kVariantMotion))
            draw.material = context.resources.motion;
    }
    return draws;
}

void recordMotion(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const FrameView view = viewOf(context, context.packet.motionView);
    DrawContext draws{ view.group, chosen.passGroups, context.resources.instanceIds, context.deformations,
                       context.settings().quality.textureFilter };
    draws.hasPairs = true;
    recordDrawRanges(pass, draws, chosen.draws, chosen.pipelines);
}

} // namespace

void addMotionPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Motion)) return;
    const uint2 size = context.settings().size;
    const framegraph::GraphTextureDesc desc{ .width = size.x,
                                             .height = size.y,
                                             .format = context.settings().givesNumbers ? Format::RGBA32F
                                                                                       : Format::RGBA16F,
                                             .name = "motion" };
    targets.motionVectors = graph.createTexture(desc);
    graph.addPass(
            "motion",
            [&](PassBuilder& pass) {
                pass.writeColor(0, targets.motionVectors, { .clear = std::array{ 0.0f, 0.0f, 0.0f, 0.0f } });
                // Tested, not written: only what is seen leaves a vector, and the depths of the prepass stay for the
                // passes after this.
                pass.writeDepth(targets.depth, {});
            },
            [of = &context, target = declareTarget(context, desc)](PassContext& pass) {
                return chooseDraws(pass, *of, slotOf(pass, of->settings()), target, drawsOf(*of));
            },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordMotion(pass, *of, chosen); });
}

} // namespace filament_core::passes
