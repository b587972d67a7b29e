// SPDX-License-Identifier: Apache-2.0
/// recordFullScreen(): one triangle over the whole target, for each of the material's bind groups.
///   Thread  that of the command buffer.   Fails: std::bad_alloc.
#pragma once

#include "backend/stream/CommandBuffer.h"
#include "filament_core/passes/FrameData.h"
#include "shaders/interface/ShaderInterface.h"

#include <span>

namespace filament_core::passes {

/// `pass`: the Pass bind group. `materials`: one draw each; none: the material has no group, and is drawn once.
inline void recordFullScreen(backend::CommandBuffer& commands, backend::PipelineHandle pipeline, ViewGroup const& view,
                             backend::BindGroupHandle pass, std::span<const backend::BindGroupHandle> materials = {}) {
    commands.record(backend::CmdBindPipeline{ pipeline });
    commands.record(view.bind(0));
    commands.record(backend::CmdBindGroup{ pass, shader::kGroupPass });
    if (materials.empty()) commands.record(backend::CmdDraw{ 3 });
    for (const backend::BindGroupHandle material : materials) {
        commands.record(backend::CmdBindGroup{ material, shader::kGroupMaterial });
        commands.record(backend::CmdDraw{ 3 });
    }
}

} // namespace filament_core::passes
