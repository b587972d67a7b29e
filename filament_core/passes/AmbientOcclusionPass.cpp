// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/AmbientOcclusionPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/Reprojection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::passes {
namespace {

using backend::Format;
using backend::Rect;
using framegraph::FrameGraph;
using framegraph::GraphTextureDesc;
using framegraph::TextureId;

constexpr std::string_view kPointInputs[] = { "depth" };
constexpr FullScreenParameter kPointValues[] = {
    { "inverseOfDepth", ParameterType::Float2 }, { "rays", ParameterType::Float4 },
    { "reach", ParameterType::Float4 },          { "last", ParameterType::Float2 },
    { "intensity", ParameterType::Float },       { "parallel", ParameterType::Float2 }
};
constexpr FullScreenInterface kPoints{ .pass = "ambient occlusion", .inputs = kPointInputs, .values = kPointValues };
constexpr std::string_view kFilterInputs[] = { "occlusion", "depth" };
constexpr FullScreenParameter kBlurValues[] = {
    { "inverseOfDepth", ParameterType::Float2 }, { "last", ParameterType::Float2 },
    { "lastTexel", ParameterType::Float2 },      { "axis", ParameterType::Float2 },
    { "stride", ParameterType::Float },          { "deviation", ParameterType::Float }
};
constexpr FullScreenInterface kOcclusionBlur{ .pass = "occlusion blur",
                                              .inputs = kFilterInputs,
                                              .values = kBlurValues };
constexpr FullScreenParameter kUpsampleValues[] = { { "inverseOfDepth", ParameterType::Float2 },
                                                    { "last", ParameterType::Float2 },
                                                    { "lastTexel", ParameterType::Float2 } };
constexpr FullScreenInterface kUpsample{ .pass = "occlusion upsample",
                                         .inputs = kFilterInputs,
                                         .values = kUpsampleValues };

/// The grids of shaders/post/occlusion_places.glsl.
struct OcclusionGrid {
    int32_t code;
    uint2 size;
    uint2 stride; ///< pixels from texel to texel
};

OcclusionGrid gridOf(AmbientOcclusionResolution resolution, uint2 view) {
    const uint2 half{ (view.x + 1) / 2, (view.y + 1) / 2 };
    switch (resolution) {
    case AmbientOcclusionResolution::Half:
        return { 1, half, { 2, 2 } };
    case AmbientOcclusionResolution::Checkerboard:
        return { 2, { half.x, view.y }, { 2, 1 } };
    case AmbientOcclusionResolution::Full:
        break;
    }
    return { 0, view, { 1, 1 } };
}

float2 lastOf(uint2 size) { return { static_cast<float>(size.x - 1), static_cast<float>(size.y - 1) }; }

/// How the rays of pixels are computed: rays = pixel * xy + zw, and (d * ray, -d) is the point of distance d. Of a
/// parallel projection: (ray, -d).
float4 raysOf(float4x4 const& clip, uint2 size) {
    const double x = clip[0].x, y = clip[1].y;
    if (isParallel(clip)) {
        return { static_cast<float>(2.0 / size.x / x), static_cast<float>(2.0 / size.y / y),
                 static_cast<float>((1.0 / size.x - 1.0 - clip[3].x) / x),
                 static_cast<float>((1.0 / size.y - 1.0 - clip[3].y) / y) };
    }
    return { static_cast<float>(2.0 / size.x / x), static_cast<float>(2.0 / size.y / y),
             static_cast<float>((1.0 / size.x - 1.0 + clip[2].x) / x),
             static_cast<float>((1.0 / size.y - 1.0 + clip[2].y) / y) };
}

/// The fixed inputs of all passes of the effect.
struct OcclusionSource {
    FrameContext const& context;
    TextureId depth;
    OcclusionGrid grid;
    bool hasBentNormals;

