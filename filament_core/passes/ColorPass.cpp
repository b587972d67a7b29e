// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ColorPass.h"

#include "filament_core/passes/AppPass.h"
#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenDraw.h"
#include "filament_core/passes/PassGroup.h"
#include "filament_core/passes/ResolvePass.h"
#include "filament_core/passes/SceneColorCopyPass.h"
#include "filament_core/passes/SlabCaps.h"
#include "filament_core/passes/SplatPass.h"
#include "filament_core/passes/TransparencyPass.h"
#include "shaders/interface/ShaderInterface.h"

#include <algorithm>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;
using prepare::DrawCall;

/// What of the view a pass draws: all, or what is drawn before the first copy of the scene colour, between two, or
/// after the last; and of the last of these what comes before, behind and after order-independent transparent objects.
struct ColorPart {
    bool isFirst = true, isLast = true; ///< the first draws opaque objects and the sky
    std::span<const DrawCall> blended;
    shader::TransparencyTerm transparency = shader::kTransparencyInOrder;
};

struct Chosen {
    std::array<BindGroupHandle, shader::kSurfaceKinds> passGroups; // by PassKind
    std::span<const DrawCall> opaqueDraws, blendedDraws;
    std::span<const PipelineHandle> opaque, blended;
    PipelineHandle sky, disc;
    BindGroupHandle skyGroup;
    std::span<const BindGroupHandle> discGroups;
    ChosenSlabCaps slabCaps;
};

/// What the pass declares besides its targets.
struct ColorBlocks {
    ColorPart part;
    PassBlock target;
    SlabBlocks slabs; ///< of the first part
    PassTextures textures;
    std::span<const PassBlock> discs; ///< parameters of the discs of suns
    bool hasDepth = false;            ///< of the prepass
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
uint32_t blendedSlot(PassContext& pass, FrameContext const& context, PipelineSource const& pipelines,
                     shader::TransparencyTerm transparency) {
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.shading = withoutOcclusion(slot.shading);
    slot.transparency = transparency;
    return pipelines.slot(slot);
}

/// The draws over the nth copy of the scene colour; 0: those before the first.
ColorPart partOf(prepare::ViewPacket const& view, size_t nth) {
    const size_t first = nth == 0 ? 0 : view.pictures[nth - 1].firstDraw;
    const bool isLast = nth == view.pictures.size();
    const size_t end = isLast ? view.blended.size() : view.pictures[nth].firstDraw;
    return { .isFirst = nth == 0, .isLast = isLast, .blended = view.blended.subspan(first, end - first) };
}

void chooseBackground(PassContext& pass, FrameContext const& context, ColorBlocks const& blocks, uint32_t slot,
                      Chosen& chosen) {
    PipelineSource const& pipelines = context.resources.pipelines;
    if (context.packet.demand.needs(prepare::Effect::Sky)) {
        chosen.sky = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.skybox);
        chosen.skyGroup = skyGroup(pass, context);
    }
    if (context.packet.demand.needs(prepare::Effect::SunDisc)) {
        chosen.disc = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.sunDisc);
        chosen.discGroups = discGroups(pass, context, blocks.discs);
    }
}

/// Of two levels of detail that fade into each other, a pixel shows the one that left its depth.
DrawSlots slotsOf(PassContext& pass, FrameContext const& context, uint32_t slot) {
    if (context.packet.mainView().counts.fadingLevels == 0) return slot;
    PassSlot fading = slotOf(context, pass.passLayout(), pass.subpass());
    fading.equalsDepth = true;
    return { slot, context.resources.pipelines.slot(fading) };
}

