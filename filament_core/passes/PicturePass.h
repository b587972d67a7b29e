// SPDX-License-Identifier: Apache-2.0
/// Picture passes: copy what is drawn so far, for what refracts it, or the whole picture, for what reflects it in the
/// next frame, which brings it to where it shows the same things; and blur the copy, level by level.
///   Reads   targets.color, and a depth of one sample a pixel.
///   Draws   rgb: pre-exposed light, a: 1 / distance along the view in 1/m, 0 where nothing is. What lies outside of
///           the rectangle is 0.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament::passes {

/// The rectangle and the levels of `copy`.
framegraph::TextureId addPicturePasses(framegraph::FrameGraph& graph, FrameContext const& context,
                                       framegraph::TextureId color, framegraph::TextureId depth,
                                       prepare::PictureCopy const& copy);

/// Before the colour pass, if something reflects the picture: targets.picture is that of the last frame, as this frame
/// sees its surfaces. The product of its alpha and the distance is 1 where the last frame showed the same surface.
/// None, if there was no last frame.
void addReflectedPicture(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// After it: leaves this frame's picture, `color`, to the next one.
void keepPicture(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets,
                 framegraph::TextureId color);
/// All of the view.
prepare::PictureCopy wholePicture(FrameContext const& context);

} // namespace filament::passes
