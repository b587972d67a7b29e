// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/FlarePass.h"

#include "base/math/Elementary.h"
#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kFlareLightInputs[] = { "color" };
constexpr FullScreenParameter kFlareLightValues[] = { { "threshold", ParameterType::Float } };
constexpr FullScreenInterface kFlareLight{ .pass = "flare light",
                                           .inputs = kFlareLightInputs,
                                           .values = kFlareLightValues };
constexpr std::string_view kFlareHalfInputs[] = { "level" };
constexpr FullScreenParameter kFlareHalfValues[] = { { "perTexel", ParameterType::Float2 },
                                                     { "threshold", ParameterType::Float } };
constexpr FullScreenInterface kFlareHalf{ .pass = "flare half",
                                          .inputs = kFlareHalfInputs,
                                          .values = kFlareHalfValues };
constexpr std::string_view kFlareInputs[] = { "light" };
constexpr FullScreenParameter kFlareValues[] = {
    { "size", ParameterType::Float2 },     { "perPixel", ParameterType::Float2 },
    { "ghosts", ParameterType::Float4x4 }, { "moreGhosts", ParameterType::Float4x4 },
    { "halo", ParameterType::Float4 },     { "dispersion", ParameterType::Float },
};
constexpr FullScreenInterface kFlare{ .pass = "flare", .inputs = kFlareInputs, .values = kFlareValues };

constexpr float kNearestGhost = 0.1f; // nearer to the middle, in distances of the lamp, a ghost is left out
// Texels that overlap leave no spots: 1.4 times the distance between taps.
constexpr float kTexelsOfTap = 0.62f;   // of a disc with 16 taps, in radii: 1.4 sqrt(pi / 16)
constexpr float kTexelsOfRing = 0.092f; // of a ring with 96: 1.4 * 2 pi / 96

/// The level whose texels are `texels` of the first one wide.
float flareLevel(float texels) { return std::max(std::round(elementary::log2(std::max(texels, 1.0f))), 0.0f); }

float4x4 ghostColumns(std::span<const FlareGhost, 4> ghosts) {
    float4x4 columns(0.0f);
    for (int i = 0; i < 4; ++i) {
        FlareGhost const& ghost = ghosts[static_cast<size_t>(i)];
        columns[i] = float4(ghost.scale, ghost.radius, ghost.level, ghost.share);
    }
    return columns;
}

EffectConstant blockConstant(uint2 size) { return { "block", static_cast<int32_t>(flareBlock(size.y)) }; }

void addFlareLight(FrameGraph& graph, FrameContext const& context, TextureId color, TextureId bright) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = color } };
    const std::array values{ FullScreenValue{ "threshold", context.settings().effects.lensFlare.threshold } };
    const EffectConstant constants[] = { blockConstant(sizeOf(graph, color)) };
    addFullScreenPass(graph, context,
                      { .name = "flare light",
                        .material = context.resources.effects->get("flare_light", constants, kFlareLight),
                        .inputs = inputs,
                        .values = values,
                        .target = bright });
}

/// `level` from the one before it, by the weights that bloom halves with.
void addFlareHalf(FrameGraph& graph, FrameContext const& context, TextureId bright, uint8_t level) {
    framegraph::GraphTextureDesc const& desc = graph.texture(bright).desc;
    const auto from = static_cast<uint8_t>(level - 1);
    const float2 size(std::max(1u, desc.width >> from), std::max(1u, desc.height >> from));
    const std::array inputs{ FullScreenInput{ .name = "level",
                                              .texture = bright,
                                              .sampler = context.resources.samplers.bilinear,
                                              .range = backend::oneLevel(from) } };
    const std::array values{ FullScreenValue{ "perTexel", 1.0f / size }, FullScreenValue{ "threshold", 0.0f } };
    const EffectConstant constants[] = { { "isFirst", false } };
    addFullScreenPass(graph, context,
                      { .name = "flare half",
                        .material = context.resources.effects->get("bloom_down", constants, kFlareHalf),
                        .inputs = inputs,
                        .values = values,
                        .target = bright,
                        .level = level });
}

