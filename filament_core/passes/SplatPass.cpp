// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SplatPass.h"

#include "backend/stream/RecordingGuards.h"
#include "filament_core/passes/ChosenDraws.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/prepare/PrepareSplats.h"

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
using framegraph::TextureId;
using prepare::DrawCall;
using prepare::SplatVertex;

constexpr uint32_t kIndicesOfSplat = 6, kCornersOfSplat = 4;
constexpr std::array<float, 4> kNoSplats{ 0, 0, 0, 0 };

constexpr std::string_view kLayerInputs[] = { "layer" };
constexpr FullScreenInterface kLayer{ .pass = "splat_layer", .inputs = kLayerInputs };

/// One draw of all splats of an encoding. The vertices of the second encoding follow those of the first.
std::span<const DrawCall> splatDraw(FrameContext const& context, size_t encoding) {
    auto const& lists = context.packet.splats.lists;
    const auto first = static_cast<uint32_t>(encoding == 0 ? 0 : lists[0].size());
    const auto geometry = context.arena->array<scene::Geometry>(1);
    const auto draw = context.arena->array<DrawCall>(1);
    geometry[0] = { .vertices = context.splats.vertices,
                    .indices = context.splats.indices,
                    .layout = context.resources.splatLayout,
                    .firstIndex = first * kIndicesOfSplat,
                    .indexCount = static_cast<uint32_t>(lists[encoding].size()) * kIndicesOfSplat,
                    .indexFormat = IndexFormat::UInt32 };
    draw[0] = { .material = context.resources.splats, .geometry = &geometry[0] };
    return draw;
}

void recordSplats(PassContext& pass, FrameContext const& context, ChosenDraws const& chosen) {
    const DrawContext draws{ viewOf(context, 0).group,
                             chosen.passGroups,
                             context.resources.instanceIds,
                             {},
                             context.settings().quality.textureFilter };
    recordDraws(pass.commands(), draws, chosen.draws, chosen.pipelines);
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
            [of = &context](PassContext& pass, ChosenDraws const& chosen) { recordSplats(pass, *of, chosen); });
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

void SplatBuffers::destroy(CommandBuffer& commands, Set& set) {
    set.splats = 0;
    for (BufferHandle* buffer : { &set.vertices, &set.indices })
        if (*buffer) mStream.destroy(commands, std::exchange(*buffer, {}));
}

void SplatBuffers::reserve(CommandBuffer& commands, Arena& arena, Set& set, uint32_t splats) {
    if (splats <= set.splats) return;
    const uint32_t grown = std::max({ splats, set.splats + set.splats / 2, 1024u });
    destroy(commands, set);
    const auto indices = arena.arrayForOverwrite<uint32_t>(size_t{ grown } * kIndicesOfSplat);
    for (uint32_t splat = 0; splat < grown; ++splat) {
        constexpr std::array<uint32_t, kIndicesOfSplat> kCorners{ 0, 1, 2, 0, 2, 3 };
        for (uint32_t i = 0; i < kIndicesOfSplat; ++i)
            indices[splat * kIndicesOfSplat + i] = kCornersOfSplat * splat + kCorners[i];
    }
    const auto create = [&](BufferHandle& made, uint64_t bytes, BufferUsage usage, const char* name) {
        NewHandle handle(mStream, mStream.allocateBuffer());
        commands.record(CmdCreateBuffer{ handle, { bytes, usage, name } });
        made = handle.keep();
    };
    create(set.vertices, uint64_t{ grown } * kCornersOfSplat * sizeof(SplatVertex), BufferUsage::Vertex, "splats");
    create(set.indices, indices.size_bytes(), BufferUsage::Index, "splat indices");
    commands.record(CmdUpdateBuffer{ set.indices, 0, std::as_bytes(indices) });
    set.splats = grown;
}

FrameSplats SplatBuffers::upload(jobs::JobSystem& jobs, CommandBuffer& commands, Arena& arena,
                                 prepare::SplatPacket const& splats) {
    const uint32_t count = splats.count();
    if (count == 0) return {};
    mCurrent = (mCurrent + 1) % static_cast<uint32_t>(mSets.size());
    Set& set = mSets[mCurrent];
    reserve(commands, arena, set, count);
    const std::span<std::byte> memory =
            commands.allocate(size_t{ count } * kCornersOfSplat * sizeof(SplatVertex), jobs::kCacheLineBytes);
    std::span vertices(reinterpret_cast<SplatVertex*>(memory.data()), size_t{ count } * kCornersOfSplat);
    for (prepare::SplatList const& list : splats.lists) {
        prepare::writeSplatVertices(jobs, list, vertices.first(list.size() * kCornersOfSplat));
        vertices = vertices.subspan(list.size() * kCornersOfSplat);
    }
    commands.recordAdopted(CmdUpdateBuffer{ set.vertices, 0, memory });
    return { set.vertices, set.indices };
}

void SplatBuffers::destroy(CommandBuffer& commands) {
    for (Set& set : mSets) destroy(commands, set);
}

} // namespace filament_core::passes
