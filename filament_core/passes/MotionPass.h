// SPDX-License-Identifier: Apache-2.0
/// Motion pass: motion vectors of dynamic objects, for temporal effects.
///   Draws   targets.motionVectors: rg: from here to there, as shares of the image's width and height; b: its distance
///           along the view then, over that of now; a: 1. All 0 where nothing moved by itself: the motion of the
///           camera tells the rest.
///   How     the surfaces of the prepass again, over its depths, so that whatever cut holes there does so here.
///           Materials that place their vertices are drawn by their variants with kVariantMotion, all others by the
///           engine's material `motion`: what a surface is made of does not matter.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addMotionPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
