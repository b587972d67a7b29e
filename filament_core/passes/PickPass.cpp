// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PickPass.h"

#include "filament_core/passes/SlabCaps.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using prepare::DrawCall;

PassSlot pickSlot(PassContext& pass, bool cutsSections) {
    return { .layout = pass.passLayout(),
             .subpass = pass.subpass(),
             .depthOnly = true,
             .cutsSections = cutsSections,
             .isPick = true };
}

/// With the material that draws each.
std::span<const DrawCall> pickDraws(FrameContext const& context) {
    const std::span<DrawCall> draws = context.arena->copy(context.packet.mainView().opaque);
    for (DrawCall& draw : draws) {
        if (draw.material->material->isBlended()) draw.material = context.resources.motion;
    }
    return draws;
}

void recordPick(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen, uint2 size, uint2 pixel) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{ view.group, chosen.passGroups, context.resources.instanceIds, context.deformations,
                             context.settings().quality.textureFilter };
    for (size_t i = 0; i < chosen.draws.size(); ++i) {
        // Each object has a pixel of its own: the viewport moves the picked pixel there, and the scissor keeps the rest
        // out. So one read-back has the depth of every candidate.
        const auto x = static_cast<int32_t>(i % kPickSide), y = static_cast<int32_t>(i / kPickSide);
        pass.commands().record(CmdSetViewport{ { static_cast<float>(x) - static_cast<float>(pixel.x),
                                                 static_cast<float>(y) - static_cast<float>(pixel.y),
                                                 static_cast<float>(size.x), static_cast<float>(size.y) } });
        pass.commands().record(CmdSetScissor{ { x, y, 1, 1 } });
        recordDraws(pass.commands(), draws, chosen.draws.subspan(i, 1), chosen.pipelines.subspan(i, 1));
    }
}

} // namespace

void addPickPass(FrameGraph& graph, FrameContext const& context, framegraph::TextureId depths, uint2 size,
                 uint2 pixel) {
    PassBlock target = declareTarget(context, { .width = size.x, .height = size.y });
    // Each object has its first surface, wherever that is: which of them are seen is known when all are (Picker.cpp).
    if (showsSlabCaps(context)) target = declareSectionPart(context, target, SectionPart::FirstSurfaces);
    graph.addPass(
            "pick", [&](PassBuilder& pass) { pass.writeDepth(depths, { .clear = 0.0f }); },
            [of = &context, target](PassContext& pass) {
                return chooseDraws(pass, *of, pickSlot(pass, of->settings().cutsSections), target, pickDraws(*of));
            },
            [of = &context, size, pixel](PassContext& pass, ChosenDraws const& chosen) {
                recordPick(pass, *of, chosen, size, pixel);
            });
}

} // namespace filament_core::passes
