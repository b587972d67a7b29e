// SPDX-License-Identifier: Apache-2.0
/// Passes of debug views that draw the scene's surfaces, each once more and without light.
///   addDebugSurfacePass  in the place of the colour pass: what the code of the materials gives, or how often it runs,
///                        in FrameTargets::color as shaders/material/surface/debug_main.glsl says. Draws, their order
///                        and their depth tests are those of the colour pass, so that their number is the frame's,
///                        unless effects of light make it draw a depth prepass; blending is not: the last surface
///                        counts, which is the nearest one that passes its test. Coverage has as many samples as the
///                        view, and transparent surfaces are blended. Numbers of triangles take a second pass, over
///                        the depths of the first.
///   addTrianglePass      beside it: which triangle each pixel shows, for its edges. Surfaces that blend hide as others
///                        do.
///   addNormalsPass       normals of opaque surfaces, for passes of the app.
///   Demand   prepare::showsMaterials() and showsEdges().
///   Thread   the app thread.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

void addDebugSurfacePass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);
/// FrameTargets::triangles; none: the device does not number them.
void addTrianglePass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

/// World space; w is 1 where there is a normal, less elsewhere. `size` pixels of half floats.
framegraph::TextureId addNormalsPass(framegraph::FrameGraph& graph, FrameContext const& context, uint2 size);

} // namespace filament_core::passes
