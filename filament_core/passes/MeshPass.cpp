// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/MeshPass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/DepthPass.h"
#include "filament_core/passes/TargetMips.h"
#include "filament_core/passes/ViewportBlitPass.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;
using prepare::DrawCall;

/// With the material that draws each.
std::span<const DrawCall> meshDraws(FrameContext const& context, MeshDraw const& mesh) {
    const std::span<const DrawCall> opaque = opaqueWithoutFade(context);
    const std::span<const DrawCall> blended =
            mesh.keepsHoles ? std::span<const DrawCall>{} : context.packet.mainView().blended;
    const std::span<DrawCall> draws = context.arena->array<DrawCall>(opaque.size() + blended.size());
    size_t count = 0;
    for (const std::span<const DrawCall> list : { opaque, blended }) {
        for (DrawCall const& each : list) {
            if (each.pass == prepare::DrawPass::Second) continue;
            DrawCall& draw = draws[count++] = each;
            draw.material = mesh.material;
            draw.pass = prepare::DrawPass::Only;
            draw.firstField = prepare::kNowhere; // nothing is lit
        }
    }
    return draws.first(count);
}

ChosenDraws chooseMeshes(PassContext& pass, FrameContext const& context, MeshDraw& mesh, PassBlock target) {
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.equalsDepth = mesh.keepsHoles;
    mesh.slot = context.resources.pipelines.slot(slot);
    mesh.draws = meshDraws(context, mesh);
    return chooseDraws(pass, context, slot, target, mesh.draws);
}

void recordMeshes(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{ view.group, chosen.passGroups, context.resources.instanceIds, context.deformations,
                             context.settings().quality.textureFilter };
    recordDrawRanges(pass, draws, chosen.draws, chosen.pipelines);
}

/// The colours of the target, in the order of its attachments.
struct MeshColors {
    std::array<TextureId, 4> textures;
    std::array<bool, 4> isKept{};
    size_t count = 0;
};

MeshColors importColors(FrameGraph& graph, MeshDraw const& mesh, FrameOutput const& output,
                        std::span<const FrameOutput> others) {
    MeshColors colors;
    const auto import = [&](FrameOutput const& each) {
        const bool isKept = mesh.isKept && each.hasContents;
        colors.isKept[colors.count] = isKept;
        colors.textures[colors.count++] = importOutput(graph, each, isKept);
    };
    import(output);
    for (FrameOutput const& other : others)
        if (other.texture) import(other);
    return colors;
}

void declareColors(PassBuilder& pass, MeshDraw const& mesh, MeshColors const& colors, OutputPart const& part) {
    for (uint8_t i = 0; i < colors.count; ++i) {
        framegraph::ColorTarget target;
        if (!colors.isKept[i]) target.clear = mesh.clear[i];
        if (i == 0) target.level = part.level, target.layer = part.layer;
        pass.writeColor(i, colors.textures[i], target);
    }
}

} // namespace

void describeMeshPass(FrameGraph& graph, FrameContext const& context, MeshDraw& mesh, FrameOutput const& output,
                      std::span<const FrameOutput> others) {
    const MeshColors colors = importColors(graph, mesh, output, others);
    const uint2 size(output.width, output.height);
    const framegraph::GraphTextureDesc desc{
        .width = size.x, .height = size.y, .format = Format::D32F, .name = "depth of meshes"
    };
    FrameTargets targets{ .target = colors.textures[0] };
    targets.sceneDepth = mesh.keepsHoles ? addDepthOfView(graph, context, size, desc.name) : graph.createTexture(desc);
    graph.addPass(
            mesh.name,
            [&](PassBuilder& pass) {
                declareColors(pass, mesh, colors, output.part);
                framegraph::DepthTarget depth;
                const bool isReversed = context.settings().quality.depthRange == DepthRange::Reversed;
                if (!mesh.keepsHoles) depth.clear = isReversed ? 0.0f : 1.0f;
                pass.writeDepth(targets.sceneDepth, depth);
            },
            [of = &context, drawn = &mesh, target = declareTarget(context, desc)](PassContext& pass) {
                return chooseMeshes(pass, *of, *drawn, target);
            },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordMeshes(pass, *of, chosen); });
    addTargetMips(graph, context, output, targets);
    addTargetDepth(graph, context, output, targets);
}

} // namespace filament_core::passes
