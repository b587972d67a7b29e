// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ShadowPass.h"

#include "filament_core/passes/DrawRecorder.h"
#include "filament_core/passes/FullScreenDraw.h"
#include "filament_core/passes/PassGroup.h"
#include "filament_core/passes/ShadowMoments.h"
#include "filament_core/passes/SlabCaps.h"

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using prepare::ShadowMapPacket;
using prepare::ShadowTile;

/// A map, or one of its channels, that is drawn in this frame.
struct DrawnMap {
    ShadowTile tile;
    uint32_t view = 0; ///< of the packet
    PassBlock target;
    SlabBlocks slabs;
    ChosenSlabCaps slabCaps;
    std::array<BindGroupHandle, shader::kSurfaceKinds> passGroups; ///< by PassKind
    std::span<const PipelineHandle> pipelines;
};

struct ChosenShadow {
    PipelineHandle farDepth; ///< empties a tile; none: all of the atlas is cleared
};

/// As ShadowTexture makes it.
Format depthFormat(bool hasStencil) { return hasStencil ? Format::D32FS8 : Format::D32F; }

std::span<DrawnMap> drawnMaps(FrameContext const& context) {
    prepare::ShadowPacket const& shadows = context.packet.shadows;
    const std::span<DrawnMap> drawn = context.arena->array<DrawnMap>(prepare::drawnChannels(shadows));
    size_t count = 0;
    for (ShadowMapPacket const& map : shadows.maps) {
        if (map.view == prepare::kKeptMap) continue;
        for (uint32_t channel = 0; channel < map.channels; ++channel) {
            const ShadowTile tile = prepare::channelTile(map, channel);
            DrawnMap& next = drawn[count++];
            next.tile = tile;
            next.view = map.view;
            next.target = declareShadowTarget(context, tile.size, map.channels > 1 ? channel + 1 : 0);
            if (shadows.hasStencil) next.slabs = declareSlabCaps(context, next.target);
        }
    }
    return drawn;
}

ChosenShadow choose(PassContext& pass, FrameContext const& context, std::span<DrawnMap> maps) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::FrameSettings const& settings = context.settings();
    const PassSlot at = shadowSlot(settings.quality, settings.cutsSections, settings.cutsSlabs);
    FILAMENT_ASSERT(at.layout == pass.passLayout() && pass.subpass() == 0, "shadow maps are a pass of their own");
    const uint32_t slot = pipelines.slot(at);
    for (DrawnMap& map : maps) {
        const std::span<const prepare::DrawCall> casters = context.packet.views[map.view].opaque;
        map.passGroups = surfaceGroups(pass, context, map.target);
        map.pipelines = choosePipelines(pass, *context.arena, pipelines, slot, casters, 0);
        map.slabCaps = chooseSlabCaps(pass, context, at, map.slabs, casters);
    }
    ChosenShadow chosen;
    if (context.packet.shadows.keepsAtlas)
        chosen.farDepth = pipelines.fullscreenPipeline(pass.commands(), slot, *context.resources.farDepth);
    return chosen;
}

void enterTile(CommandBuffer& commands, ShadowTile tile) {
    const auto x = static_cast<float>(tile.x), y = static_cast<float>(tile.y), size = static_cast<float>(tile.size);
    commands.record(CmdSetViewport{ { x, y, size, size } });
    commands.record(CmdSetScissor{ { tile.x, tile.y, tile.size, tile.size } });
}

void recordMaps(PassContext& pass, FrameContext const& context, std::span<const DrawnMap> maps,
                ChosenShadow const& chosen) {
    for (DrawnMap const& map : maps) {
        const FrameView view = viewOf(context, map.view);
        enterTile(pass.commands(), map.tile);
        // Other tiles of the atlas keep their maps. A load operation clears whole attachments, so a triangle empties
        // the tile.
        if (chosen.farDepth)
            recordFullScreen(pass.commands(), chosen.farDepth, view.group,
                             map.passGroups[static_cast<size_t>(shader::PassKind::Unlit)]);
        const DrawContext draws{ view.group, map.passGroups, context.resources.instanceIds, context.deformations,
                                 context.settings().quality.textureFilter };
        recordSlabCaps(pass, draws, map.slabCaps);
        recordDrawRanges(pass, draws, view.packet.opaque, map.pipelines);
    }
}

void addDepthPass(FrameGraph& graph, FrameContext const& context, framegraph::TextureId atlas) {
    const bool keepsAtlas = context.packet.shadows.keepsAtlas;
    const std::span<DrawnMap> maps = drawnMaps(context);
    graph.addPass(
            "shadow maps",
            [&](PassBuilder& pass) {
                framegraph::DepthTarget target;
                if (!keepsAtlas) target.clear = 0.0f;
                pass.writeDepth(atlas, target);
            },
            [of = &context, maps](PassContext& pass) { return choose(pass, *of, maps); },
            [of = &context, maps](PassContext& pass, ChosenShadow const& chosen) {
                recordMaps(pass, *of, maps, chosen);
            });
}

} // namespace

PassSlot shadowSlot(Quality const& quality, bool cutsSections, bool cutsSlabs) {
    PassSlot slot{ .layout = { .depthFormat = depthFormat(cutsSlabs) },
                   .shading = depthShadingKey(quality.coloredShadows),
                   .depthOnly = true,
                   .isShadowMap = true,
                   .cutsSections = cutsSections };
    slot.layout.subpasses[0].colorMask = 0;
    return slot;
}

void addShadowPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    prepare::ShadowPacket const& shadows = context.packet.shadows;
    if (shadows.maps.empty()) return;
    using framegraph::InitialContents;
    targets.shadows = targets.shadowDepths =
            graph.importTexture(context.resources.shadowAtlas,
                                { .width = shadows.atlasSize,
                                  .height = shadows.atlasSize,
                                  .format = depthFormat(shadows.hasStencil),
                                  .name = "shadow maps" },
                                shadows.keepsAtlas ? InitialContents::Keep : InitialContents::Undefined);
    if (shadows.drawn > 0) addDepthPass(graph, context, targets.shadows);
    addShadowMoments(graph, context, targets);
}

} // namespace filament_core::passes
