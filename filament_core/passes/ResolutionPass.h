// SPDX-License-Identifier: Apache-2.0
/// Resolution passes: an image of fewer pixels becomes as large as the output; contrast between neighbours is raised.
///   Reads   display values, or light if the output is light: it is compressed first, so that a lamp is not all there
///           is.
///   Draws   `target`; the last pass of a frame also the grain and the dither, whose pixels are those of the output.
///   How     Resolution::upscaling; Effects::sharpening. docs/resolution.md has the formulas.
///   Cost    sharpening is a pass of its own: five look-ups of what another pass has made cost less than making it five
///           times.
#pragma once

#include "filament_core/passes/FrameContext.h"

namespace filament_core::passes {

struct PictureStep {
    framegraph::TextureId picture, target;
};

/// What a pass does besides, as the last one of a frame.
struct LastStep {
    bool isSceneLinear = false; ///< the image is linear light
    bool hasGrain = false, dithers = false;
};

/// By a bilinear filter if Resolution::upscaling is off: nothing was accumulated where nothing is visible.
void addUpscalingPass(framegraph::FrameGraph& graph, FrameContext const& context, PictureStep const& step,
                      LastStep const& last);
void addSharpeningPass(framegraph::FrameGraph& graph, FrameContext const& context, PictureStep const& step,
                       LastStep const& last);

} // namespace filament_core::passes
