// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FogLightPass.h"

#include "filament_core/passes/PassGroup.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"

#include <algorithm>
#include <array>
#include <span>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassContext;

constexpr uint32_t kGroupSide = 8; // invocations, as in the shader

struct FogGrid {
    uint32_t columns, rows, slices;
};

FogGrid gridOf(FrameContext const& context) {
    const float4 grid = context.packet.mainView().uniforms.fogGrid;
    return { static_cast<uint32_t>(grid.x), static_cast<uint32_t>(grid.y), static_cast<uint32_t>(grid.z) };
}

/// FogHistoryUniforms of the shader.
struct FogHistoryUniforms {
    float4x4 lastClipFromWorld;
    float4 lastAlongView, place, exposure;
};

bool isMeanOfFrames(FrameContext const& context) { return context.settings().effects.fog.volumetricFrames > 1; }

uint32_t termsOf(FrameContext const& context) {
    Fog const& fog = context.settings().effects.fog;
    uint32_t terms = 0;
    if (fog.noiseAmplitude > 0) terms |= shader::kFogLightVaries;
    if (fog.attenuatesLight) terms |= shader::kFogLightIsWeakened;
    if (isMeanOfFrames(context)) terms |= shader::kFogLightOfFrames;
    return terms;
}

/// What the stage is specialised with: lights, shadows, and nothing else, which would make another pipeline of it.
auto constantsOf(FrameContext const& context) {
    constexpr size_t kQuality = shader::kQualityConstants.size(), kVariants = shader::kVariantConstants.size();
    std::array<ConstantValue, kQuality + kVariants> constants{};
    std::ranges::copy(shadingConstants(ofLights(context.shading)), constants.begin());
    std::ranges::find(constants, uint32_t{ shader::kQualityFog }, &ConstantValue::id)->bits = termsOf(context);
    const auto variants =
            shader::variantConstants(context.packet.mainView().variant & uint16_t{ shader::kVariantShadowReceiver });
    std::ranges::copy(variants, constants.begin() + kQuality);
    return constants;
}

PipelineHandle pipelineOf(PassContext& pass, FrameContext const& context) {
    const auto constants = constantsOf(context);
    const ProgramLayout layout = shader::fogLightLayout();
    const DispatchStage stage{ "fog_light", layout, constants };
    DispatchCache& dispatches = *context.resources.dispatches;
    if (!pass.isRehearsal()) return dispatches.pipelineFor(pass.commands(), stage);
    dispatches.expect(stage);
    return {};
}

/// Where the dispatch finds and leaves light. Without a mean over frames it reads and writes none: any buffer will do.
struct FogLightBuffers {
    framegraph::BufferId cells, last, light;
    PassBlock history;
};

FogLightBuffers declareBuffers(FrameGraph& graph, FrameContext const& context) {
    FogLightBuffers buffers{ .cells = graph.createBuffer("fog cells", fogCellBytes(context)) };
    if (const uint32_t bytes = fogLightBytes(context); bytes > 0) {
        using framegraph::InitialContents;
        FrameResources const& resources = context.resources;
        buffers.last = graph.importBuffer(resources.lastFogLight, "last fog light", bytes, InitialContents::Keep);
        buffers.light = graph.importBuffer(resources.fogLight, "fog light", bytes, InitialContents::Undefined);
    }
    prepare::FogAccumulation const& mean = context.packet.fogAccumulation;
    const FogHistoryUniforms history{ .lastClipFromWorld = context.packet.last.clipFromWorld,
                                      .lastAlongView = context.packet.last.alongView,
                                      .place = float4(mean.place, mean.weight),
                                      .exposure = float4(mean.exposure, 0, 0, 0) };
    buffers.history = context.blocks->add(std::as_bytes(std::span(&history, 1)));
    return buffers;
}

