// SPDX-License-Identifier: Apache-2.0
/// The rectangles of View::debugDraw (prepare/DebugQuads.h), over the output: first those that surfaces hide,
/// by the depth of the view, then the others.
///   Skips   views without any.
///   Memory  DebugBuffers: three pairs of buffers, used in turn; they grow to the most rectangles of a frame and stay.
///   Thread  the app thread.   Fails: std::bad_alloc; what is recorded then fits what is remembered.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

#include <array>

namespace filament_core::passes {

class DebugBuffers {
public:
    explicit DebugBuffers(backend::CommandStream& stream) : mStream(stream) {}

    /// Nothing for a frame without rectangles.
    DebugDrawBuffers upload(backend::CommandBuffer& commands, Arena& arena, prepare::DebugQuads const& quads);
    void destroy(backend::CommandBuffer& commands);

private:
    struct Set {
        backend::BufferHandle vertices, indices;
        uint32_t quads = 0;
    };
    void reserve(backend::CommandBuffer& commands, Arena& arena, Set& set, uint32_t quads);
    void destroy(backend::CommandBuffer& commands, Set& set);

    backend::CommandStream& mStream;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
};

/// As the pipelines of these rectangles see them.
scene::GeometryLayout debugDrawLayout();

void addDebugDrawPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets);

} // namespace filament_core::passes
