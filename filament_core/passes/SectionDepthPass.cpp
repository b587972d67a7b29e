// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SectionDepthPass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>

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

bool isCutOpen(DrawCall const& draw) { return draw.material->material->package.sectionPlanes; }

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

ChosenDraws chooseCaps(PassContext& pass, FrameContext const& context, PassBlock target) {
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.debug = DebugSlot::Values;
    slot.equalsDepth = true;
    const std::span<DrawCall> draws = context.arena->copy(opaqueWithoutFade(context));
    const auto end = std::remove_if(draws.begin(), draws.end(), [](DrawCall const& draw) { return !isCutOpen(draw); });
    return chooseDraws(pass, context, slot, target, draws.first(static_cast<size_t>(end - draws.begin())));
}

void recordCaps(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const DrawContext draws{ viewOf(context, 0).group, chosen.passGroups, context.resources.instanceIds,
                             context.deformations, context.settings().quality.textureFilter };
    recordDrawRanges(pass, draws, chosen.draws, chosen.pipelines);
}

} // namespace

bool showsCaps(FrameContext const& context) {
    return context.settings().cutsSections && std::ranges::any_of(context.packet.mainView().opaque, isCutOpen);
}

TextureId addSectionDepthPass(FrameGraph& graph, FrameContext const& context, TextureId depth) {
    framegraph::GraphTextureDesc desc = graph.texture(depth).desc;
    const uint2 size(desc.width, desc.height);
    desc = { .width = size.x, .height = size.y, .format = Format::R32F, .name = "depth of sections" };
    const TextureId target = graph.createTexture(desc);
    addDepthCopy(graph, context, depth, target);
    graph.addPass(
            "depth of caps",
            [&](PassBuilder& pass) {
                pass.writeColor(0, target, {});
                pass.writeDepth(depth, {}); // tested; equal depths are written
            },
            [of = &context, block = declareDebugTarget(context, desc, kCapDepth)](PassContext& pass) {
                return chooseCaps(pass, *of, block);
            },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordCaps(pass, *of, chosen); });
    return target;
}

} // namespace filament_core::passes
