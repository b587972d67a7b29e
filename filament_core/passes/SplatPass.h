// SPDX-License-Identifier: Apache-2.0
/// Splats over the scene colour (<filament_core/Splats.h>). Those of one encoding of colours blend by themselves, as
/// they are encoded; the result is decoded and drawn over the picture: specification of KHR_gaussian_splatting, "Color
/// Space". ColorPass calls this between opaque and transparent objects.
///   In      FramePacket::splats: nothing runs for an encoding without any.
///   Bits    quads are computed by the CPU; the device interpolates and blends.
///   Memory  SplatBuffers: three pairs of buffers, used in turn; they grow to the most splats of a frame and stay.
///   Thread  the app thread, and the workers for vertices.   Fails: std::bad_alloc; what is recorded then fits what is
///           remembered.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/FrameContext.h"
#include "jobsystem/JobSystem.h"

#include <array>

namespace filament_core::passes {

class SplatBuffers {
public:
    explicit SplatBuffers(backend::CommandStream& stream) : mStream(stream) {}

    /// Nothing for a frame without splats.
    FrameSplats upload(jobs::JobSystem& jobs, backend::CommandBuffer& commands, Arena& arena,
                       prepare::SplatPacket const& splats);
    void destroy(backend::CommandBuffer& commands);

private:
    struct Set {
        backend::BufferHandle vertices, indices;
        uint32_t splats = 0;
    };
    void reserve(backend::CommandBuffer& commands, Arena& arena, Set& set, uint32_t splats);
    void destroy(backend::CommandBuffer& commands, Set& set);

    backend::CommandStream& mStream;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
};

/// As the pipelines of splats see them.
scene::GeometryLayout splatLayout();

/// What is drawn so far.
struct SplatTargets {
    framegraph::TextureId color;   ///< the picture, one sample a pixel
    framegraph::TextureId samples; ///< what is drawn to; `color` itself, if the view has one sample a pixel
    framegraph::TextureId depth;   ///< with one sample a pixel
};

void addSplatPasses(framegraph::FrameGraph& graph, FrameContext const& context, SplatTargets const& targets);

} // namespace filament_core::passes
