// SPDX-License-Identifier: Apache-2.0
/// Ambient occlusion from the depths of the image (docs/ambient-occlusion.md).
///   Draws   targets.ambientOcclusion, of the view's size: what samples or horizons hide at all pixels, half of them
///           or a quarter; then, as Quality says, a blur along each axis, and the step up to all pixels.
///   Reads   targets.prepassDepth.
///   Where   FramePacket::covered; beside it nothing is hidden, and the passes only clear.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addAmbientOcclusionPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
