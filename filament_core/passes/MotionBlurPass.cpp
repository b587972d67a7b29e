// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/MotionBlurPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/Reprojection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using framegraph::FrameGraph;
using framegraph::TextureId;

constexpr std::string_view kWayInputs[] = { "depth", "motion" };
constexpr FullScreenParameter kWayValues[] = {
    { "lastFromPixel", ParameterType::Float4x4 }, { "perSample", ParameterType::Float2 },
    { "jitter", ParameterType::Float2 },          { "inverseOfDepth", ParameterType::Float2 },
    { "scale", ParameterType::Float2 },           { "most", ParameterType::Float }
};
constexpr FullScreenInterface kWay{ .pass = "ways", .inputs = kWayInputs, .values = kWayValues };
constexpr std::string_view kWayTileInputs[] = { "source" };
constexpr FullScreenInterface kWayTiles{ .pass = "way tiles", .inputs = kWayTileInputs };
constexpr std::string_view kMotionBlurInputs[] = { "color", "ways", "tiles" };
constexpr FullScreenInterface kMotionBlur{ .pass = "motion blur", .inputs = kMotionBlurInputs };

class MotionBlurPasses {
public:
    MotionBlurPasses(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets)
            : mGraph(graph), mContext(context), mTargets(targets), mSize(context.settings().size),
              mMost(std::max(1.0f, effect().maxRadius * static_cast<float>(context.settings().insideSize().y))),
              // Blur reaches into the next tile, never beyond.
              mTile(std::max(8, static_cast<int32_t>(std::ceil(mMost)))) {}

    TextureId add() {
        const TextureId ways = create(1, "ways"), own = create(mTile, "longest ways"),
                        around = create(mTile, "longest ways around"), blurred = create(1, "color with motion");
        addWays(ways);
        // As the tiles of depth of field: a pixel at rest must know that a moving one beside it is blurred over it.
        addTiles(ways, own, false);
        addTiles(own, around, true);
        addBlur(ways, around, blurred);
        return blurred;
    }

private:
    MotionBlur const& effect() const { return mContext.settings().effects.motionBlur; }
    TextureId create(int32_t pixels, std::string_view name) {
        const auto divided = [pixels = static_cast<uint32_t>(pixels)](uint32_t size) {
            return (size + pixels - 1) / pixels;
        };
        return mGraph.createTexture(
                { .width = divided(mSize.x), .height = divided(mSize.y), .format = Format::RGBA16F, .name = name });
    }
    scene::Material const& material(std::string_view name, std::span<const EffectConstant> constants,
                                    FullScreenInterface const& given) const {
        return mContext.resources.effects->get(name, constants, given);
    }

