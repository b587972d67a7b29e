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
        const std::array constants{ EffectConstant{ "isElsewhere", mContext.packet.last.isElsewhere },
                                    EffectConstant{ "hasDepth", static_cast<bool>(mTargets.prepassDepth) },
                                    EffectConstant{ "hasMotion", static_cast<bool>(mTargets.motionVectors) },
                                    EffectConstant{ "isParallel", isParallel(clip) } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "ways",
                            .material = material("motion_blur_way", constants, kWay),
                            .inputs = inputs,
                            .values = values,
                            .target = target });
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
        const std::array constants{ EffectConstant{ "tile", mTile } };
        addFullScreenPass(mGraph, mContext,
                          { .name = "motion blur",
                            .material = material("motion_blur", constants, kMotionBlur),
                            .inputs = inputs,
                            .target = target });
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
