// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DepthPass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/SectionDepthPass.h"

#include <algorithm>
#include <array>
#include <bit>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

/// Levels of detail that fade into each other leave their depths where their pattern has pixels.
std::span<const prepare::DrawCall> fadingDepths(FrameContext const& context) {
    prepare::ViewPacket const& view = context.packet.mainView();
    if (view.counts.fadingLevels == 0) return view.opaque;
    const std::span<prepare::DrawCall> draws = context.arena->copy(view.opaque);
    for (prepare::DrawCall& draw : draws) {
        if (draw.fade == 0) continue;
        scene::InstanceRaster const& raster = draw.material->raster;
        const bool hasBothSides = raster.cullingDisabled || raster.culling == shader::Culling::None;
        draw.material = context.resources.levelFade[hasBothSides];
    }
    return draws;
}

struct ChosenDepths {
    ChosenSlabCaps slabCaps;
    ChosenDraws surfaces;
};

ChosenDepths chooseDepths(PassContext& pass, FrameContext const& context, PassBlock target, SlabBlocks const& slabs) {
    PassSlot at = depthSlot(context.settings(), depthOfViewKey(context.shading));
    if (slabs.first.bytes > 0) at.layout.depthFormat = Format::D32FS8;
    FILAMENT_ASSERT(at.layout == pass.passLayout() && pass.subpass() == 0, "the depth prepass is a pass of its own");
    return { chooseSlabCaps(pass, context, at, slabs, opaqueWithoutFade(context)),
             chooseDraws(pass, context, at, target, fadingDepths(context)) };
}

void recordDepths(PassContext& pass, FrameContext const& context, ChosenDepths const& chosen) {
    const FrameView view = viewOf(context, 0);
    ChosenDraws const& surfaces = chosen.surfaces;
    const DrawContext draws{ view.group, surfaces.passGroups, context.resources.instanceIds, context.deformations,
                             context.settings().quality.textureFilter };
    recordSlabCaps(pass, draws, chosen.slabCaps);
    recordDrawRanges(pass, draws, surfaces.draws, surfaces.pipelines);
}

/// Materials read distances; full-screen passes take the depths themselves.
bool isDistanceRead(prepare::SceneDemand const& demand) {
    return demand.needs(prepare::Effect::Reflections) || demand.needs(prepare::Effect::ContactShadows);
}

constexpr std::string_view kDistanceInputs[] = { "depth" };
constexpr FullScreenInterface kDistance{ .pass = "distances", .inputs = kDistanceInputs };
constexpr std::string_view kPyramidInputs[] = { "level" };
constexpr FullScreenInterface kPyramid{ .pass = "depth pyramid", .inputs = kPyramidInputs };

/// From the level before it.
void addPyramidLevel(FrameGraph& graph, FrameContext const& context, uint8_t level, TextureId distances) {
    const std::array inputs{ FullScreenInput{
            .name = "level", .texture = distances, .range = oneLevel(static_cast<uint8_t>(level - 1)) } };
    addFullScreenPass(graph, context,
                      { .name = "depth pyramid",
                        .material = context.resources.effects->get("depth_pyramid", {}, kPyramid),
                        .inputs = inputs,
                        .target = distances,
                        .level = level });
}

void addDistances(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    const uint2 size = context.settings().size;
    const bool isMarched = context.packet.demand.needs(prepare::Effect::Reflections);
    const uint8_t levels = isMarched ? pyramidLevels(size) : uint8_t{ 1 };
    targets.linearDepth = graph.createTexture(
            { .width = size.x, .height = size.y, .format = Format::R32F, .levels = levels, .name = "distances" });
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = targets.prepassDepth } };
    addFullScreenPass(graph, context,
                      { .name = "distances",
                        .material = context.resources.effects->get("linear_depth", {}, kDistance),
                        .inputs = inputs,
                        .target = targets.linearDepth });
    for (uint8_t level = 1; level < levels; ++level) addPyramidLevel(graph, context, level, targets.linearDepth);
}

} // namespace

uint8_t pyramidLevels(uint2 view) {
    constexpr uint32_t kMost = 7; // cells of 64 pixels
    return static_cast<uint8_t>(std::clamp<uint32_t>(std::bit_width(std::min(view.x, view.y)), 2, kMost + 1) - 1);
}

PassSlot depthSlot(prepare::FrameSettings const& settings, ShadingKey shading) {
    PassSlot slot{ .layout = { .depthFormat = Format::D32F },
                   .shading = shading,
                   .depthRange = settings.quality.depthRange,
                   .depthOnly = true,
                   .cutsSections = settings.cutsSections };
    slot.layout.subpasses[0].colorMask = 0;
    return slot;
}

TextureId addDepthOfView(FrameGraph& graph, FrameContext const& context, uint2 size, std::string_view name) {
    const bool hasSlabs = showsSlabCaps(context);
    const Format format = hasSlabs ? Format::D32FS8 : Format::D32F;
    const framegraph::GraphTextureDesc desc{ .width = size.x, .height = size.y, .format = format, .name = name };
    const TextureId depth = graph.createTexture(desc);
    const PassBlock target = declareTarget(context, desc);
    const SlabBlocks slabs = hasSlabs ? declareSlabCaps(context, target) : SlabBlocks{};
    graph.addPass(
            name,
            [&](PassBuilder& pass) {
                const bool isReversed = context.settings().quality.depthRange == DepthRange::Reversed;
                pass.writeDepth(depth, { .clear = isReversed ? 0.0f : 1.0f });
            },
            [of = &context, target, slabs](PassContext& pass) { return chooseDepths(pass, *of, target, slabs); },
            [of = &context](PassContext& pass, ChosenDepths const& chosen) { recordDepths(pass, *of, chosen); });
    return depth;
}

void addDepthPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::DepthPrepass)) return;
    targets.depth = targets.prepassDepth = addDepthOfView(graph, context, context.settings().size, "depth");
    if (showsCaps(context))
        targets.prepassDepth = targets.sectionDepth = addSectionDepthPass(graph, context, targets.depth);
    if (isDistanceRead(context.packet.demand)) addDistances(graph, context, targets);
}

} // namespace filament_core::passes
