// SPDX-License-Identifier: Apache-2.0
/// Temporal anti-aliasing: colour accumulated over frames, each of which samples another place in its pixels.
///   Draws   targets.color: the accumulated colour, which the next frame finds as its history; targets.historyWeight
///           for DebugView::HistoryWeight.
///   How     Karis 2014, "High-Quality Temporal Supersampling": the history is looked up where it shows the same
///           surface, limited to the colours around the pixel, and mixed with the new colour by Accumulation::weight.
///   Size    that of the output, if no filter of Resolution::upscaling enlarges the image. Each pixel then accumulates
///           the samples that lie in it, weighted by their distances.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addTemporalPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// Whether the image is as large as the output afterwards, and was not before.
bool isUpscaledOverFrames(FrameContext const& context);

} // namespace filament_core::passes
