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

/// `drawn`: the textures that the frame draws to.
Result<void> checkPostProcess(Engine::Impl& engine, View const& view, std::span<const backend::TextureHandle> drawn);

/// Gives checked passes to a frame.
void usePostProcess(Engine::Impl& engine, Arena& arena, View const& view, passes::FrameContext& context);

} // namespace filament_core::engine
