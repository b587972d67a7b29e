// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ColorPass.h"

#include "filament_core/passes/DrawRecorder.h"

namespace filament::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

struct ChosenPipelines {
    std::span<const PipelineHandle> opaque, blended;
    PipelineHandle sky;
};

ChosenPipelines choose(PassContext& pass, FrameContext const& context) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::ViewPacket const& view = context.packet.mainView();
    PassSettings const& settings = context.settings;
    const uint32_t slot = pipelines.slot(slotOf(settings, pass.passLayout(), pass.subpass()));
    ChosenPipelines chosen;
    chosen.opaque = choosePipelines(pass, *context.arena, pipelines, slot, view.opaque, view.variant);
    chosen.blended = choosePipelines(pass, *context.arena, pipelines, slot, view.blended, view.variant);
    if (context.resources.skybox)
        chosen.sky = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.skybox);
    return chosen;
}

void recordSky(CommandBuffer& commands, ViewGroup const& view, PipelineHandle pipeline) {
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(view.bind(0));
    commands.record(CmdDraw{ 3 });
}

void recordScene(PassContext& pass, FrameContext const& context, ChosenPipelines const& chosen) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{ view.group, context.resources.instanceIds, context.deformations,
                             context.settings.textureFilter };
    recordDrawRanges(pass, draws, view.packet.opaque, chosen.opaque);
    if (chosen.sky) recordSky(pass.commands(), view.group, chosen.sky);
    recordDrawRanges(pass, draws, view.packet.blended, chosen.blended);
}

} // namespace

void addColorPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    PassSettings const& settings = context.settings;
    const TextureId color = targets.color;
    const framegraph::GraphTextureDesc like = graph.texture(color).desc;
    const TextureId depth = graph.createTexture({ .width = like.width,
                                                  .height = like.height,
                                                  .format = Format::D32F,
                                                  .samples = settings.samples,
                                                  .name = "depth" });
    const TextureId samples = settings.samples == 1 ? color
                                                    : graph.createTexture({ .width = like.width,
                                                                            .height = like.height,
                                                                            .format = like.format,
                                                                            .samples = settings.samples,
                                                                            .name = "samples" });
    targets.depth = depth;
    graph.addPass(
            "color",
            [&](PassBuilder& pass) {
                const float4 clear = settings.clearColor;
                pass.writeColor(0, samples,
                                { .clear = std::array{ clear.x, clear.y, clear.z, clear.w },
                                  .resolve = settings.samples == 1 ? TextureId{} : color });
                pass.writeDepth(depth, { .clear = settings.depthRange == DepthRange::Reversed ? 0.0f : 1.0f });
            },
            [of = &context](PassContext& pass) { return choose(pass, *of); },
            [of = &context](PassContext& pass, ChosenPipelines const& chosen) { recordScene(pass, *of, chosen); });
}

} // namespace filament::passes
