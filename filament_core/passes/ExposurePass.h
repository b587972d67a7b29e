// SPDX-License-Identifier: Apache-2.0
/// Auto exposure: how bright the image is, and the exposure that follows from it.
///   Reads   targets.color, at one pixel of each block of the image.
///   Draws   targets.histogram, and targets.exposure: one texel: the correction in stops. The next frame finds it as
///           its history.
///   How     a histogram of the logarithm of luminance, of which the darkest and the brightest shares do not count; the
///           mean of the rest becomes middle grey. The correction moves there by so many stops a second.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addExposurePasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
