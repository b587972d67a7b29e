// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DebugDrawPass.h"

#include "backend/stream/RecordingGuards.h"
#include "filament_core/passes/ChosenDraws.h"

#include <filament_core/Objects.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using prepare::DebugVertex;
using prepare::DrawCall;

constexpr uint32_t kIndicesOfQuad = 6;

/// What surfaces hide, and what they do not.
std::span<const DrawCall> debugDraws(FrameContext const& context) {
    const uint32_t tested = context.debugDraw.quads.tested, all = context.debugDraw.quads.count();
    const auto geometries = context.arena->array<scene::Geometry>(2);
    const auto draws = context.arena->array<DrawCall>(2);
    size_t count = 0;
    const auto add = [&](scene::MaterialInstance const* material, uint32_t first, uint32_t end) {
        if (first == end) return;
        geometries[count] = { .vertices = context.debugDraw.buffers.vertices,
                              .indices = context.debugDraw.buffers.indices,
                              .layout = context.resources.debugLayout,
                              .firstIndex = first * kIndicesOfQuad,
                              .indexCount = (end - first) * kIndicesOfQuad,
                              .indexFormat = backend::IndexFormat::UInt32 };
        draws[count] = { .material = material, .geometry = &geometries[count] };
        ++count;
    };
    add(context.resources.debugTested, 0, tested);
    add(context.resources.debugThrough, tested, all);
    return draws.first(count);
}

PassSlot debugSlot(PassContext& pass, DepthRange range) {
    return { .layout = pass.passLayout(), .subpass = pass.subpass(), .depthRange = range };
}

void recordDebugDraw(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const FrameView view = viewOf(context, 0);
    const DrawContext draws{
        view.group, chosen.passGroups, context.resources.instanceIds, {}, context.settings().quality.textureFilter
    };
    recordDraws(pass.commands(), draws, chosen.draws, chosen.pipelines);
}

} // namespace

scene::GeometryLayout debugDrawLayout() {
    scene::GeometryLayout layout;
    layout.vertices.attributes[0] = { static_cast<uint8_t>(Attribute::Position), 0, VertexFormat::Float3,
                                      offsetof(DebugVertex, position) };
    layout.vertices.attributes[1] = { static_cast<uint8_t>(Attribute::Color), 0, VertexFormat::Float4,
                                      offsetof(DebugVertex, color) };
    layout.vertices.attributeCount = 2;
    layout.vertices.buffers[0].stride = sizeof(DebugVertex);
    layout.vertices.bufferCount = 1;
    return layout;
}

void addDebugDrawPass(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets) {
    if (context.debugDraw.quads.count() == 0) return;
    const PassBlock target = declareTarget(context, graph.texture(targets.output).desc);
    // An enlarged picture has no depth of its own size: nothing is hidden then.
    const bool isTested =
            context.debugDraw.quads.tested > 0 && sizeOf(graph, targets.sceneDepth) == sizeOf(graph, targets.output);
    graph.addPass(
            "debug draw",
            [&](PassBuilder& pass) {
                pass.writeColor(0, targets.output);
                if (isTested) pass.testDepth(targets.sceneDepth);
            },
            [of = &context, target](PassContext& pass) {
                return chooseDraws(pass, *of, debugSlot(pass, of->settings().quality.depthRange), target,
                                   debugDraws(*of));
            },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordDebugDraw(pass, *of, chosen); });
}

void DebugBuffers::destroy(CommandBuffer& commands, Set& set) {
    set.quads = 0;
    for (BufferHandle* buffer : { &set.vertices, &set.indices })
        if (*buffer) mStream.destroy(commands, std::exchange(*buffer, {}));
}

void DebugBuffers::reserve(CommandBuffer& commands, Arena& arena, Set& set, uint32_t quads) {
    if (quads <= set.quads) return;
    const uint32_t grown = std::max({ quads, 2 * set.quads, 64u });
    destroy(commands, set);
    const auto indices = arena.arrayForOverwrite<uint32_t>(size_t{ grown } * kIndicesOfQuad);
    for (uint32_t quad = 0; quad < grown; ++quad) {
        constexpr std::array<uint32_t, kIndicesOfQuad> kCorners{ 0, 1, 2, 0, 2, 3 };
        for (uint32_t i = 0; i < kIndicesOfQuad; ++i) indices[quad * kIndicesOfQuad + i] = 4 * quad + kCorners[i];
    }
    const auto create = [&](BufferHandle& made, uint64_t bytes, BufferUsage usage, const char* name) {
        NewHandle handle(mStream, mStream.allocateBuffer());
        commands.record(CmdCreateBuffer{ handle, { bytes, usage, name } });
        made = handle.keep();
    };
    create(set.vertices, uint64_t{ grown } * 4 * sizeof(DebugVertex), BufferUsage::Vertex, "debug draw");
    create(set.indices, indices.size_bytes(), BufferUsage::Index, "debug draw");
    commands.record(CmdUpdateBuffer{ set.indices, 0, std::as_bytes(indices) });
    set.quads = grown;
}

DebugDrawBuffers DebugBuffers::upload(CommandBuffer& commands, Arena& arena, prepare::DebugQuads const& quads) {
    if (quads.count() == 0) return {};
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    Set& set = mSets[mCurrent];
    reserve(commands, arena, set, quads.count());
    commands.record(CmdUpdateBuffer{ set.vertices, 0, std::as_bytes(quads.vertices) });
    return { set.vertices, set.indices };
}

void DebugBuffers::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) destroy(commands, set);
}

} // namespace filament_core::passes
