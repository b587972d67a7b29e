// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/QuadBuffers.h"

#include "backend/stream/RecordingGuards.h"

#include <algorithm>
#include <utility>

namespace filament_core::passes {

using namespace backend;

namespace {

std::span<const uint32_t> quadIndices(Arena& arena, uint32_t quads) {
    constexpr std::array<uint32_t, kIndicesOfQuad> kCorners{ 0, 1, 2, 0, 2, 3 };
    const auto indices = arena.arrayForOverwrite<uint32_t>(size_t{ quads } * kIndicesOfQuad);
    for (uint32_t quad = 0; quad < quads; ++quad) {
        for (uint32_t i = 0; i < kIndicesOfQuad; ++i)
            indices[size_t{ quad } * kIndicesOfQuad + i] = kCornersOfQuad * quad + kCorners[i];
    }
    return indices;
}

} // namespace

void QuadBuffers::destroy(CommandBuffer& commands, Set& set) {
    set.quads = 0;
    for (BufferHandle* buffer : { &set.buffers.vertices, &set.buffers.indices })
        if (*buffer) mStream.destroy(commands, std::exchange(*buffer, {}));
}

void QuadBuffers::create(CommandBuffer& commands, Arena& arena, Set& set, uint32_t quads) {
    const std::span<const uint32_t> indices = quadIndices(arena, quads);
    const auto create = [&](BufferHandle& made, uint64_t bytes, BufferUsage usage) {
        NewHandle handle(mStream, mStream.allocateBuffer());
        commands.record(CmdCreateBuffer{ handle, { bytes, usage, mName } });
        made = handle.keep();
    };
    create(set.buffers.vertices, uint64_t{ quads } * kCornersOfQuad * mVertexBytes, BufferUsage::Vertex);
    create(set.buffers.indices, indices.size_bytes(), BufferUsage::Index);
    commands.record(CmdUpdateBuffer{ set.buffers.indices, 0, std::as_bytes(indices) });
    set.quads = quads;
}

FrameQuads QuadBuffers::next(CommandBuffer& commands, Arena& arena, uint32_t quads) {
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    Set& set = mSets[mCurrent];
    if (quads > set.quads) {
        const uint32_t grown = std::max({ quads, set.quads + set.quads / 2, 64u });
        destroy(commands, set);
        create(commands, arena, set, grown);
    }
    return set.buffers;
}

void QuadBuffers::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) destroy(commands, set);
}

scene::Geometry quadGeometry(FrameQuads const& quads, uint32_t layout, uint32_t first, uint32_t end) {
    return { .vertices = quads.vertices,
             .indices = quads.indices,
             .layout = layout,
             .firstIndex = first * kIndicesOfQuad,
             .indexCount = (end - first) * kIndicesOfQuad,
             .indexFormat = IndexFormat::UInt32 };
}

void recordQuads(framegraph::PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const DrawContext draws{ viewOf(context, 0).group,
                             chosen.passGroups,
                             context.resources.instanceIds,
                             {},
                             context.settings().quality.textureFilter };
    recordDraws(pass.commands(), draws, chosen.draws, chosen.pipelines);
}

} // namespace filament_core::passes
