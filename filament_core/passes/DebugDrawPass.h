// SPDX-License-Identifier: Apache-2.0
/// The rectangles of View::debugDraw (prepare/DebugQuads.h), over the output: first those that surfaces hide,
/// by the depth of the view, then the others.
///   Skips   views without any.
///   Memory  that of QuadBuffers.   Thread: the app thread.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/QuadBuffers.h"

namespace filament_core::passes {

/// As the pipelines of these rectangles see them.
scene::GeometryLayout debugDrawLayout();

/// Puts the rectangles of a frame on the device; `buffers` are made for DebugVertex.
FrameQuads uploadDebugQuads(QuadBuffers& buffers, backend::CommandBuffer& commands, Arena& arena,
                            prepare::DebugQuads const& quads);

void addDebugDrawPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets);

} // namespace filament_core::passes
