// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ColorPass.h"

#include "filament_core/passes/DrawRecorder.h"
#include "filament_core/passes/FullScreenDraw.h"
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
    std::array<BindGroupHandle, shader::kSurfaceKinds> passGroups; // by PassKind
    std::span<const PipelineHandle> opaque, blended;
    PipelineHandle sky, disc;
    BindGroupHandle skyGroup;
    std::span<const BindGroupHandle> discGroups;
};

/// What the pass declares besides its targets.
struct ColorBlocks {
    PassBlock target;
    PassTextures textures;
    std::span<const PassBlock> discs; ///< parameters of the discs of suns
};

std::span<const PassBlock> declareDiscs(FrameContext const& context) {
    const std::span<PassBlock> blocks = context.arena->array<PassBlock>(context.packet.discs.size());
    for (size_t i = 0; i < blocks.size(); ++i)
        blocks[i] = context.blocks->add(std::as_bytes(context.packet.discs.subspan(i, 1)));
    return blocks;
}

std::span<const BindGroupHandle> discGroups(PassContext& pass, FrameContext const& context,
                                            std::span<const PassBlock> blocks) {
    shader::MaterialPackage const& package = context.resources.sunDisc->package;
    FILAMENT_ASSERT(package.uniformBytes == sizeof(prepare::SunDisc) &&
                            package.findParameter("halo")->offset == offsetof(prepare::SunDisc, halo),
                    "sun_disc.mat has the parameters of SunDisc");
    const std::span<BindGroupHandle> groups = context.arena->array<BindGroupHandle>(blocks.size());
    for (size_t i = 0; i < blocks.size(); ++i) {
        const BindGroupEntry entry = context.blocks->entry(0, blocks[i]);
        groups[i] = pass.bindGroup(package.layout[shader::kGroupMaterial], std::span(&entry, 1), package.name);
    }
    return groups;
}

BindGroupHandle skyGroup(PassContext& pass, FrameContext const& context) {
    shader::MaterialPackage const& package = context.resources.skybox->package;
    const BindGroupEntry entry{ .binding = package.findParameter("sky")->binding,
                                .texture = context.packet.environment.sky,
                                .sampler = context.resources.samplers.bilinear };
    return pass.bindGroup(package.layout[shader::kGroupMaterial], std::span(&entry, 1), "sky");
}

/// What the occlusion of the surfaces behind does not apply to.
uint32_t blendedSlot(PassContext& pass, PassSettings const& settings, PipelineSource const& pipelines) {
    PassSlot slot = slotOf(settings, pass.passLayout(), pass.subpass());
    slot.shading = withoutOcclusion(slot.shading);
    return pipelines.slot(slot);
}

Chosen choose(PassContext& pass, FrameContext const& context, ColorBlocks const& blocks) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::ViewPacket const& view = context.packet.mainView();
    PassSettings const& settings = context.settings;
    const uint32_t slot = pipelines.slot(slotOf(settings, pass.passLayout(), pass.subpass()));
    Chosen chosen;
    chosen.passGroups = surfaceGroups(pass, context, blocks.target, blocks.textures);
    chosen.opaque = choosePipelines(pass, *context.arena, pipelines, slot, view.opaque, view.variant, view.channels);
    chosen.blended = choosePipelines(pass, *context.arena, pipelines, blendedSlot(pass, settings, pipelines),
                                     view.blended, view.variant, view.channels);
    if (context.packet.demand.needs(prepare::Effect::Sky)) {
        chosen.sky = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.skybox);
        chosen.skyGroup = skyGroup(pass, context);
    }
    if (context.packet.demand.needs(prepare::Effect::SunDisc)) {
        chosen.disc = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.sunDisc);
        chosen.discGroups = discGroups(pass, context, blocks.discs);
    }
    return chosen;
}

void recordScene(PassContext& pass, FrameContext const& context, Chosen const& chosen) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{ view.group,
                             chosen.passGroups,
                             context.resources.instanceIds,
                             context.deformations,
                             context.settings.textureFilter,
                             view.packet.channels };
    recordDrawRanges(pass, draws, view.packet.opaque, chosen.opaque);
    const BindGroupHandle unlit = chosen.passGroups[static_cast<size_t>(shader::PassKind::Unlit)];
    if (chosen.sky) recordFullScreen(pass.commands(), chosen.sky, view.group, unlit, std::span(&chosen.skyGroup, 1));
    if (chosen.disc) recordFullScreen(pass.commands(), chosen.disc, view.group, unlit, chosen.discGroups);
    recordDrawRanges(pass, draws, view.packet.blended, chosen.blended);
}

} // namespace

void addColorPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    PassSettings const& settings = context.settings;
    const TextureId color = targets.color;
    const framegraph::GraphTextureDesc like = graph.texture(color).desc;
    PassTextures textures{ .shadows = declareShadows(context, targets.shadows),
                           .occlusion = targets.occlusion,
                           .sceneDepth = targets.distances };
    textures.shadows.hasMoments = context.packet.shadows.moments != prepare::ShadowMoments::None;
    const ColorBlocks blocks{ declareTarget(context, like, 0, settings.samples), textures, declareDiscs(context) };
    const bool hasDepth = targets.depth && settings.samples == 1 &&
                          context.view->quality.depthPrepass != DepthPrepass::Off; // the prepass left it
    const TextureId depth = hasDepth ? targets.depth
                                     : graph.createTexture({ .width = like.width,
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
                declareReads(pass, blocks.textures);
                framegraph::DepthTarget target;
                if (!hasDepth) target.clear = settings.depthRange == DepthRange::Reversed ? 0.0f : 1.0f;
                pass.writeDepth(depth, target);
            },
            [of = &context, blocks](PassContext& pass) { return choose(pass, *of, blocks); },
            [of = &context](PassContext& pass, Chosen const& chosen) { recordScene(pass, *of, chosen); });
}

} // namespace filament::passes