Chosen choose(PassContext& pass, FrameContext const& context, ColorBlocks const& blocks) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::ViewPacket const& view = context.packet.mainView();
    const PassSlot at = slotOf(context, pass.passLayout(), pass.subpass());
    const uint32_t slot = pipelines.slot(at);
    Chosen chosen;
    chosen.passGroups = surfaceGroups(pass, context, blocks.target, blocks.textures);
    chosen.blendedDraws = blocks.part.blended;
    if (blocks.part.isFirst) {
        chosen.slabCaps = chooseSlabCaps(pass, context, at, blocks.slabs, opaqueWithoutFade(context), blocks.textures,
                                         view.variant, view.channels);
        chosen.opaqueDraws = blocks.hasDepth ? view.opaque : opaqueWithoutFade(context);
        chosen.opaque = choosePipelines(pass, *context.arena, pipelines, slotsOf(pass, context, slot),
                                        chosen.opaqueDraws, view.variant, view.channels);
        chooseBackground(pass, context, blocks, slot, chosen);
    }
    const uint32_t blendedAt = blendedSlot(pass, context, pipelines, blocks.part.transparency);
    chosen.blended = choosePipelines(pass, *context.arena, pipelines, blendedAt, chosen.blendedDraws, view.variant,
                                     view.channels);
    return chosen;
}

void recordScene(PassContext& pass, FrameContext const& context, Chosen const& chosen) {
    const ViewGroup view = viewOf(context, 0).group;
    const DrawContext draws = shadedDraws(context, chosen.passGroups);
    recordSlabCaps(pass, draws, chosen.slabCaps);
    // The sky follows opaque objects, whose depth keeps it from pixels that they cover, and comes before transparent
    // ones, which it is seen through. Discs of suns add to the sky.
    recordDrawRanges(pass, draws, chosen.opaqueDraws, chosen.opaque);
    const BindGroupHandle unlit = chosen.passGroups[static_cast<size_t>(shader::PassKind::Unlit)];
    if (chosen.sky) recordFullScreen(pass.commands(), chosen.sky, view, unlit, std::span(&chosen.skyGroup, 1));
    if (chosen.disc) recordFullScreen(pass.commands(), chosen.disc, view, unlit, chosen.discGroups);
    recordDrawRanges(pass, draws, chosen.blendedDraws, chosen.blended);
}

/// What the parts of the view are drawn to.
struct ColorAttachments {
    TextureId color, samples, depth;
    TextureId sceneDepth{};  ///< the depth with one sample a pixel, if the scene colour is copied
    bool hasDepth = false;   ///< the prepass left it
    bool isWeighted = false; ///< a pass of its own resolves the last samples
};

ColorAttachments attachmentsOf(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    const uint8_t samples = context.settings().samples;
    ColorAttachments made{ .color = targets.color,
                           .isWeighted = context.packet.demand.needs(prepare::Effect::MsaaResolve) };
    const bool isStencilUsed = needsStencil(context);
    const Format depth = isStencilUsed ? Format::D32FS8 : Format::D32F;
    // Depths of the prepass have one sample a pixel and no stencil values. Where these are needed, and where only
    // effects asked for the prepass, the colour pass has a depth of its own.
    made.hasDepth = targets.depth && samples == 1 && !isStencilUsed &&
                    context.settings().quality.depthPrepass != DepthPrepass::Off;
    made.depth = made.hasDepth ? targets.depth : createLike(graph, made.color, depth, samples, "depth");
    made.samples = samples == 1
                           ? made.color
                           : createLike(graph, made.color, graph.texture(made.color).desc.format, samples, "samples");
    const bool isPeeled = !context.packet.mainView().anyOrder.empty() &&
                          context.settings().quality.transparency == TransparencyOrder::Peeled;
    if (context.packet.demand.needs(prepare::Effect::Refraction) ||
        context.packet.demand.needs(prepare::Effect::Splats) || context.keepsDepth || isPeeled)
        made.sceneDepth = samples == 1 ? made.depth : createLike(graph, made.color, depth, 1, "depth of the picture");
    return made;
}

