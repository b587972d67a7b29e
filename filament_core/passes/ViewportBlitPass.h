// SPDX-License-Identifier: Apache-2.0
/// The last pass of a view that is a part of its target, or is drawn over what is there: puts the output into
/// its place.
///   Why     all passes before it know only the view's own size, so that every effect is the same inside of a viewport
///           as in a target of that size, to the bit.
///   Skips   views that fill their target: they draw to it themselves.
#pragma once

#include "filament_core/passes/Frame.h"

namespace filament_core::passes {

/// Imports what the user asked for. `isKept`: it is drawn over what the texture holds.
framegraph::TextureId importOutput(framegraph::FrameGraph& graph, FrameOutput const& output, bool isKept);

/// Imports it, and makes the image of the view if it has a place of its own.
void beginViewportBlit(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                       FrameTargets& targets);
void addViewportBlitPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                         FrameTargets const& targets);

/// targets.color without the band of Effects::guardBand around it. What comes later works on the image alone.
void addGuardBandCutPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

/// What a render target asks for of depth: FrameTargets::sceneDepth as linear depth, in its place.
void addTargetDepth(framegraph::FrameGraph& graph, FrameContext const& context, FrameOutput const& output,
                    FrameTargets const& targets);

} // namespace filament_core::passes
