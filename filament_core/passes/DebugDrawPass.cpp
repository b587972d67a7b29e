// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DebugDrawPass.h"

#include <filament_core/Objects.h>

#include <cstddef>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using prepare::DebugVertex;
using prepare::DrawCall;

/// What surfaces hide, and what they do not.
std::span<const DrawCall> debugDraws(FrameContext const& context) {
    const uint32_t tested = context.debugDraw.quads.tested, all = context.debugDraw.quads.count();
    const auto geometries = context.arena->array<scene::Geometry>(2);
    const auto draws = context.arena->array<DrawCall>(2);
    size_t count = 0;
    const auto add = [&](scene::MaterialInstance const* material, uint32_t first, uint32_t end) {
        if (first == end) return;
        geometries[count] = quadGeometry(context.debugDraw.buffers, context.resources.debugLayout, first, end);
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
    // An enlarged image has no depth of its own size: nothing is hidden then.
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
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordQuads(pass, *of, chosen); });
}

FrameQuads uploadDebugQuads(QuadBuffers& buffers, CommandBuffer& commands, Arena& arena,
                            prepare::DebugQuads const& quads) {
    if (quads.count() == 0) return {};
    const FrameQuads on = buffers.next(commands, arena, quads.count());
    commands.record(CmdUpdateBuffer{ on.vertices, 0, std::as_bytes(quads.vertices) });
    return on;
}

} // namespace filament_core::passes
