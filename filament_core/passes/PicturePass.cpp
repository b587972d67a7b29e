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

void addCopy(FrameGraph& graph, FrameContext const& context, TextureId depth, FrameTargets const& targets) {
    const std::array inputs{ FullScreenInput{ .name = "color", .texture = targets.color },
                             FullScreenInput{ .name = "depth", .texture = depth } };
    const std::array tiles{ FullScreenTile{ .rect = rectOfLevel(context.packet.mainView().picture, 0) } };
    addFullScreenPass(graph, context,
                      { .name = "picture",
                        .material = context.resources.effects->get("picture_copy", {}, kCopy),
                        .inputs = inputs,
                        .target = targets.picture,
                        .tiles = tiles,
                        .clears = true });
}

/// From the level before it.
void addBlurred(FrameGraph& graph, FrameContext const& context, uint8_t level, TextureId picture) {
    PictureCopy const& copy = context.packet.mainView().picture;
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

} // namespace

void addPicturePasses(FrameGraph& graph, FrameContext const& context, TextureId depth, FrameTargets& targets) {
    const uint2 size = prepare::pictureTextureSize(context.settings.size);
    targets.picture = graph.createTexture({ .width = size.x,
                                            .height = size.y,
                                            .format = Format::RGBA16F,
                                            .levels = prepare::pictureLevels(context.settings.size),
                                            .name = "picture" });
    addCopy(graph, context, depth, targets);
    for (uint8_t level = 1; level < context.packet.mainView().picture.levels; ++level)
        addBlurred(graph, context, level, targets.picture);
}

} // namespace filament::passes
