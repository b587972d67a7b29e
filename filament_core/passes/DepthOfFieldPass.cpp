// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/DepthOfFieldPass.h"

#include "filament_core/passes/FullScreenPass.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kHalfInputs[] = { "color", "depth" };
constexpr FullScreenParameter kHalfValues[] = { { "focus", ParameterType::Float3 } };
constexpr FullScreenInterface kHalf{ .pass = "focus half", .inputs = kHalfInputs, .values = kHalfValues };
constexpr std::string_view kTileInputs[] = { "source" };
constexpr FullScreenInterface kTiles{ .pass = "focus tiles", .inputs = kTileInputs };
constexpr std::string_view kFocusBlurInputs[] = { "blurs", "tiles" };
constexpr FullScreenParameter kFocusBlurValues[] = { { "blades", ParameterType::Float } };
constexpr FullScreenInterface kFocusBlur{ .pass = "focus blur",
                                          .inputs = kFocusBlurInputs,
                                          .values = kFocusBlurValues };
constexpr std::string_view kMixInputs[] = { "color", "depth", "blurred" };
constexpr FullScreenParameter kMixValues[] = { { "focus", ParameterType::Float3 },
                                               { "perTexel", ParameterType::Float2 } };
constexpr FullScreenInterface kMix{ .pass = "focus", .inputs = kMixInputs, .values = kMixValues };

uint32_t divided(uint32_t size, uint32_t by) { return (size + by - 1) / by; }

float3 valuesOf(prepare::Focus const& focus) { return { focus.radius, focus.radiusTimesFocus, focus.mostPixels }; }

class FocusPasses {
public:
    FocusPasses(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets)
            : mGraph(graph), mContext(context), mColor(targets.color), mDepth(targets.prepassDepth),
              mSize(context.settings().size),
              // Blur reaches into the next tile, never beyond.
              mTile(std::max(8, static_cast<int>(std::ceil(context.packet.focus.mostPixels / 2)))) {}

    TextureId add() {
        const TextureId half = create(2, Format::RGBA16F, "half in focus");
        addHalf(half);
        const uint32_t tile = 2 * static_cast<uint32_t>(mTile);
        const TextureId own = create(tile, Format::RGBA16F, "blur of tiles"),
                        around = create(tile, Format::RGBA16F, "blur around tiles");
        // The widest blur of each tile, then of its neighbours: a pixel in focus must know that a blurred one beside it
        // reaches it.
        addTiles(half, own, false);
        addTiles(own, around, true);
        const TextureId blurred = create(2, Format::RGBA16F, "blurred");
        addBlur(half, around, blurred);
        const TextureId mixed = create(1, Format::RGBA16F, "color with focus");
        addMix(blurred, mixed);
        return mixed;
    }

private:
    TextureId create(uint32_t pixels, Format format, std::string_view name) {
        return mGraph.createTexture({ .width = divided(mSize.x, pixels),
                                      .height = divided(mSize.y, pixels),
                                      .format = format,
                                      .name = name });
    }
    scene::Material const& material(std::string_view name, std::span<const EffectConstant> constants,
                                    FullScreenInterface const& given) const {
        return mContext.resources.effects->get(name, constants, given);
    }

    void addHalf(TextureId half) {
        const std::array inputs{ FullScreenInput{ .name = "color", .texture = mColor },
                                 FullScreenInput{ .name = "depth", .texture = mDepth } };
        const std::array values{ FullScreenValue{ "focus", valuesOf(mContext.packet.focus) } };
        const std::array constants{ EffectConstant{ "hasDepth", static_cast<bool>(mDepth) } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "focus half",
                            .material = material("focus_half", constants, kHalf),
                            .inputs = inputs,
                            .values = values,
                            .target = half });
    }
    void addTiles(TextureId source, TextureId tiles, bool isDilation) {
        const std::array inputs{ FullScreenInput{ .name = "source", .texture = source } };
        const std::array constants{ EffectConstant{ "isDilation", isDilation }, EffectConstant{ "tile", mTile } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "focus tiles",
                            .material = material("focus_tiles", constants, kTiles),
                            .inputs = inputs,
                            .target = tiles });
    }
    void addBlur(TextureId half, TextureId tiles, TextureId blurred) {
        const std::array inputs{ FullScreenInput{ .name = "blurs", .texture = half },
                                 FullScreenInput{ .name = "tiles", .texture = tiles } };
        const float blades = static_cast<float>(mContext.settings().effects.depthOfField.blades);
        const std::array values{ FullScreenValue{ "blades", blades } };
        const std::array constants{ EffectConstant{ "tile", mTile } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "focus blur",
                            .material = material("focus_blur", constants, kFocusBlur),
                            .inputs = inputs,
                            .values = values,
                            .target = blurred });
    }
    void addMix(TextureId blurred, TextureId target) {
        const std::array inputs{
            FullScreenInput{ .name = "color", .texture = mColor },
            FullScreenInput{ .name = "depth", .texture = mDepth },
            FullScreenInput{ .name = "blurred", .texture = blurred, .sampler = mContext.resources.samplers.bilinear }
        };
        const float2 perTexel = 1.0f / float2(divided(mSize.x, 2), divided(mSize.y, 2));
        const std::array values{ FullScreenValue{ "focus", valuesOf(mContext.packet.focus) },
                                 FullScreenValue{ "perTexel", perTexel } };
        const std::array constants{ EffectConstant{ "hasDepth", static_cast<bool>(mDepth) } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "focus",
                            .material = material("focus", constants, kMix),
                            .inputs = inputs,
                            .values = values,
                            .target = target });
    }

    FrameGraph& mGraph;
    FrameContext const& mContext;
    const TextureId mColor, mDepth;
    const uint2 mSize;
    const int32_t mTile; ///< texels of a side, of the image of half size
};

} // namespace

// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare": half size, tiles, gathering.
void addDepthOfFieldPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::DepthOfField)) return;
    targets.color = FocusPasses(graph, context, targets).add();
}

} // namespace filament_core::passes
