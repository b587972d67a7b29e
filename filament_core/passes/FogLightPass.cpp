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

/// What the stage is specialised with: lights, shadows, and nothing else, which would make another pipeline of it.
auto constantsOf(FrameContext const& context) {
    constexpr size_t kQuality = shader::kQualityConstants.size(), kVariants = shader::kVariantConstants.size();
    std::array<ConstantValue, kQuality + kVariants> constants{};
    std::ranges::copy(shadingConstants(ofLights(context.shading)), constants.begin());
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

void bindGroups(PassContext& pass, FrameContext const& context, PassShadows const& shadows,
                framegraph::BufferId cells) {
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
    const std::array<BindGroupEntry, 1> written{
        { { .binding = shader::kBindingWrittenFogCells, .buffer = pass.buffer(cells), .size = fogCellBytes(context) } }
    };
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

void addFogLightPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::VolumetricFog)) return;
    const framegraph::BufferId cells = graph.createBuffer("fog cells", fogCellBytes(context));
    PassShadows shadows = declareShadows(context, targets.shadows);
    shadows.hasMoments = context.packet.shadows.moments != prepare::ShadowMoments::None;
    constexpr float4 kUnread(0);
    if (!shadows.maps) shadows.block = context.blocks->add(std::as_bytes(std::span(&kUnread, 1)));
    graph.addPass(
            "fog light",
            [&](framegraph::PassBuilder& pass) {
                if (shadows.maps) pass.readSampled(shadows.maps);
                pass.writeBuffer(cells, framegraph::BufferUse::Storage, framegraph::Previous::Overwrite);
            },
            [of = &context](PassContext& pass) { return pipelineOf(pass, *of); },
            [of = &context, shadows, cells](PassContext& pass, PipelineHandle pipeline) {
                const FogGrid grid = gridOf(*of);
                pass.commands().record(CmdBindPipeline{ pipeline });
                bindGroups(pass, *of, shadows, cells);
                pass.commands().record(CmdDispatch{ (grid.columns + kGroupSide - 1) / kGroupSide,
                                                    (grid.rows + kGroupSide - 1) / kGroupSide });
            });
    targets.fogCells = cells;
}

} // namespace filament_core::passes
