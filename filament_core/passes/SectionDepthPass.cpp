// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SectionDepthPass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;
using prepare::DrawCall;

constexpr auto kCapDepth = static_cast<DebugView>(63); // kViewCapDepth of debug_views.glsl

constexpr std::string_view kDepthCopyInputs[] = { "picture" };
constexpr FullScreenParameter kDepthCopyValues[] = { { "offset", ParameterType::Int2 } };

void addDepthCopy(FrameGraph& graph, FrameContext const& context, TextureId depth, TextureId target) {
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = depth } };
    const std::array values{ FullScreenValue{ "offset", int2(0) } };
    addFullScreenPass(
            graph, context,
            { .name = "depth of sections",
              .material = context.resources.effects->get(
                      "place", {}, { .pass = "place", .inputs = kDepthCopyInputs, .values = kDepthCopyValues }),
              .inputs = inputs,
              .values = values,
              .target = target });
}

struct ChosenCaps {
    ChosenDraws caps, slabCaps;
};

/// `slabs`: empty: there are none.
ChosenCaps chooseCaps(PassContext& pass, FrameContext const& context, PassBlock target, PassBlock slabs) {
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.debug = DebugSlot::Values;
    slot.equalsDepth = true;
    const std::span<const DrawCall> draws = cutOpen(context, opaqueWithoutFade(context));
    ChosenCaps chosen{ chooseDraws(pass, context, slot, target, draws), {} };
    if (slabs.bytes > 0) chosen.slabCaps = chooseDraws(pass, context, slot, slabs, draws);
    return chosen;
}

void recordCaps(PassContext& pass, FrameContext const& context, ChosenCaps const& chosen) {
    for (ChosenDraws const* list : { &chosen.caps, &chosen.slabCaps }) {
        const DrawContext draws{ viewOf(context, 0).group, list->passGroups, context.resources.instanceIds,
                                 context.deformations, context.settings().quality.textureFilter };
        recordDrawRanges(pass, draws, list->draws, list->pipelines);
    }
}

} // namespace

TextureId addSectionDepthPass(FrameGraph& graph, FrameContext const& context, TextureId depth) {
    framegraph::GraphTextureDesc desc = graph.texture(depth).desc;
    const uint2 size(desc.width, desc.height);
    desc = { .width = size.x, .height = size.y, .format = Format::R32F, .name = "depth of sections" };
    const TextureId target = graph.createTexture(desc);
    addDepthCopy(graph, context, depth, target);
    const PassBlock caps = declareDebugTarget(context, desc, kCapDepth);
    const PassBlock slabs =
            showsSlabCaps(context) ? declareSectionPart(context, caps, SectionPart::SlabCaps) : PassBlock{};
    graph.addPass(
            "depth of caps",
            [&](PassBuilder& pass) {
                pass.writeColor(0, target, {});
                pass.writeDepth(depth, {}); // tested; equal depths are written
            },
            [of = &context, caps, slabs](PassContext& pass) { return chooseCaps(pass, *of, caps, slabs); },
            [of = &context](PassContext& pass, ChosenCaps const& chosen) { recordCaps(pass, *of, chosen); });
    return target;
}

} // namespace filament_core::passes
