// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/PicturePass.h"

#include "filament_core/passes/FullScreenPass.h"

#include <array>

namespace filament::passes {
namespace {

using backend::Format;
using backend::Rect;
using framegraph::FrameGraph;
using framegraph::TextureId;
using prepare::PictureCopy;

constexpr std::string_view kCopyInputs[] = { "color", "depth" };
constexpr FullScreenInterface kCopy{ .pass = "picture", .inputs = kCopyInputs };
constexpr std::string_view kLevelInputs[] = { "level" };
constexpr FullScreenParameter kLevelValues[] = { { "texels", ParameterType::Float4 },
                                                 { "perTexel", ParameterType::Float2 } };
constexpr FullScreenInterface kLevel{ .pass = "picture blur", .inputs = kLevelInputs, .values = kLevelValues };

// Off the centre of an outer texel, so that no rounding lets the sampler read the one beyond it, even with weight 0.
constexpr float kInset = 0.5f + 1.0f / 64;

Rect rectOfLevel(PictureCopy const& copy, uint32_t level) {
    return { copy.rect.x >> level, copy.rect.y >> level, copy.rect.width >> level, copy.rect.height >> level };
}

struct PictureSource {
    TextureId color, depth;
    PictureCopy copy;
};

void addCopy(FrameGraph& graph, FrameContext const& context, PictureSource const& from, TextureId picture) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = from.color },
                             FullScreenInput{ .name = "depth", .texture = from.depth } };
    const std::array tiles{ FullScreenTile{ .rect = rectOfLevel(from.copy, 0) } };
    addFullScreenPass(graph, context,
                      { .name = "picture",
                        .material = context.resources.effects->get("picture_copy", {}, kCopy),
                        .inputs = inputs,
                        .target = picture,
                        .tiles = tiles,
                        .clears = true });
}

/// From the level before it.
void addBlurred(FrameGraph& graph, FrameContext const& context, PictureCopy const& copy, uint8_t level,
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
                      { .name = "picture blur",
                        .material = context.resources.effects->get("picture_blur", {}, kLevel),
                        .inputs = inputs,
                        .target = picture,
                        .level = level,
                        .tiles = tiles,
                        .clears = true });
}

framegraph::GraphTextureDesc pictureDesc(FrameContext const& context, std::string_view name) {
    const uint2 size = prepare::pictureTextureSize(context.settings.size);
    return { .width = size.x,
             .height = size.y,
             .format = Format::RGBA16F,
             .levels = prepare::pictureLevels(context.settings.size),
             .name = name };
}

void addLevels(FrameGraph& graph, FrameContext const& context, PictureSource const& from, TextureId picture) {
    addCopy(graph, context, from, picture);
    for (uint8_t level = 1; level < from.copy.levels; ++level) addBlurred(graph, context, from.copy, level, picture);
}

} // namespace

prepare::PictureCopy wholePicture(FrameContext const& context) {
    const uint2 size = context.settings.size;
    return prepare::copyAround({ float2(0.0f), float2(size) }, size);
}

TextureId addPicturePasses(FrameGraph& graph, FrameContext const& context, TextureId color, TextureId depth,
                           PictureCopy const& copy) {
    const TextureId picture = graph.createTexture(pictureDesc(context, "picture"));
    addLevels(graph, context, { color, depth, copy }, picture);
    return picture;
}

void declareLastPicture(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!context.packet.demand.needs(prepare::Effect::Reflections)) return;
    targets.lastPicture = graph.history(pictureDesc(context, "last picture"));
}

void addLastPicturePasses(FrameGraph& graph, FrameContext const& context, FrameTargets& targets) {
    if (!targets.lastPicture.current) return;
    addLevels(graph, context, { targets.color, targets.prepassDepth, wholePicture(context) },
              targets.lastPicture.current);
}

} // namespace filament::passes
