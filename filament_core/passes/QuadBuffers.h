// SPDX-License-Identifier: Apache-2.0
/// QuadBuffers: vertices and indices of quads that the CPU computes anew every frame.
///   Out     a draw of some of them: four vertices and two triangles a quad, in the order of the vertices.
///   Memory  three pairs of buffers, used in turn, so that no frame waits for the one before; they grow to the most
///           quads of a frame and stay. Nothing for frames without quads.
///   Thread  the app thread.   Fails: std::bad_alloc; what is recorded then fits what is remembered.
#pragma once

#include "backend/stream/CommandStream.h"
#include "base/Arena.h"
#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FrameContext.h"

#include <array>

namespace filament_core::passes {

inline constexpr uint32_t kIndicesOfQuad = 6, kCornersOfQuad = 4;

class QuadBuffers {
public:
    /// vertexBytes: of one vertex. name: of the buffers, in traces; a string that stays.
    QuadBuffers(backend::CommandStream& stream, uint32_t vertexBytes, const char* name)
            : mStream(stream), mVertexBytes(vertexBytes), mName(name) {}

    /// The next buffers in turn, with room for `quads` > 0. The indices are there; the vertices are the caller's.
    FrameQuads next(backend::CommandBuffer& commands, Arena& arena, uint32_t quads);
    void destroy(backend::CommandBuffer& commands);

private:
    struct Set {
        FrameQuads buffers{};
        uint32_t quads = 0;
    };
    void destroy(backend::CommandBuffer& commands, Set& set);
    void create(backend::CommandBuffer& commands, Arena& arena, Set& set, uint32_t quads);

    backend::CommandStream& mStream;
    uint32_t mVertexBytes;
    const char* mName;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
};

/// Quads first to end, as geometry of a draw.
scene::Geometry quadGeometry(FrameQuads const& quads, uint32_t layout, uint32_t first, uint32_t end);

/// Draws what chooseDraws() chose with the first view's uniforms.
void recordQuads(framegraph::PassContext& pass, FrameContext const& context, ChosenDraws const& chosen);

} // namespace filament_core::passes