void addGhostsAndHalo(FrameGraph& graph, FrameContext const& context, uint2 size, TextureId bright, TextureId flare) {
    framegraph::GraphTextureDesc const& desc = graph.texture(bright).desc;
    LensFlare const& options = context.settings().effects.lensFlare;
    const std::array ghosts = flareGhosts(options, size.y);
    const std::array inputs{ FullScreenInput{
            .name = "light", .texture = bright, .sampler = context.resources.samplers.bilinearOfLevels } };
    const std::array values{
        FullScreenValue{ "size", float2(size) },
        FullScreenValue{ "perPixel", 1.0f / float2(flareBlock(size.y) * desc.width, flareBlock(size.y) * desc.height) },
        FullScreenValue{ "ghosts", ghostColumns(std::span(ghosts).first<4>()) },
        FullScreenValue{ "moreGhosts", ghostColumns(std::span(ghosts).last<4>()) },
        FullScreenValue{ "halo", flareHalo(options, size.y) },
        FullScreenValue{ "dispersion", options.dispersion },
    };
    const EffectConstant constants[] = { blockConstant(size) };
    addFullScreenPass(graph, context,
                      { .name = "flare",
                        .material = context.resources.effects->get("flare", constants, kFlare),
                        .inputs = inputs,
                        .values = values,
                        .target = flare });
}

} // namespace

uint32_t flareBlock(uint32_t height) {
    constexpr uint32_t kLeastRows = 90, kLargestBlock = 64;
    return std::bit_floor(std::clamp(height / kLeastRows, 1u, kLargestBlock));
}

// Chapman 2013, "Pseudo Lens Flare".
std::array<FlareGhost, kMostGhosts> flareGhosts(LensFlare const& flare, uint32_t height) {
    std::array<FlareGhost, kMostGhosts> ghosts{};
    const auto block = static_cast<float>(flareBlock(height));
    const size_t count = std::min<size_t>(flare.ghostCount, kMostGhosts);
    for (size_t i = 0; i < count; ++i) {
        const float number = static_cast<float>(i + 1);
        const float place = 1 - flare.ghostSpacing * number; // of the lamp's distance from the middle
        if (std::abs(place) < kNearestGhost) continue;
        const float size = 0.5f + glm::fract(0.61803399f * number); // ghosts of a lens differ in focus
        const float scale = 1 / place;
        const float radius = flare.ghostRadius * size * static_cast<float>(height) * std::abs(scale);
        const float texels = std::max(kTexelsOfTap * radius / block, 0.7f * std::abs(scale));
        ghosts[i] = { scale, radius, flareLevel(texels), flare.ghostStrength / static_cast<float>(count) };
    }
    return ghosts;
}

float4 flareHalo(LensFlare const& flare, uint32_t height) {
    const float radius = flare.haloRadius * static_cast<float>(height);
    const auto block = static_cast<float>(flareBlock(height));
    return { radius, 0.5f * flare.haloThickness * radius, flareLevel(kTexelsOfRing * radius / block),
             flare.haloStrength };
}

float flareShare(LensFlare const& flare) {
    float share = flare.haloStrength;
    for (FlareGhost const& ghost : flareGhosts(flare, 1)) share += ghost.share;
    return share;
}

void addFlarePasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::LensFlare)) return;
    const uint2 size = sizeOf(graph, targets.color);
    const uint32_t block = flareBlock(size.y);
    const uint2 blocks = (size + block - 1u) / block;
    const auto levels = static_cast<uint8_t>(std::bit_width(std::max(blocks.x, blocks.y)));
    const TextureId bright = graph.createTexture({ .width = blocks.x,
                                                   .height = blocks.y,
                                                   .format = Format::RGBA16F,
                                                   .levels = levels,
                                                   .name = "light of the flare" });
    addFlareLight(graph, context, targets.color, bright);
    for (uint8_t level = 1; level < levels; ++level) addFlareHalf(graph, context, bright, level);
    targets.flare =
            graph.createTexture({ .width = blocks.x, .height = blocks.y, .format = Format::RGBA16F, .name = "flare" });
    addGhostsAndHalo(graph, context, size, bright, targets.flare);
}

} // namespace filament_core::passes