void declareTargets(PassBuilder& pass, FrameContext const& context, ColorAttachments const& to, ColorPart const& part) {
    prepare::FrameSettings const& settings = context.settings();
    const bool isResolved = settings.samples > 1 && !(part.isLast && to.isWeighted);
    framegraph::ColorTarget color{ .resolve = isResolved ? to.color : TextureId{} };
    const float4 clear = settings.clearColor;
    if (part.isFirst) color.clear = std::array{ clear.x, clear.y, clear.z, clear.w };
    pass.writeColor(0, to.samples, color);
    framegraph::DepthTarget depth;
    // Later parts continue with the depth of earlier ones, and so does the first part with that of the prepass.
    if (part.isFirst && !to.hasDepth) depth.clear = settings.quality.depthRange == DepthRange::Reversed ? 0.0f : 1.0f;
    const bool isRead = !part.isLast || context.keepsDepth;
    if (isRead && settings.samples > 1) depth.resolve = to.sceneDepth;
    pass.writeDepth(to.depth, depth);
}

void addPart(FrameGraph& graph, FrameContext const& context, ColorAttachments const& to, std::string_view name,
             ColorBlocks blocks) {
    if (blocks.part.isFirst && showsSlabCaps(context)) blocks.slabs = declareSlabCaps(context, blocks.target);
    graph.addPass(
            name,
            [&](PassBuilder& pass) {
                declareTargets(pass, context, to, blocks.part);
                declareReads(pass, blocks.textures);
            },
            [of = &context, blocks](PassContext& pass) { return choose(pass, *of, blocks); },
            [of = &context](PassContext& pass, Chosen const& chosen) { recordScene(pass, *of, chosen); });
}

PassTextures texturesOf(FrameContext const& context, FrameTargets const& targets) {
    PassTextures textures{ .shadows = declareShadows(context, targets.shadows),
                           .occlusion = targets.ambientOcclusion,
                           .linearDepth = targets.linearDepth,
                           .fogCells = targets.fogCells,
                           .probes = declareProbes(context) };
    textures.shadows.hasMoments = context.packet.shadows.moments != prepare::ShadowMoments::None;
    return textures;
}

void showPicture(FrameContext const& context, framegraph::GraphTextureDesc const& target,
                 prepare::SceneColorCopy const& copy, TextureId texture, ColorBlocks& blocks) {
    blocks.target = declareTargetBeforePicture(context, target, context.settings().samples, copy);
    blocks.textures.sceneColor = texture;
    blocks.textures.sceneColorLevels = copy.levels;
}

/// The same part without what follows its first draws.
ColorPart before(ColorPart part, size_t draws) {
    part.isLast = false;
    part.blended = part.blended.first(draws);
    return part;
}

/// The last part of a view in which something blends in any order: what is before that in its order, that, and what is
/// after it.
void addComposedParts(FrameGraph& graph, FrameContext const& context, ColorAttachments const& to, std::string_view name,
                      ColorBlocks blocks) {
    prepare::ViewPacket const& view = context.packet.mainView();
    const ColorPart whole = blocks.part;
    const size_t skipped = view.blended.size() - whole.blended.size();
    blocks.part = before(whole, view.anyOrder.first - skipped);
    addPart(graph, context, to, name, blocks);
    const TransparencyTargets targets{ .color = to.color,
                                       .samples = to.samples,
                                       .depth = to.depth,
                                       .sceneDepth = to.sceneDepth,
                                       .target = blocks.target,
                                       .textures = blocks.textures };
    if (context.settings().quality.transparency == TransparencyOrder::Weighted) {
        addWeightedPasses(graph, context, targets);
    } else {
        // Layers are found first, because what lies beyond them needs the depth of the last one. It is drawn first all
        // the same: the layers are composed over it.
        const PeeledLayers layers = addPeelPasses(graph, context, targets);
        ColorBlocks beyond = blocks;
        beyond.textures.occlusion = layers.depth;
        beyond.part = { .isFirst = false,
                        .isLast = false,
                        .blended = view.anyOrderDraws(),
                        .transparency = shader::kTransparencyBeyond };
        addPart(graph, context, to, "beyond layers", beyond);
        addPeeledOver(graph, context, targets, layers);
    }
    blocks.part = { .isFirst = false, .isLast = true, .blended = view.blended.subspan(view.anyOrder.end) };
    if (!blocks.part.blended.empty()) addPart(graph, context, to, "blended", blocks);
}