    void addWays(TextureId target) {
        const std::array inputs{ FullScreenInput{ .name = "depth", .texture = mTargets.prepassDepth },
                                 FullScreenInput{ .name = "motion", .texture = mTargets.motionVectors } };
        const float share = effect().shutterDegrees / 360;
        float4x4 const& clip = mContext.packet.mainView().uniforms.clipFromView;
        const std::array values{ FullScreenValue{ "lastFromPixel", lastFromPixel(mContext, double2(1)) },
                                 FullScreenValue{ "perSample", 1.0f / float2(mSize) },
                                 FullScreenValue{ "jitter", mContext.packet.accumulation.jitterPixels },
                                 FullScreenValue{ "inverseOfDepth",
                                                  isParallel(clip) ? distanceOfDepth(clip) : inverseOfDepth(clip) },
                                 FullScreenValue{ "scale", float2(mSize) * (share / 2) },
                                 FullScreenValue{ "most", mMost } };
        const auto materialOf = [&](bool hasDepth, bool hasMotion) -> scene::Material const& {
            const std::array constants{ EffectConstant{ "isElsewhere", mContext.packet.last.isElsewhere },
                                        EffectConstant{ "hasDepth", hasDepth },
                                        EffectConstant{ "hasMotion", hasMotion },
                                        EffectConstant{ "isParallel", isParallel(clip) } };
            return material("motion_blur_way", constants, kWay);
        };
        // Beside objects there are neither depths nor vectors.
        scene::Material const& inside =
                materialOf(static_cast<bool>(mTargets.prepassDepth), static_cast<bool>(mTargets.motionVectors));
        const Tiles tiles = tilesOf(mContext.packet.covered, materialOf(false, false), values);
        addFullScreenPass(mGraph, mContext,
                          { .name = "ways",
                            .material = inside,
                            .inputs = inputs,
                            .values = values,
                            .target = target,
                            .tiles = tiles.used(),
                            .fillsTarget = true });
    }
    /// A part of the image, and what is around it, by another material.
    struct Tiles {
        std::array<FullScreenTile, 5> all{};
        size_t count = 1;
        std::span<const FullScreenTile> used() const { return std::span(all).first(count); }
    };
    Tiles tilesOf(backend::Rect const& inside, scene::Material const& around,
                  std::span<const FullScreenValue> values) const {
        Tiles tiles{ { FullScreenTile{ inside, values } } };
        for (backend::Rect const& rect : rectsAround(inside, mSize))
            if (rect.width > 0 && rect.height > 0) tiles.all[tiles.count++] = { rect, values, &around };
        return tiles;
    }
    /// What blur may reach: all if the camera moved, otherwise the tiles of objects and those beside them.
    backend::Rect reached() const {
        if (mContext.packet.last.isElsewhere) return { 0, 0, mSize.x, mSize.y };
        backend::Rect const& covered = mContext.packet.covered;
        const auto tile = static_cast<uint32_t>(mTile);
        const uint2 first = uint2(covered.x, covered.y) / tile,
                    end = (uint2(covered.x, covered.y) + uint2(covered.width, covered.height) + tile - 1u) / tile;
        const uint2 from = (max(first, 1u) - 1u) * tile, to = min((end + 1u) * tile, mSize);
        return { static_cast<int32_t>(from.x), static_cast<int32_t>(from.y), to.x - from.x, to.y - from.y };
    }
    void addTiles(TextureId source, TextureId target, bool isDilation) {
        const std::array inputs{ FullScreenInput{ .name = "source", .texture = source } };
        const std::array constants{ EffectConstant{ "isDilation", isDilation }, EffectConstant{ "tile", mTile } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "way tiles",
                            .material = material("motion_blur_tiles", constants, kWayTiles),
                            .inputs = inputs,
                            .target = target });
    }
    void addBlur(TextureId ways, TextureId tiles, TextureId target) {
        const std::array inputs{ FullScreenInput{ .name = "color", .texture = mTargets.color },
                                 FullScreenInput{ .name = "ways", .texture = ways },
                                 FullScreenInput{ .name = "tiles", .texture = tiles } };
        const auto materialOf = [&](bool moves) -> scene::Material const& {
            const std::array constants{ EffectConstant{ "tile", mTile }, EffectConstant{ "moves", moves } };
            return material("motion_blur", constants, kMotionBlur);
        };
        const Tiles all = tilesOf(reached(), materialOf(false), {});
        addFullScreenPass(mGraph, mContext,
                          { .name = "motion blur",
                            .material = materialOf(true),
                            .inputs = inputs,
                            .target = target,
                            .tiles = all.used(),
                            .fillsTarget = true });
    }

    FrameGraph& mGraph;
    FrameContext const& mContext;
    FrameTargets const& mTargets;
    const uint2 mSize;
    const float mMost;   ///< pixels
    const int32_t mTile; ///< pixels of a side
};

} // namespace

// McGuire et al. 2012, "A Reconstruction Filter for Plausible Motion Blur": ways, tiles, gathering.
void addMotionBlurPasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::MotionBlur)) return;
    targets.color = MotionBlurPasses(graph, context, targets).add();
}

} // namespace filament_core::passes
