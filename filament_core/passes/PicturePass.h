// SPDX-License-Identifier: Apache-2.0
/// Picture passes: copy what is drawn so far, for what refracts it or for what reflects it in the next frame, and blur
/// the copy, level by level.
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

/// Before the colour pass, if something reflects the picture: targets.lastPicture, all of the last frame's, empty if
/// there was none.
void declareLastPicture(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// After it: the same of this frame.
void addLastPicturePasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// All of the view.
prepare::PictureCopy wholePicture(FrameContext const& context);

} // namespace filament::passes
