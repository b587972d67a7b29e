// SPDX-License-Identifier: Apache-2.0
/// addDebugViewPass: View::debugView in the place of the tone mapper. One triangle over the image that reads the
/// frame's depths, lists of lights and shadow maps; what it shows is shaders/material/debug_view.mat.
///   Demand  SceneDemand's Effect::DebugView; without it the pass is not declared.
///   Depth   FrameTargets::depth, of one sample a pixel. Transparent objects leave none: what is behind it is shown.
///   Thread  the app thread.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addDebugViewPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets);

} // namespace filament_core::passes
