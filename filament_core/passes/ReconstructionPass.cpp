// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ReconstructionPass.h"

#include "filament_core/passes/DepthPass.h"
#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/ResolvePass.h"

#include <array>

namespace filament_core::passes {
namespace {

using backend::Format;
using backend::Rect;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kPlaneInputs[] = { "depth", "depths" };
constexpr FullScreenInterface kPlanes{ .pass = "subpixel planes", .inputs = kPlaneInputs };
constexpr std::string_view kInputs[] = { "picture", "planes", "depths" };
constexpr FullScreenParameter kValues[] = { { "within", ParameterType::Float4 },
                                            { "perHalfWhite", ParameterType::Float } };
constexpr FullScreenInterface kReconstruction{ .pass = "subpixel reconstruction",
                                               .inputs = kInputs,
                                               .values = kValues };

TextureId addPlanes(FrameGraph& graph, FrameContext const& context, TextureId depth, TextureId depths) {
    const TextureId planes = createLike(graph, depth, Format::RGBA32F, 1, "subpixel planes");
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = depth },
                             FullScreenInput{ .name = "depths", .texture = depths } };
    const std::array tiles{ FullScreenTile{ context.packet.covered } };
    addFullScreenPass(graph, context,
                      { .name = "subpixel planes",
                        .material = context.resources.effects->get("subpixel_planes", {}, kPlanes),
                        .inputs = inputs,
                        .target = planes,
                        .tiles = tiles,
                        .clears = true }); // other texels are not read
    return planes;
}

/// The first and the last pixel.
float4 withinOf(Rect const& rect) {
    const float2 first(static_cast<float>(rect.x), static_cast<float>(rect.y));
    return { first, first + float2(uint2(rect.width - 1, rect.height - 1)) };
}

scene::Material const& materialOf(FrameContext const& context, bool smooths) {
    const bool isWeighted = context.settings().quality.msaaResolve == MsaaResolve::ToneAware;
    const std::array constants{ EffectConstant{ "smooths", smooths }, EffectConstant{ "isWeighted", isWeighted },
                                EffectConstant{ "isTranslucent", context.settings().isTranslucent() } };
    return context.resources.effects->get("subpixel_reconstruction", constants, kReconstruction);
}

} // namespace

void addReconstructionPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Sraa)) return;
    FILAMENT_ASSERT(targets.prepassDepth, "a frame with subpixel reconstruction has depths");
    const uint2 size = sizeOf(graph, targets.color);
    const TextureId depths = addDepthOfView(graph, context, 2u * size, "subpixel depth");
    const TextureId planes = addPlanes(graph, context, targets.prepassDepth, depths);
    const TextureId smooth =
            createLike(graph, targets.color, graph.texture(targets.color).desc.format, 1, "smooth edges");
    const std::array inputs{ FullScreenInput{ .name = "picture", .texture = targets.color },
                             FullScreenInput{ .name = "planes", .texture = planes },
                             FullScreenInput{ .name = "depths", .texture = depths } };
    const std::array values{ FullScreenValue{ "within", withinOf(context.packet.covered) },
                             FullScreenValue{ "perHalfWhite", 1 / halfWhiteOf(context) } };
    std::array<FullScreenTile, 5> tiles{ FullScreenTile{ context.packet.covered, values } };
    size_t count = 1;
    for (Rect const& rect : rectsAround(context.packet.covered, size))
        if (rect.width > 0 && rect.height > 0) tiles[count++] = { rect, values, &materialOf(context, false) };
    addFullScreenPass(graph, context,
                      { .name = "subpixel reconstruction",
                        .material = materialOf(context, true),
                        .inputs = inputs,
                        .target = smooth,
                        .tiles = std::span(tiles).first(count),
                        .fillsTarget = true });
    targets.color = smooth;
}

} // namespace filament_core::passes