    /// Whether filters look up depths. Otherwise each texel knows its distance; it has no room beside a bent normal,
    /// and those of a checkerboard do not lie along the axes of the blur.
    bool isFromDepth() const { return hasBentNormals || grid.code == 2; }
    Format resultFormat() const { return hasBentNormals ? Format::RGBA8 : Format::R8; }
    float4x4 const& clip() const { return context.packet.mainView().uniforms.clipFromView; }
    /// Of a parallel projection.
    float pixelMeters() const { return 2 / (std::abs(clip()[1].y) * static_cast<float>(context.settings().size.y)); }
    float emptyDepth() const { return clip()[2].z < 0 ? 1.0f : 0.0f; } // with the ordinary range, depths grow
    /// shaders/post/occlusion_places.glsl
    float2 inverse() const {
        if (!isParallel(clip())) return inverseOfDepth(clip());
        const float perDepth = 1 / (clip()[2].z * pixelMeters());
        return { perDepth, -emptyDepth() * perDepth };
    }
    /// distance = x - inverse * y, of a parallel projection.
    float2 distanceOfInverse() const {
        if (!isParallel(clip())) return float2(0);
        const float2 distance = distanceOfDepth(clip());
        return { emptyDepth() * distance.x + distance.y, pixelMeters() };
    }

    /// Of surfaces there is none, and filters find every texel like this one: it is what the passes compute there.
    float4 clearColor() const {
        constexpr float kInverseOfNothing = 1e-30f; // shaders/post/occlusion_places.glsl
        constexpr float kNoLean = 128.0f / 255;     // encodeLean()
        // Inverted twice, as the shader does it: the quotient of a quotient need not have the bits of the number.
        return hasBentNormals ? float4(1, kNoLean, kNoLean, kNoLean) : float4(1, 1 / (1 / kInverseOfNothing), 0, 0);
    }

    /// Texels of the pixels that objects cover.
    Rect covered(uint2 stride) const {
        Rect const& pixels = context.packet.covered;
        const uint32_t x = static_cast<uint32_t>(pixels.x) / stride.x, y = static_cast<uint32_t>(pixels.y) / stride.y;
        return { static_cast<int32_t>(x), static_cast<int32_t>(y), (pixels.width + stride.x - 1) / stride.x,
                 (pixels.height + stride.y - 1) / stride.y };
    }

