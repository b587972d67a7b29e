// SPDX-License-Identifier: Apache-2.0
/// Scene colour copies: of what is drawn so far, for refractive objects, or of the whole image, for what reflects it in
/// the next frame, which reprojects it; blurred level by level.
///   Reads   targets.color, and a depth of one sample a pixel.
///   Draws   rgb: pre-exposed light, a: 1 / distance along the view in 1/m, 0 for background. What lies outside of
///           the rectangle is 0.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// The rectangle and the levels of `copy`.
framegraph::TextureId addSceneColorCopyPasses(framegraph::FrameGraph& graph, FrameContext const& context,
                                              framegraph::TextureId color, framegraph::TextureId depth,
                                              prepare::SceneColorCopy const& copy);

/// Before the colour pass, if something reflects the image: targets.sceneColor is that of the last frame, as this frame
/// sees its surfaces. The product of its alpha and the distance is 1 where the last frame showed the same surface.
/// None, if there was no last frame.
void addReflectedSceneColor(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// After it: leaves this frame's `color` to the next one.
void keepSceneColor(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets,
                    framegraph::TextureId color);
/// All of the view.
prepare::SceneColorCopy wholeSceneColor(FrameContext const& context);

} // namespace filament_core::passes
