// SPDX-License-Identifier: Apache-2.0
/// Shadow pass: the shadow maps that changed, each into its tile of the atlas.
///   Draws   depths, reversed, of everything that casts; those faces of it that its material draws.
///   Skips   maps that an earlier frame has drawn; the whole pass if that is all of them.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/PipelineCache.h"

namespace filament_core::passes {

/// Where materials leave depth alone.
PassSlot shadowSlot(Quality const& quality, bool cutsSections, bool cutsSlabs);

/// Without shadow maps in the packet: nothing. Otherwise imports the atlas as targets.shadowDepths, with what filters
/// read of it as targets.shadows, and declares the pass if
/// there is a map to draw.
void addShadowPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
