// SPDX-License-Identifier: Apache-2.0
/// Splats over the scene colour (<filament_core/Splats.h>). Those of one encoding of colours blend by themselves, as
/// they are encoded; the result is decoded and drawn over the scene colour: specification of KHR_gaussian_splatting,
/// "Color Space". ColorPass calls this between opaque and transparent objects.
///   In      FramePacket::splats: nothing runs for an encoding without any.
///   Bits    quads are computed by the CPU; the device interpolates and blends.
///   Memory  that of QuadBuffers.   Thread: the app thread, and the workers for vertices.   Fails: std::bad_alloc.
#pragma once

#include "filament_core/passes/QuadBuffers.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::passes {

/// Writes the vertices of a frame's splats to the device; `buffers` are made for SplatVertex. Nothing without splats.
FrameQuads uploadSplats(QuadBuffers& buffers, jobs::JobSystem& jobs, backend::CommandBuffer& commands, Arena& arena,
                        prepare::SplatPacket const& splats);

/// As the pipelines of splats see them.
scene::GeometryLayout splatLayout();

/// What is drawn so far.
struct SplatTargets {
    framegraph::TextureId color;   ///< the scene colour, one sample a pixel
    framegraph::TextureId samples; ///< what is drawn to; `color` itself, if the view has one sample a pixel
    framegraph::TextureId depth;   ///< with one sample a pixel
};

void addSplatPasses(framegraph::FrameGraph& graph, FrameContext const& context, SplatTargets const& targets);

} // namespace filament_core::passes
