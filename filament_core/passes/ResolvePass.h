// SPDX-License-Identifier: Apache-2.0
/// Resolve pass: the samples of a pixel become its colour, weighted so that what is displayed is nearly the mean of
/// what each sample alone would display (Quality::msaaResolve).
///   Reads   the colour pass's samples, one by one. NaN and infinite light stay in their pixel.
///   Draws   targets.color.
///   Skips   the pass, unless the frame needs Effect::MsaaResolve: the device then averages light, as it also does for
///           the copies of the scene colour that are refracted.
#pragma once

#include "filament_core/passes/FrameContext.h"

namespace filament_core::passes {

/// The light that is displayed at half of white, before the grading, which scales it. What auto exposure will make of
/// it is not known yet.
float halfWhiteOf(FrameContext const& context);

/// `samples` has the size of `color`, which every pixel is written of.
void addResolvePass(framegraph::FrameGraph& graph, FrameContext const& context, framegraph::TextureId samples,
                    framegraph::TextureId color);

} // namespace filament_core::passes