/// The opaque objects of the first part, and the splats over them. Leaves the rest of the part.
void addSplatsFirst(FrameGraph& graph, FrameContext const& context, ColorAttachments const& to, ColorBlocks& blocks) {
    ColorPart rest = blocks.part;
    rest.isFirst = false;
    blocks.part = before(blocks.part, 0);
    if (blocks.part.isFirst) addPart(graph, context, to, "color", blocks);
    addSplatPasses(graph, context, { .color = to.color, .samples = to.samples, .depth = to.sceneDepth });
    blocks.part = rest;
}

/// The opaque objects of the first part, and the app's passes over them. Leaves the rest of the part.
void addAppPassesFirst(FrameGraph& graph, FrameContext const& context, FrameTargets& targets, ColorAttachments& to,
                       ColorBlocks& blocks) {
    ColorPart rest = blocks.part;
    rest.isFirst = false;
    blocks.part = before(blocks.part, 0);
    addPart(graph, context, to, "color", blocks);
    const TextureId changed = addAppPasses(graph, context, targets, PassPlace::AfterOpaque, to.color);
    if (to.samples == to.color) {
        to.color = to.samples = targets.color = changed;
    } else {
        // Edges of opaque objects have been smoothed by now: all samples of a pixel become the same.
        addCopyPass(graph, context, changed, to.samples, to.color);
    }
    blocks.part = rest;
}

} // namespace

void addColorPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const framegraph::GraphTextureDesc like = graph.texture(targets.color).desc;
    const uint8_t samples = context.settings().samples;
    ColorBlocks blocks{ .textures = texturesOf(context, targets) };
    blocks.target = declareTarget(context, like, 0, samples);
    if (targets.sceneColor) showPicture(context, like, wholeSceneColor(context), targets.sceneColor, blocks);
    blocks.discs = declareDiscs(context);
    ColorAttachments to = attachmentsOf(graph, context, targets);
    blocks.hasDepth = to.hasDepth;
    targets.depth = to.depth;
    targets.sceneDepth = to.sceneDepth;
    prepare::ViewPacket const& view = context.packet.mainView();
    const auto add = [&](std::string_view name) {
        if (blocks.part.isLast && !view.anyOrder.empty())
            addComposedParts(graph, context, to, name, blocks);
        else
            addPart(graph, context, to, name, blocks);
    };
    blocks.part = partOf(view, 0);
    if (hasAppPasses(context, PassPlace::AfterOpaque)) addAppPassesFirst(graph, context, targets, to, blocks);
    // Splats write no depth: opaque objects come before them, to hide them, and transparent objects after them.
    if (context.packet.demand.needs(prepare::Effect::Splats)) addSplatsFirst(graph, context, to, blocks);
    if (blocks.part.isFirst || !blocks.part.blended.empty()) add(blocks.part.isFirst ? "color" : "blended");
    for (size_t i = 0; i < view.pictures.size(); ++i) {
        // Each copy shows what all parts before it have drawn.
        targets.sceneColor = addSceneColorCopyPasses(graph, context, to.color, to.sceneDepth, view.pictures[i]);
        showPicture(context, like, view.pictures[i], targets.sceneColor, blocks);
        blocks.part = partOf(view, i + 1);
        add("refraction");
    }
    // The samples are complete only now. The device resolves them at the end of each part that is copied
    // (declareTargets()).
    if (to.isWeighted) addResolvePass(graph, context, to.samples, to.color);
}

} // namespace filament_core::passes
