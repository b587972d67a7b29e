// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SplatPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/prepare/PrepareSplats.h"

#include <filament_core/Objects.h>

#include <cstddef>

namespace filament_core::passes {
namespace {

using namespace backend;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::TextureId;
using prepare::DrawCall;
using prepare::SplatVertex;

constexpr std::array<float, 4> kNoSplats{ 0, 0, 0, 0 };

constexpr std::string_view kLayerInputs[] = { "layer" };
constexpr FullScreenInterface kLayer{ .pass = "splat_layer", .inputs = kLayerInputs };

/// One draw of all splats of an encoding. The vertices of the second encoding follow those of the first.
std::span<const DrawCall> splatDraw(FrameContext const& context, size_t encoding) {
    auto const& lists = context.packet.splats.lists;
    const auto first = static_cast<uint32_t>(encoding == 0 ? 0 : lists[0].size());
    const auto geometry = context.arena->array<scene::Geometry>(1);
    const auto draw = context.arena->array<DrawCall>(1);
    geometry[0] = quadGeometry(context.splats, context.resources.splatLayout, first,
                               first + static_cast<uint32_t>(lists[encoding].size()));
    draw[0] = { .material = context.resources.splats, .geometry = &geometry[0] };
    return draw;
}

TextureId addLayer(FrameGraph& graph, FrameContext const& context, SplatTargets const& targets, size_t encoding) {
    const TextureId layer = createLike(graph, targets.color, Format::RGBA16F, 1, "splats");
    const PassBlock target = declareTarget(context, graph.texture(layer).desc);
    graph.addPass(
            "splats",
            [&](PassBuilder& pass) {
                pass.writeColor(0, layer, { .clear = kNoSplats });
                pass.testDepth(targets.depth);
            },
            [of = &context, target, encoding](PassContext& pass) {
                const PassSlot slot{ .layout = pass.passLayout(),
                                     .subpass = pass.subpass(),
                                     .depthRange = of->settings().quality.depthRange };
                return chooseDraws(pass, *of, slot, target, splatDraw(*of, encoding));
            },
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordQuads(pass, *of, chosen); });
    return layer;
}

} // namespace

scene::GeometryLayout splatLayout() {
    scene::GeometryLayout layout;
    layout.vertices.attributes[0] = { static_cast<uint8_t>(Attribute::Position), 0, VertexFormat::Float3,
                                      offsetof(SplatVertex, position) };
    layout.vertices.attributes[1] = { static_cast<uint8_t>(Attribute::Color), 0, VertexFormat::Half4,
                                      offsetof(SplatVertex, color) };
    layout.vertices.attributes[2] = { static_cast<uint8_t>(Attribute::Uv0), 0, VertexFormat::Half2,
                                      offsetof(SplatVertex, at) };
    layout.vertices.attributeCount = 3;
    layout.vertices.buffers[0].stride = sizeof(SplatVertex);
    layout.vertices.bufferCount = 1;
    return layout;
}

void addSplatPasses(FrameGraph& graph, FrameContext const& context, SplatTargets const& targets) {
    // Colours are blended in the encoding in which they were trained, which the target does not have. So each encoding
    // has a layer, which is decoded when it is composed.
    for (size_t encoding = 0; encoding < context.packet.splats.lists.size(); ++encoding) {
        if (context.packet.splats.lists[encoding].empty()) continue;
        const TextureId layer = addLayer(graph, context, targets, encoding);
        const EffectConstant constants[] = { { "isEncoded", static_cast<SplatColors>(encoding) == SplatColors::Srgb } };
        const std::array inputs{ FullScreenInput{ .name = "layer", .texture = layer } };
        addFullScreenPass(graph, context,
                          { .name = "splat layer",
                            .material = context.resources.effects->get("splat_layer", constants, kLayer),
                            .inputs = inputs,
                            .target = targets.samples,
                            .resolve = targets.samples == targets.color ? TextureId{} : targets.color });
    }
}

FrameQuads uploadSplats(QuadBuffers& buffers, jobs::JobSystem& jobs, CommandBuffer& commands, Arena& arena,
                        prepare::SplatPacket const& splats) {
    const uint32_t count = splats.count();
    if (count == 0) return {};
    const FrameQuads on = buffers.next(commands, arena, count);
    const std::span<std::byte> memory =
            commands.allocate(size_t{ count } * kCornersOfQuad * sizeof(SplatVertex), jobs::kCacheLineBytes);
    std::span vertices(reinterpret_cast<SplatVertex*>(memory.data()), size_t{ count } * kCornersOfQuad);
    for (prepare::SplatList const& list : splats.lists) {
        prepare::writeSplatVertices(jobs, list, vertices.first(list.size() * kCornersOfQuad));
        vertices = vertices.subspan(list.size() * kCornersOfQuad);
    }
    commands.recordAdopted(CmdUpdateBuffer{ on.vertices, 0, memory });
    return on;
}

} // namespace filament_core::passes
