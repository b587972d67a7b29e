// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/SceneColorCopyPass.h"

#include "filament_core/passes/FullScreenPass.h"
#include "filament_core/passes/Reprojection.h"

#include <array>

namespace filament_core::passes {
namespace {

using backend::Format;
using backend::Rect;
using framegraph::FrameGraph;
using framegraph::TextureId;
using prepare::SceneColorCopy;

constexpr std::string_view kCopyInputs[] = { "color", "depth" };
constexpr FullScreenInterface kCopy{ .pass = "scene color copy", .inputs = kCopyInputs };
constexpr std::string_view kReprojectionInputs[] = { "last", "depth", "motion" };
constexpr FullScreenParameter kReprojectionValues[] = { { "lastFromPixel", ParameterType::Float4x4 },
                                                        { "lastAlong", ParameterType::Float4 },
                                                        { "along", ParameterType::Float4 },
                                                        { "perTexel", ParameterType::Float2 },
                                                        { "end", ParameterType::Float2 } };
constexpr FullScreenInterface kReprojection{ .pass = "reprojection",
                                             .inputs = kReprojectionInputs,
                                             .values = kReprojectionValues };
constexpr std::string_view kPictureLevelInputs[] = { "level" };
constexpr FullScreenParameter kLevelValues[] = { { "texels", ParameterType::Float4 },
                                                 { "perTexel", ParameterType::Float2 } };
constexpr FullScreenInterface kLevel{ .pass = "scene color blur",
                                      .inputs = kPictureLevelInputs,
                                      .values = kLevelValues };

// Off the centre of an outer texel, so that no rounding lets the sampler read the one beyond it, even with weight 0.
constexpr float kInset = 0.5f + 1.0f / 64;

Rect rectOfLevel(SceneColorCopy const& copy, uint32_t level) {
    return { copy.rect.x >> level, copy.rect.y >> level, copy.rect.width >> level, copy.rect.height >> level };
}

struct PictureSource {
    TextureId color, depth;
};

void addCopy(FrameGraph& graph, FrameContext const& context, PictureSource const& from, SceneColorCopy const& copy,
             TextureId picture) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = from.color },
                             FullScreenInput{ .name = "depth", .texture = from.depth } };
    const std::array tiles{ FullScreenTile{ .rect = rectOfLevel(copy, 0) } };
    addFullScreenPass(graph, context,
                      { .name = "scene color copy",
                        .material = context.resources.effects->get("scene_color_copy", {}, kCopy),
                        .inputs = inputs,
                        .target = picture,
                        .tiles = tiles,
                        .clears = true });
}

/// The scene colour of the previous frame, reprojected to the surfaces of this one.
void addReprojected(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, TextureId picture) {
    prepare::LastView const& last = context.packet.last;
    float4x4 const& view = context.packet.mainView().uniforms.viewFromWorld;
    const framegraph::GraphTextureDesc desc = graph.texture(picture).desc;
    const double2 perTexel = 1.0 / double2(desc.width, desc.height), end = double2(context.settings().size) * perTexel;
    const double4x4 world = worldFromPixel(context);
    const std::array values{ FullScreenValue{ "lastFromPixel", lastFromPixel(context, end) },
                             FullScreenValue{ "lastAlong", float4(double4(last.alongView) * world) },
                             FullScreenValue{ "along", float4(double4(-view[0].z, -view[1].z, -view[2].z, 0) * world) },
                             FullScreenValue{ "perTexel", float2(perTexel) }, FullScreenValue{ "end", float2(end) } };
    const std::array inputs{ FullScreenInput{ .name = "last",
                                              .texture = targets.sceneColorHistory.previous,
                                              .sampler = context.resources.samplers.bilinear },
                             FullScreenInput{ .name = "depth", .texture = targets.prepassDepth },
                             FullScreenInput{ .name = "motion", .texture = targets.motionVectors } };
    const EffectConstant constants[] = { { "isElsewhere", last.isElsewhere || targets.motionVectors },
                                         { "hasMotion", static_cast<bool>(targets.motionVectors) } };
    addFullScreenPass(
            graph, context,
            { .name = "reprojection",
              .material = context.resources.effects->get("scene_color_reprojection", constants, kReprojection),
              .inputs = inputs,
              .values = values,
              .target = picture });
}

/// From the level before it.
void addBlurred(FrameGraph& graph, FrameContext const& context, SceneColorCopy const& copy, uint8_t level,
                TextureId picture) {
    const Rect from = rectOfLevel(copy, level - 1u);
    const float2 first(from.x, from.y), end = first + float2(from.width, from.height);
    const framegraph::GraphTextureDesc desc = graph.texture(picture).desc;
    const float2 size(desc.width >> (level - 1), desc.height >> (level - 1));
    const std::array values{ FullScreenValue{ "texels", float4(first + kInset, end - kInset) },
                             FullScreenValue{ "perTexel", 1.0f / size } };
    const std::array inputs{ FullScreenInput{ .name = "level",
                                              .texture = picture,
                                              .sampler = context.resources.samplers.bilinear,
                                              .range = backend::oneLevel(static_cast<uint8_t>(level - 1)) } };
    const std::array tiles{ FullScreenTile{ .rect = rectOfLevel(copy, level), .values = values } };
    addFullScreenPass(graph, context,
                      { .name = "scene color blur",
                        .material = context.resources.effects->get("scene_color_blur", {}, kLevel),
                        .inputs = inputs,
                        .target = picture,
                        .level = level,
                        .tiles = tiles,
                        .clears = true });
}

framegraph::GraphTextureDesc pictureDesc(FrameContext const& context, uint8_t levels, std::string_view name) {
    const uint2 size = prepare::pictureTextureSize(context.settings().size);
    return { .width = size.x, .height = size.y, .format = Format::RGBA16F, .levels = levels, .name = name };
}

TextureId createSceneColor(FrameGraph& graph, FrameContext const& context) {
    return graph.createTexture(pictureDesc(context, prepare::pictureLevels(context.settings().size), "scene color"));
}

void addBlurredLevels(FrameGraph& graph, FrameContext const& context, SceneColorCopy const& copy, TextureId picture) {
    for (uint8_t level = 1; level < copy.levels; ++level) addBlurred(graph, context, copy, level, picture);
}

} // namespace

SceneColorCopy wholeSceneColor(FrameContext const& context) {
    const uint2 size = context.settings().size;
    return prepare::copyAround({ float2(0.0f), float2(size) }, size);
}

TextureId addSceneColorCopyPasses(FrameGraph& graph, FrameContext const& context, TextureId color, TextureId depth,
                                  SceneColorCopy const& copy) {
    const TextureId picture = createSceneColor(graph, context);
    addCopy(graph, context, { color, depth }, copy, picture);
    addBlurredLevels(graph, context, copy, picture);
    return picture;
}

void addReflectedSceneColor(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Reflections)) return;
    targets.sceneColorHistory =
            graph.history(pictureDesc(context, 1, "last picture"), {}, !context.packet.last.isReflected);
    if (!targets.sceneColorHistory.previous) return;
    targets.sceneColor = createSceneColor(graph, context);
    addReprojected(graph, context, targets, targets.sceneColor);
    addBlurredLevels(graph, context, wholeSceneColor(context), targets.sceneColor);
}

void keepSceneColor(FrameGraph& graph, FrameContext const& context, FrameTargets const& targets, TextureId color) {
    if (!targets.sceneColorHistory.current) return;
    addCopy(graph, context, { color, targets.prepassDepth }, wholeSceneColor(context),
            targets.sceneColorHistory.current);
}

} // namespace filament_core::passes
