// SPDX-License-Identifier: Apache-2.0
/// addDebugEffectPass: debug views in the place of the tone mapper: those of effects of the image (circles of
/// confusion, the weight of the history, the histogram of auto exposure), of the image's numbers, and of what
/// DebugSurfacePass.h has drawn.
///   Reads   what these have put into FrameTargets. Nothing, where they do not run: black, or the image alone.
///   Draws   targets.output: what a display shows, or that as light, if `isSceneLinear`.
///   Thread  the app thread.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addDebugEffectPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets,
                        bool isSceneLinear);

} // namespace filament_core::passes
