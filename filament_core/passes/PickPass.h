// SPDX-License-Identifier: Apache-2.0
/// addPickPass: draws one pixel of each candidate of a pick (PreparePick.h) into a texel of its own, so that none hides
/// another, and their depths tell them apart: no program needs to write who it is.
///   Draws   draw i of the packet's view into texel i of `depths`, kPickSide texels a side: by its depth variant;
///           transparent objects by that of the engine's material for motion, as a solid surface.
///   Exact   the viewport is that of the view, moved by whole pixels, so that a texel is covered just where the pixel
///           is.
///   Limits  a transparent object with a vertex block is picked where it would be without it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/PipelineCache.h"

namespace filament_core::passes {

inline constexpr uint32_t kPickSide = 64;

/// `size`: pixels of the view.
void addPickPass(framegraph::FrameGraph& graph, FrameContext const& context, framegraph::TextureId depths, uint2 size,
                 uint2 pixel);

} // namespace filament_core::passes
