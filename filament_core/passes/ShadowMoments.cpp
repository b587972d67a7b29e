// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ShadowMoments.h"

#include "filament_core/passes/FullScreenPass.h"

#include <array>

namespace filament_core::passes {
namespace {

using backend::Rect;
using framegraph::FrameGraph;
using framegraph::TextureId;
using prepare::kShadowMomentLevels;
using prepare::ShadowMapPacket;
using prepare::ShadowMoments;
using prepare::ShadowPacket;
using prepare::ShadowTile;

constexpr std::string_view kMomentBlurInputs[] = { "depths", "moments" };
constexpr FullScreenParameter kMomentBlurValues[] = { { "tile", ParameterType::Float4 },
                                                      { "radius", ParameterType::Float },
                                                      { "nearOverFar", ParameterType::Float } };
constexpr FullScreenInterface kMomentBlur{ .pass = "shadow moments",
                                           .inputs = kMomentBlurInputs,
                                           .values = kMomentBlurValues };
constexpr std::string_view kMipInputs[] = { "moments" };
constexpr FullScreenInterface kMip{ .pass = "shadow mips", .inputs = kMipInputs };

Rect rectOf(ShadowTile tile, uint8_t level) {
    const uint32_t size = tile.size >> level;
    return { tile.x >> level, tile.y >> level, size, size };
}

std::span<const FullScreenValue> blurValues(Arena& arena, shader::ShadowMapRecord const& record, ShadowTile tile) {
    const float x = tile.x, y = tile.y, last = static_cast<float>(tile.size - 1);
    const auto values = arena.array<FullScreenValue>(3);
    values[0] = { "tile", float4(x, y, x + last, y + last) };
    values[1] = { "radius", record.softness.w };
    values[2] = { "nearOverFar", record.softness.z };
    return values;
}

/// Of the maps that are drawn, on a level; with values for the blur, or none.
std::span<const FullScreenTile> drawnTiles(FrameContext const& context, uint8_t level, bool withValues) {
    ShadowPacket const& shadows = context.packet.shadows;
    const std::span<FullScreenTile> tiles = context.arena->array<FullScreenTile>(prepare::drawnChannels(shadows));
    size_t count = 0;
    for (size_t i = 0; i < shadows.maps.size(); ++i) {
        ShadowMapPacket const& map = shadows.maps[i];
        if (map.view == prepare::kKeptMap) continue;
        for (uint32_t channel = 0; channel < map.channels; ++channel, ++count) {
            const ShadowTile tile = prepare::channelTile(map, channel);
            tiles[count].rect = rectOf(tile, level);
            if (withValues) tiles[count].values = blurValues(*context.arena, shadows.uniforms->maps[i], tile);
        }
    }
    return tiles;
}

scene::Material const& blurMaterial(FrameContext const& context, bool fromDepths) {
    const std::array constants{ EffectConstant{ "fromDepths", fromDepths },
                                EffectConstant{ "fromMoments", !fromDepths },
                                EffectConstant{ "warped", context.packet.shadows.moments == ShadowMoments::Four } };
    return context.resources.effects->get("shadow_moments", constants, kMomentBlur);
}

void addBlur(FrameGraph& graph, FrameContext const& context, TextureId depths, TextureId moments) {
    framegraph::GraphTextureDesc like = graph.texture(moments).desc;
    like.levels = 1;
    like.name = "shadow moments, half blurred";
    // A blur along x and then along y: 2 n look-ups a texel instead of n^2. The texture between them is as large as the
    // atlas, and the graph shares its memory with others.
    const TextureId half = graph.createTexture(like);
    const std::span<const FullScreenTile> tiles = drawnTiles(context, 0, true);
    const std::array fromDepths{ FullScreenInput{ .name = "depths", .texture = depths },
                                 FullScreenInput{ .name = "moments" } };
    addFullScreenPass(graph, context,
                      { .name = "shadow moments",
                        .material = blurMaterial(context, true),
                        .inputs = fromDepths,
                        .target = half,
                        .tiles = tiles,
                        .clears = true });
    const std::array fromMoments{ FullScreenInput{ .name = "depths" },
                                  FullScreenInput{ .name = "moments", .texture = half } };
    addFullScreenPass(graph, context,
                      { .name = "shadow blur",
                        .material = blurMaterial(context, false),
                        .inputs = fromMoments,
                        .target = moments,
                        .tiles = tiles,
                        .clears = !context.packet.shadows.keepsAtlas });
}

void addMips(FrameGraph& graph, FrameContext const& context, TextureId moments) {
    scene::Material const& material = context.resources.effects->get("shadow_mip", {}, kMip);
    for (uint8_t level = 1; level < kShadowMomentLevels; ++level) {
        const std::array inputs{ FullScreenInput{
                .name = "moments", .texture = moments, .range = backend::oneLevel(static_cast<uint8_t>(level - 1)) } };
        addFullScreenPass(graph, context,
                          { .name = "shadow mips",
                            .material = material,
                            .inputs = inputs,
                            .target = moments,
                            .level = level,
                            .tiles = drawnTiles(context, level, false),
                            .clears = !context.packet.shadows.keepsAtlas });
    }
}

} // namespace

// Two moments: Donnelly and Lauritzen 2006, "Variance Shadow Maps"; four of warped depths: Lauritzen and McCool 2008,
// "Layered Variance Shadow Maps".
void addShadowMoments(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    ShadowPacket const& shadows = context.packet.shadows;
    if (shadows.maps.empty() || shadows.moments == ShadowMoments::None) return;
    using framegraph::InitialContents;
    targets.shadows = graph.importTexture(context.resources.shadowMoments,
                                          { .width = shadows.atlasSize,
                                            .height = shadows.atlasSize,
                                            .format = momentFormat(shadows.moments),
                                            .levels = kShadowMomentLevels,
                                            .name = "shadow moments" },
                                          shadows.keepsAtlas ? InitialContents::Keep : InitialContents::Undefined);
    if (shadows.drawn == 0) return;
    addBlur(graph, context, targets.shadowDepths, targets.shadows);
    addMips(graph, context, targets.shadows);
}

} // namespace filament_core::passes
