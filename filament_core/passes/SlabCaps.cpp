// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SlabCaps.h"

#include "filament_core/passes/FullScreenDraw.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::PassContext;
using prepare::DrawCall;

bool isCutOpen(DrawCall const& draw) { return draw.material->material->package.sectionPlanes; }

StencilState marked() { return bothSides({ .onPass = StencilOperation::IncrementClamp }); }

/// What is not: elsewhere the test fails, which takes the mark back.
StencilState unmarked() { return bothSides({ .test = StencilTest::Equal, .onFail = StencilOperation::Zero }); }

/// Surfaces that leave their depth alone.
PassSlot depthAlone(PassSlot slot) {
    if (slot.depthOnly) return slot;
    slot.transparency = shader::kTransparencyDepth;
    if (slot.layout.samples == 1) {
        slot.depthOnly = true;
        slot.debug = DebugSlot::None;
        slot.shading = depthOfViewKey(slot.shading);
    } else {
        slot.debug = DebugSlot::Values; // cuts samples of a pixel one by one, and lights nothing
    }
    return slot;
}

/// The back faces of surfaces alone: RasterStates.cpp.
std::span<const DrawCall> backFaces(FrameContext const& context, std::span<const DrawCall> draws) {
    const std::span<DrawCall> backs = context.arena->copy(draws);
    for (DrawCall& draw : backs) draw.pass = prepare::DrawPass::Second;
    return backs;
}

} // namespace

std::span<const DrawCall> cutOpen(FrameContext const& context, std::span<const DrawCall> draws) {
    const std::span<DrawCall> kept = context.arena->copy(draws);
    const auto end = std::remove_if(kept.begin(), kept.end(), [](DrawCall const& draw) { return !isCutOpen(draw); });
    return kept.first(static_cast<size_t>(end - kept.begin()));
}

bool showsCaps(FrameContext const& context) {
    return context.settings().cutsSections && std::ranges::any_of(context.packet.mainView().opaque, isCutOpen);
}

bool showsSlabCaps(FrameContext const& context) { return context.settings().cutsSlabs && showsCaps(context); }

SlabBlocks declareSlabCaps(FrameContext const& context, PassBlock target) {
    const PassBlock first = declareSectionPart(context, target, SectionPart::FirstSurfaces);
    return { first, declareSectionPart(context, first, SectionPart::SlabCaps),
             declareSectionPart(context, target, SectionPart::SlabCaps) };
}

ChosenSlabCaps chooseSlabCaps(PassContext& pass, FrameContext const& context, PassSlot const& slot,
                              SlabBlocks const& blocks, std::span<const DrawCall> surfaces,
                              PassTextures const& textures, uint8_t variant, prepare::ChannelLists const& channels) {
    if (blocks.first.bytes == 0) return {};
    PipelineSource const& pipelines = context.resources.pipelines;
    const std::span<const DrawCall> draws = cutOpen(context, surfaces);
    ChosenSlabCaps chosen;
    chosen.first = chooseDraws(pass, context, depthAlone(slot), blocks.first, draws);
    const std::span<const DrawCall> backs = backFaces(context, draws);
    PassSlot marks = depthAlone(slot);
    marks.equalsDepth = true;
    marks.stencil = marked();
    chosen.marks = chooseDraws(pass, context, marks, blocks.marks, backs);
    if (!slot.depthOnly) {
        PassSlot caps = slot;
        caps.equalsDepth = true;
        chosen.caps = { surfaceGroups(pass, context, blocks.caps, textures), backs,
                        choosePipelines(pass, *context.arena, pipelines, pipelines.slot(caps), backs, variant,
                                        channels) };
    }
    const PassSlot others{ .layout = slot.layout,
                           .subpass = slot.subpass,
                           .depthRange = slot.depthRange,
                           .isFullScreen = true,
                           .depthOnly = slot.depthOnly,
                           .isShadowMap = slot.isShadowMap,
                           .transparency = shader::kTransparencyDepth,
                           .stencil = unmarked() };
    chosen.farDepth =
            pipelines.fullscreenPipeline(pass.commands(), pipelines.slot(others), *context.resources.farDepth);
    return chosen;
}

void recordSlabCaps(PassContext& pass, DrawContext draws, ChosenSlabCaps const& chosen) {
    if (!chosen.farDepth) return;
    for (ChosenDraws const* list : { &chosen.first, &chosen.marks, &chosen.caps }) {
        draws.passGroups = list->passGroups;
        recordDrawRanges(pass, draws, list->draws, list->pipelines);
    }
    pass.commands().record(CmdSetStencilReference{});
    recordFullScreen(pass.commands(), chosen.farDepth, draws.view,
                     chosen.first.passGroups[static_cast<size_t>(shader::PassKind::Unlit)]);
}

} // namespace filament_core::passes
