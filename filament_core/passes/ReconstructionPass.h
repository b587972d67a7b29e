// SPDX-License-Identifier: Apache-2.0
/// Subpixel reconstruction anti-aliasing (Chajdas, McGuire and Luebke 2011): edges of opaque surfaces have the coverage
/// of five depths a pixel, while each pixel is shaded once.
///   Draws   the depths of opaque objects once more, with 2 x 2 texels a pixel; from these and the depth prepass the
///           plane of the surface in the middle of each pixel; then targets.color, where each depth has the colour of
///           the pixel whose plane it lies on. Transparent objects and the background are part of these colours.
///   Where   FramePacket::covered; the colours beside it are copied.
///   Why     more than one sample a pixel makes drivers of CPUs shade hidden surfaces as well (bench/README.md).
///   Skips   all of it, unless the frame needs Effect::Sraa.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// After the colour pass.
void addReconstructionPasses(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
