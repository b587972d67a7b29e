// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ChosenDraws.h"

namespace filament_core::passes {

ChosenDraws chooseDraws(framegraph::PassContext& pass, FrameContext const& context, PassSlot const& slot,
                        PassBlock target, std::span<const prepare::DrawCall> draws) {
    PipelineSource const& pipelines = context.resources.pipelines;
    return { surfaceGroups(pass, context, target), draws,
             choosePipelines(pass, *context.arena, pipelines, pipelines.slot(slot), draws, 0) };
}

DrawContext shadedDraws(FrameContext const& context,
                        std::array<backend::BindGroupHandle, shader::kSurfaceKinds> const& passGroups) {
    const FrameView view = viewOf(context, 0);
    return { view.group,
             passGroups,
             context.resources.instanceIds,
             context.deformations,
             context.settings().quality.textureFilter,
             view.packet.channels,
             !context.packet.grids.empty() };
}

} // namespace filament_core::passes
