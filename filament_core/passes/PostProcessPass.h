// SPDX-License-Identifier: Apache-2.0
/// Post-processing: the last passes of an image, from scene-linear light to what the output stores.
///   What    fringes of the lens, vignette, grading, tone mapper, grain and dither in one pass; after it FXAA (Lottes
///           2009), an upscaler and sharpening (ResolutionPass.h); the last one has the grain and the dither. A view
///           that asks for a tone mapper alone gets a pass without the rest.
///   Reads   targets.color, at the pixel that it writes alone, so that it can be a subpass of the colour pass; where
///           the graph cannot merge it (MSAA, a device without subpass inputs) it samples instead. Same arithmetic,
///           same bits.
///   Draws   targets.output: display values by the view's tone mapper; light itself, if `isSceneLinear`.
///           Passes of the app come between the tone mapper and what follows it, and after all of them.
///   Skips   what an output of light has already been drawn to.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addPostProcessPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets,
                          bool isSceneLinear);

} // namespace filament_core::passes
