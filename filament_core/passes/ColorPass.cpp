// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ColorPass.h"

#include "filament_core/passes/DrawRecorder.h"
#include "filament_core/passes/PassGroup.h"
#include "shaders/interface/ShaderInterface.h"

namespace filament::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

struct Chosen {
    std::array<BindGroupHandle, 2> passGroups; // by PassKind
    std::span<const PipelineHandle> opaque, blended;
    PipelineHandle sky;
    BindGroupHandle skyGroup;
};

BindGroupHandle skyGroup(PassContext& pass, FrameContext const& context) {
    shader::MaterialPackage const& package = context.resources.skybox->package;
    const BindGroupEntry entry{ .binding = package.findParameter("sky")->binding,
                                .texture = context.packet.environment.sky,
                                .sampler = context.resources.samplers.bilinear };
    return pass.bindGroup(package.layout[shader::kGroupMaterial], std::span(&entry, 1), "sky");
}

Chosen choose(PassContext& pass, FrameContext const& context, PassBlock target) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::ViewPacket const& view = context.packet.mainView();
    PassSettings const& settings = context.settings;
    const uint32_t slot = pipelines.slot(slotOf(settings, pass.passLayout(), pass.subpass()));
    Chosen chosen;
    chosen.passGroups = { passGroup(pass, context, shader::PassKind::Lit, target),
                          passGroup(pass, context, shader::PassKind::Unlit, target) };
    chosen.opaque = choosePipelines(pass, *context.arena, pipelines, slot, view.opaque, view.variant);
    chosen.blended = choosePipelines(pass, *context.arena, pipelines, slot, view.blended, view.variant);
    if (context.packet.demand.needs(prepare::Effect::Sky)) {
        chosen.sky = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.skybox);
        chosen.skyGroup = skyGroup(pass, context);
    }
    return chosen;
}

void recordSky(CommandBuffer& commands, ViewGroup const& view, Chosen const& chosen) {
    commands.record(CmdBindPipeline{ chosen.sky });
    commands.record(view.bind(0));
    commands.record(
            CmdBindGroup{ chosen.passGroups[static_cast<size_t>(shader::PassKind::Unlit)], shader::kGroupPass });
    commands.record(CmdBindGroup{ chosen.skyGroup, shader::kGroupMaterial });
    commands.record(CmdDraw{ 3 });
}

void recordScene(PassContext& pass, FrameContext const& context, Chosen const& chosen) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{ view.group, chosen.passGroups, context.resources.instanceIds, context.deformations,
                             context.settings.textureFilter };
    recordDrawRanges(pass, draws, view.packet.opaque, chosen.opaque);
    if (chosen.sky) recordSky(pass.commands(), view.group, chosen);
    recordDrawRanges(pass, draws, view.packet.blended, chosen.blended);
}

} // namespace

void addColorPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    PassSettings const& settings = context.settings;
    const TextureId color = targets.color;
    const framegraph::GraphTextureDesc like = graph.texture(color).desc;
    const PassBlock target = declareTarget(context, like, 0, settings.samples);
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
            [of = &context, target](PassContext& pass) { return choose(pass, *of, target); },
            [of = &context](PassContext& pass, Chosen const& chosen) { recordScene(pass, *of, chosen); });
}

} // namespace filament::passes
