// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/TransparencyPass.h"

#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;

constexpr std::array<float, 4> kNothing{ 0, 0, 0, 0 };
constexpr std::array<float, 4> kNoLayer{ 0, 0, 0, 1 }; // alpha: all light passes

constexpr std::string_view kOverInputs[] = { "surfaces", "cover" };
constexpr FullScreenInterface kOver{ .pass = "transparency", .inputs = kOverInputs };

/// What lies under what is there is drawn front to back, so that of two surfaces of one depth the same is on top.
std::span<const prepare::DrawCall> anyOrderDraws(FrameContext const& context, shader::TransparencyTerm term) {
    const auto draws = context.packet.mainView().anyOrderDraws();
    if (term != shader::kTransparencyLayer) return draws;
    const std::span<prepare::DrawCall> reversed = context.arena->copy(draws);
    std::ranges::reverse(reversed);
    return reversed;
}

ChosenDraws chooseSurfaces(PassContext& pass, FrameContext const& context, TransparencyTargets const& targets,
                           shader::TransparencyTerm term) {
    PipelineSource const& pipelines = context.resources.pipelines;
    prepare::ViewPacket const& view = context.packet.mainView();
    PassSlot slot = slotOf(context, pass.passLayout(), pass.subpass());
    slot.shading = withoutOcclusion(slot.shading);
    slot.transparency = term;
    const std::span<const prepare::DrawCall> draws = anyOrderDraws(context, term);
    return { surfaceGroups(pass, context, targets.target, targets.textures), draws,
             choosePipelines(pass, *context.arena, pipelines, pipelines.slot(slot), draws, view.variant,
                             view.channels) };
}

void recordSurfaces(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    recordDrawRanges(pass, shadedDraws(context, chosen.passGroups), chosen.draws, chosen.pipelines);
}

/// `attach` declares the attachments.
template <class Attach>
void addSurfaces(FrameGraph& graph, FrameContext const& context, std::string_view name,
                 TransparencyTargets const& targets, shader::TransparencyTerm term, Attach&& attach) {
    graph.addPass(
            name,
            [&](PassBuilder& pass) {
                attach(pass);
                declareReads(pass, targets.textures);
            },
            [of = &context, targets, term](PassContext& pass) { return chooseSurfaces(pass, *of, targets, term); },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordSurfaces(pass, *of, chosen); });
}

/// Drawn with the samples of the view, before the depth of opaque objects. Returns their mean.
TextureId addSums(FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets, Format format,
                  std::string_view name, shader::TransparencyTerm term) {
    const uint8_t samples = context.settings().samples;
    const TextureId mean = createLike(graph, targets.color, format, 1, name);
    const TextureId drawn = samples == 1 ? mean : createLike(graph, targets.color, format, samples, name);
    addSurfaces(graph, context, name, targets, term, [&](PassBuilder& pass) {
        pass.writeColor(0, drawn, { .clear = kNothing, .resolve = samples == 1 ? TextureId{} : mean });
        pass.testDepth(targets.depth);
    });
    return mean;
}

void addOver(FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets, TextureId surfaces,
             TextureId cover) {
    const EffectConstant constants[] = { { "isWeighted", static_cast<bool>(cover) } };
    const std::array inputs{ FullScreenInput{ .name = "surfaces", .texture = surfaces },
                             FullScreenInput{ .name = "cover", .texture = cover } };
    addFullScreenPass(graph, context,
                      { .name = "transparency",
                        .material = context.resources.effects->get("transparency", constants, kOver),
                        .inputs = inputs,
                        .target = targets.samples,
                        .resolve = targets.samples == targets.color ? TextureId{} : targets.color });
}

} // namespace

// McGuire and Bavoil 2013, "Weighted Blended Order-Independent Transparency".
void addWeightedPasses(FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets) {
    const TextureId sums =
            addSums(graph, context, targets, Format::RGBA16F, "weighted light", shader::kTransparencyWeightedLight);
    const TextureId cover =
            addSums(graph, context, targets, Format::R16F, "weighted cover", shader::kTransparencyCover);
    addOver(graph, context, targets, sums, cover);
}

// Everitt 2001, "Interactive Order-Independent Transparency".
PeeledLayers addPeelPasses(FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets) {
    const float farthest = context.settings().quality.depthRange == DepthRange::Reversed ? 0.0f : 1.0f;
    PeeledLayers layers{ .light = createLike(graph, targets.color, Format::RGBA16F, 1, "layers") };
    const uint32_t count = context.settings().quality.transparencyLayers - 1u;
    TransparencyTargets with = targets;
    for (uint32_t i = 0; i < count; ++i) {
        const framegraph::ColorTarget light =
                i == 0 ? framegraph::ColorTarget{ .clear = kNoLayer } : framegraph::ColorTarget{};
        // The binding of ambient occlusion has the depth of the layer before: unlit materials have it, too, and
        // transparent surfaces are not occluded.
        with.textures.occlusion = layers.depth;
        layers.depth = createLike(graph, targets.color, Format::D32F, 1, "layer depth");
        addSurfaces(graph, context, "layer depth", with,
                    i == 0 ? shader::kTransparencyDepth : shader::kTransparencyNextDepth, [&](PassBuilder& pass) {
                        pass.writeColor(0, layers.light, light);
                        pass.writeDepth(layers.depth, { .clear = farthest });
                    });
        with.textures.occlusion = layers.depth;
        // The surface that left the depth is shaded: it passes an equality in the shader, not a depth test, whose
        // attachment holds the opaque surfaces.
        addSurfaces(graph, context, "layer", with, shader::kTransparencyLayer, [&](PassBuilder& pass) {
            pass.writeColor(0, layers.light);
            pass.testDepth(targets.sceneDepth);
        });
    }
    return layers;
}

void addPeeledOver(FrameGraph& graph, FrameContext const& context, TransparencyTargets const& targets,
                   PeeledLayers const& layers) {
    addOver(graph, context, targets, layers.light, {});
}

} // namespace filament_core::passes
