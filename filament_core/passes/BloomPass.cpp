// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/BloomPass.h"

#include "base/math/Elementary.h"
#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kLevelInputs[] = { "level" };
constexpr FullScreenParameter kDownValues[] = { { "perTexel", ParameterType::Float2 },
                                                { "threshold", ParameterType::Float } };
constexpr FullScreenInterface kDown{ .pass = "bloom down", .inputs = kLevelInputs, .values = kDownValues };
constexpr FullScreenParameter kUpValues[] = { { "perTexel", ParameterType::Float2 },
                                              { "weight", ParameterType::Float } };
constexpr FullScreenInterface kUp{ .pass = "bloom up", .inputs = kLevelInputs, .values = kUpValues };

float2 perTexel(FrameGraph const& graph, TextureId texture, uint8_t level) {
    framegraph::GraphTextureDesc const& desc = graph.texture(texture).desc;
    return { 1.0f / static_cast<float>(std::max(1u, desc.width >> level)),
             1.0f / static_cast<float>(std::max(1u, desc.height >> level)) };
}

/// n, if texels of the first level are 2^n pixels wide.
int firstLevel(BloomResolution resolution) { return resolution == BloomResolution::Quarter ? 2 : 1; }

/// `level` of `spread` from the one before it, or from the scene colour.
void addDown(FrameGraph& graph, FrameContext const& context, TextureId color, TextureId spread, uint8_t level) {
    const bool isFirst = level == 0;
    const TextureId from = isFirst ? color : spread;
    const auto fromLevel = static_cast<uint8_t>(isFirst ? 0 : level - 1);
    const std::array inputs{ FullScreenInput{ .name = "level",
                                              .texture = from,
                                              .sampler = context.resources.samplers.bilinear,
                                              .range = backend::oneLevel(fromLevel) } };
    const std::array values{ FullScreenValue{ "perTexel", perTexel(graph, from, fromLevel) },
                             FullScreenValue{ "threshold", context.settings().effects.bloom.threshold } };
    const bool isQuarter = isFirst && context.settings().effects.bloom.resolution == BloomResolution::Quarter;
    const EffectConstant constants[] = { { "isFirst", isFirst }, { "isQuarter", isQuarter } };
    addFullScreenPass(graph, context,
                      { .name = "bloom down",
                        .material = context.resources.effects->get("bloom_down", constants, kDown),
                        .inputs = inputs,
                        .values = values,
                        .target = spread,
                        .level = level });
}

/// Level n of N holds the mean of the levels n to N - 1 afterwards.
void addUp(FrameGraph& graph, FrameContext const& context, TextureId spread, uint8_t level, uint8_t levels) {
    const auto below = static_cast<uint8_t>(level + 1);
    const std::array inputs{ FullScreenInput{ .name = "level",
                                              .texture = spread,
                                              .sampler = context.resources.samplers.bilinear,
                                              .range = backend::oneLevel(below) } };
    // The level below stands for all levels from there on, and weighs as much as these. So each level counts once.
    const float weight = static_cast<float>(levels - below) / static_cast<float>(levels - level);
    const std::array values{ FullScreenValue{ "perTexel", perTexel(graph, spread, below) },
                             FullScreenValue{ "weight", weight } };
    addFullScreenPass(graph, context,
                      { .name = "bloom up",
                        .material = context.resources.effects->get("bloom_up", {}, kUp),
                        .inputs = inputs,
                        .values = values,
                        .target = spread,
                        .level = level });
}

} // namespace

uint8_t bloomLevels(uint2 view, float radiusPixels, BloomResolution resolution) {
    constexpr int kLast = 10;
    const int first = firstLevel(resolution);
    const int last = radiusPixels > 2 ? static_cast<int>(std::lround(elementary::log2(radiusPixels))) : 1;
    const int whole = std::bit_width(std::max(1u, std::min(view.x, view.y) >> first)); // until one texel is left
    return static_cast<uint8_t>(std::clamp(last - first + 1, 1, std::min(whole, kLast - first + 1)));
}

void addBloomPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Bloom)) return;
    const uint2 size = sizeOf(graph, targets.color);
    const uint2 inside = size - 2u * context.settings().band;
    const BloomResolution resolution = context.settings().effects.bloom.resolution;
    const float radiusPixels = context.settings().effects.bloom.radius * static_cast<float>(inside.y);
    const uint8_t levels = bloomLevels(inside, radiusPixels, resolution);
    const TextureId spread = graph.createTexture({ .width = std::max(1u, size.x >> firstLevel(resolution)),
                                                   .height = std::max(1u, size.y >> firstLevel(resolution)),
                                                   .format = Format::RGBA16F,
                                                   .levels = levels,
                                                   .name = "spread light" });
    // All levels are made first: adding overwrites a level, from which the next smaller one is made.
    for (uint8_t level = 0; level < levels; ++level) addDown(graph, context, targets.color, spread, level);
    for (int level = levels - 2; level >= 0; --level)
        addUp(graph, context, spread, static_cast<uint8_t>(level), levels);
    targets.bloom = spread;
}

} // namespace filament_core::passes
