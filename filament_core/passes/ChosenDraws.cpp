// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ChosenDraws.h"

#include <algorithm>

namespace filament_core::passes {

ChosenDraws chooseDraws(framegraph::PassContext& pass, FrameContext const& context, PassSlot const& slot,
                        PassBlock target, std::span<const prepare::DrawCall> draws) {
    PipelineSource const& pipelines = context.resources.pipelines;
    return { surfaceGroups(pass, context, target), draws,
             choosePipelines(pass, *context.arena, pipelines, pipelines.slot(slot), draws, 0) };
}

std::span<const prepare::DrawCall> opaqueWithoutFade(FrameContext const& context) {
    using prepare::DrawCall;
    prepare::ViewPacket const& view = context.packet.mainView();
    if (view.counts.fadingLevels == 0) return view.opaque;
    const std::span<DrawCall> draws = context.arena->copy(view.opaque);
    const auto end = std::remove_if(draws.begin(), draws.end(), [](DrawCall const& draw) { return draw.fade < 0; });
    const auto drawn = draws.first(static_cast<size_t>(end - draws.begin()));
    for (DrawCall& draw : drawn) draw.fade = 0;
    return drawn;
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
