// SPDX-License-Identifier: Apache-2.0
/// PostProcess: View::postProcess as passes of a frame, and the check that they can be drawn.
///   In      the passes of a view.   Out: what addAppPasses() draws, in the frame arena.
///   Thread  the app thread.
///   Memory  the arena; samplers, as instances make them.
///   Fails   checkPostProcess(): one line that names the material, the reason and the cure. std::bad_alloc.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/passes/AppPass.h"

#include <filament_core/View.h>

namespace filament_core::engine {

/// None in views that show something else than their image.
std::span<const PostProcessPass> postProcessOf(View const& view);

/// What passes draw to.
struct PassTargets {
    std::span<const backend::TextureHandle> drawn; ///< all textures that the frame draws to
    bool isAlone = false;                          ///< without a view, whose picture they could read
    size_t colors = 1;                             ///< attachments
};

Result<void> checkPostProcess(Engine::Impl& engine, View const& view, PassTargets const& to);

/// Of a pass without a view: what it sees of one. Refers to `pass`.
View viewOfPass(PostProcessPass const& pass, View const& view, uint2 size);

/// Gives checked passes to a frame.
void usePostProcess(Engine::Impl& engine, Arena& arena, View const& view, passes::FrameContext& context);

} // namespace filament_core::engine