    TextureId texture(FrameGraph& graph, bool isResult, std::string_view name) const {
        const uint2 size = grid.size;
        const Format format = isResult || isFromDepth() ? resultFormat() : Format::RG32F;
        return graph.createTexture({ .width = size.x, .height = size.y, .format = format, .name = name });
    }
};

/// Draws only what objects cover.
void addCoveredPass(FrameGraph& graph, OcclusionSource const& from, Rect const& texels, FullScreenPass pass) {
    const std::array tiles{ FullScreenTile{ texels, pass.values } };
    pass.tiles = tiles;
    pass.clears = true;
    pass.clearColor = from.clearColor();
    addFullScreenPass(graph, from.context, pass);
}

/// By samples: McGuire, Mara and Luebke 2012, "Scalable Ambient Obscurance"; by horizons: Jimenez et al. 2016,
/// "Practical Realtime Strategies for Accurate Indirect Occlusion".
TextureId addPoints(FrameGraph& graph, OcclusionSource const& from, bool isResult) {
    FrameContext const& context = from.context;
    AmbientOcclusion const& occlusion = context.settings().effects.ambientOcclusion;
    const uint2 size = context.settings().size;
    const float4 rays = raysOf(context.packet.mainView().uniforms.clipFromView, size);
    const float radius = occlusion.radiusMeters;
    const std::array constants{
        EffectConstant{ "grid", from.grid.code },
        EffectConstant{ "samples", occlusion.method == AmbientOcclusionMethod::Sao ? int32_t{ occlusion.samples } : 0 },
        EffectConstant{ "slices", int32_t{ occlusion.slices } }, EffectConstant{ "bentNormals", occlusion.bentNormals },
        EffectConstant{ "isParallel", isParallel(from.clip()) }
    };
    const std::array values{ FullScreenValue{ "inverseOfDepth", from.inverse() },
                             FullScreenValue{ "rays", rays },
                             FullScreenValue{ "reach", float4(radius, 1 / radius, radius / std::abs(rays.x),
                                                              static_cast<float>(std::max(size.x, size.y)) / 2) },
                             FullScreenValue{ "last", lastOf(size) },
                             FullScreenValue{ "intensity", occlusion.intensity },
                             FullScreenValue{ "parallel", from.distanceOfInverse() } };
    const std::array inputs{ FullScreenInput{ .name = "depth", .texture = from.depth } };
    const TextureId target = from.texture(graph, isResult, "occlusion of points");
    addCoveredPass(graph, from, from.covered(from.grid.stride),
                   { .name = "ambient occlusion",
                     .material = context.resources.effects->get("ambient_occlusion", constants, kPoints),
                     .inputs = inputs,
                     .values = values,
                     .target = target });
    return target;
}

/// Surfaces closer together than this part of the radius share what hides them.
constexpr float kDeviation = 0.1f;

TextureId addBlur(FrameGraph& graph, OcclusionSource const& from, TextureId occlusion, bool alongX, bool isResult) {
    FrameContext const& context = from.context;
    const std::array constants{ EffectConstant{ "grid", from.grid.code },
                                EffectConstant{ "fromDepth", from.isFromDepth() },
                                EffectConstant{ "isParallel", isParallel(from.clip()) } };
    const float unit = isParallel(from.clip()) ? from.pixelMeters() : 1.0f;
    const float radius = context.settings().effects.ambientOcclusion.radiusMeters;
    const std::array values{ FullScreenValue{ "inverseOfDepth", from.inverse() },
                             FullScreenValue{ "last", lastOf(context.settings().size) },
                             FullScreenValue{ "lastTexel", lastOf(from.grid.size) },
                             FullScreenValue{ "axis", alongX ? float2(1, 0) : float2(0, 1) },
                             FullScreenValue{ "stride",
                                              static_cast<float>(alongX ? from.grid.stride.x : from.grid.stride.y) },
                             FullScreenValue{ "deviation", radius * kDeviation / unit } };
    const std::array inputs{ FullScreenInput{ .name = "occlusion", .texture = occlusion },
                             FullScreenInput{ .name = "depth",
                                              .texture = from.isFromDepth() ? from.depth : TextureId{} } };
    const TextureId target = from.texture(graph, isResult, alongX ? "occlusion, half blurred" : "occlusion, blurred");
    addCoveredPass(graph, from, from.covered(from.grid.stride),
                   { .name = "occlusion blur",
                     .material = context.resources.effects->get("occlusion_blur", constants, kOcclusionBlur),
                     .inputs = inputs,
                     .values = values,
                     .target = target });
    return target;
}

TextureId addUpsample(FrameGraph& graph, OcclusionSource const& from, TextureId occlusion) {
    FrameContext const& context = from.context;
    const std::array constants{ EffectConstant{ "grid", from.grid.code },
                                EffectConstant{ "fromDepth", from.isFromDepth() },
                                EffectConstant{ "isParallel", isParallel(from.clip()) } };
    const std::array values{ FullScreenValue{ "inverseOfDepth", from.inverse() },
                             FullScreenValue{ "last", lastOf(context.settings().size) },
                             FullScreenValue{ "lastTexel", lastOf(from.grid.size) } };
    const std::array inputs{ FullScreenInput{ .name = "occlusion", .texture = occlusion },
                             FullScreenInput{ .name = "depth", .texture = from.depth } };
    const uint2 size = context.settings().size;
    const TextureId target = graph.createTexture(
            { .width = size.x, .height = size.y, .format = from.resultFormat(), .name = "occlusion" });
    addCoveredPass(graph, from, from.covered({ 1, 1 }),
                   { .name = "occlusion upsample",
                     .material = context.resources.effects->get("occlusion_upsample", constants, kUpsample),
                     .inputs = inputs,
                     .values = values,
                     .target = target });
    return target;
}

} // namespace

void addAmbientOcclusionPass(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::AmbientOcclusion)) return;
    FILAMENT_ASSERT(targets.prepassDepth, "a frame with ambient occlusion has depths");
    AmbientOcclusion const& occlusion = context.settings().effects.ambientOcclusion;
    const OcclusionSource from{ context, targets.prepassDepth, gridOf(occlusion.resolution, context.settings().size),
                                occlusion.bentNormals };
    const bool isUpsampled = from.grid.code != 0;
    targets.ambientOcclusion = addPoints(graph, from, !occlusion.blur && !isUpsampled);
    // The blur comes before the upsampling: it works on fewer pixels, and what it removes is not magnified.
    if (occlusion.blur) {
        targets.ambientOcclusion = addBlur(graph, from, targets.ambientOcclusion, true, false);
        targets.ambientOcclusion = addBlur(graph, from, targets.ambientOcclusion, false, !isUpsampled);
    }
    if (isUpsampled) targets.ambientOcclusion = addUpsample(graph, from, targets.ambientOcclusion);
}

} // namespace filament_core::passes
