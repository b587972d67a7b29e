// SPDX-License-Identifier: Apache-2.0
/// Motion blur passes: what moves while the shutter is open is blurred along its way.
///   Draws   targets.color: the scene colour with blur. Half of the way of each pixel, from the depths, the motion of
///           the camera and targets.motionVectors; the longest way in tiles as wide as blur reaches, and around them;
///           then the mean along it.
///   Skips   all of it, unless the frame's demand needs it: without a camera or a surface that moved since the last
///           frame there is nothing to blur.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addMotionBlurPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