void bindGroups(PassContext& pass, FrameContext const& context, PassShadows const& shadows,
                FogLightBuffers const& buffers) {
    const ProgramLayout layout = shader::fogLightLayout();
    const ViewGroup view = viewOf(context, 0).group;
    const FrameSamplers& samplers = context.resources.samplers;
    const TextureHandle maps = shadows.maps ? pass.texture(shadows.maps) : context.resources.white;
    const std::array<BindGroupEntry, 2> ofPass{ {
            { .binding = shader::kBindingShadowMaps,
              .texture = maps,
              .sampler = shadows.hasMoments ? samplers.trilinear : samplers.nearest },
            context.blocks->entry(shader::kBindingShadows, shadows.block),
    } };
    const uint32_t lightBytes = fogLightBytes(context);
    const BufferHandle cells = pass.buffer(buffers.cells);
    const std::array<BindGroupEntry, 4> written{ {
            { .binding = shader::kBindingWrittenFogCells, .buffer = cells, .size = fogCellBytes(context) },
            context.blocks->entry(shader::kBindingFogHistory, buffers.history),
            { .binding = shader::kBindingLastFogLight,
              .buffer = lightBytes > 0 ? pass.buffer(buffers.last) : context.resources.noFogCells,
              .size = lightBytes > 0 ? lightBytes : uint32_t{ sizeof(float4) } },
            { .binding = shader::kBindingWrittenFogLight,
              .buffer = lightBytes > 0 ? pass.buffer(buffers.light) : cells,
              .size = lightBytes > 0 ? lightBytes : fogCellBytes(context) },
    } };
    CommandBuffer& commands = pass.commands();
    commands.record(CmdBindGroup{ pass.bindGroup(layout[shader::kGroupView], context.viewBuffers, "fog light"),
                                  shader::kGroupView,
                                  1,
                                  { view.uniforms } });
    commands.record(
            CmdBindGroup{ pass.bindGroup(layout[shader::kGroupPass], ofPass, "fog light"), shader::kGroupPass });
    commands.record(CmdBindGroup{ pass.bindGroup(layout[shader::kGroupMaterial], written, "fog light"),
                                  shader::kGroupMaterial });
}

} // namespace

uint32_t fogCellBytes(FrameContext const& context) {
    const FogGrid grid = gridOf(context);
    return grid.columns * grid.rows * (grid.slices + 1) * shader::kFogCellBytes;
}

uint32_t fogLightBytes(FrameContext const& context) {
    if (!context.packet.demand.needs(prepare::Effect::VolumetricFog) || !isMeanOfFrames(context)) return 0;
    const FogGrid grid = gridOf(context);
    return grid.columns * grid.rows * grid.slices * shader::kFogCellBytes;
}

void addFogLightPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::VolumetricFog)) return;
    const FogLightBuffers buffers = declareBuffers(graph, context);
    PassShadows shadows = declareShadows(context, targets.shadows);
    shadows.hasMoments = context.packet.shadows.moments != prepare::ShadowMoments::None;
    if (!shadows.maps) shadows.block = buffers.history; // unread: any block will do
    graph.addPass(
            "fog light",
            [&](framegraph::PassBuilder& pass) {
                using enum framegraph::BufferUse;
                if (shadows.maps) pass.readSampled(shadows.maps);
                if (buffers.last) pass.readBuffer(buffers.last, Storage);
                if (buffers.light) pass.writeBuffer(buffers.light, Storage, framegraph::Previous::Overwrite);
                pass.writeBuffer(buffers.cells, Storage, framegraph::Previous::Overwrite);
            },
            [of = &context](PassContext& pass) { return pipelineOf(pass, *of); },
            [of = &context, shadows, buffers](PassContext& pass, PipelineHandle pipeline) {
                const FogGrid grid = gridOf(*of);
                pass.commands().record(CmdBindPipeline{ pipeline });
                bindGroups(pass, *of, shadows, buffers);
                pass.commands().record(CmdDispatch{ (grid.columns + kGroupSide - 1) / kGroupSide,
                                                    (grid.rows + kGroupSide - 1) / kGroupSide });
            });
    targets.fogCells = buffers.cells;
}

} // namespace filament_core::passes
