// SPDX-License-Identifier: Apache-2.0
/// Depth of field: what the lens of the camera does not focus is blurred.
///   Draws   targets.color: the scene colour with it.
///   How     the scene colour at half size with the radius of blur of each texel; the largest radius of each tile; each
///           texel gathers those whose discs reach it, and only as many as its tile needs; then each pixel is mixed.
///   Skips   all of it, unless the frame's demand needs it; the gathering, in tiles that are sharp.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addDepthOfFieldPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
