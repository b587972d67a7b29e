// SPDX-License-Identifier: Apache-2.0
#include <filament_core/RenderAovs.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/EngineImpl.h"

#include <utility>

namespace filament_core {
namespace {

using engine::PublicCall;

Result<std::vector<Image>> drawAovs(Engine& engine, Scene const& scene, View view, std::span<const Aov> aovs) {
    const Owned<Texture> numbers = engine.own(engine.create(TextureDesc{ .format = Format::RGBA32F,
                                                                         .width = view.size.x,
                                                                         .height = view.size.y,
                                                                         .renderable = true,
                                                                         .name = "renderAovs" }));
    if (!numbers.get()) return outOfMemory("render AOVs: no texture");
    const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = numbers }));
    Renderer renderer(engine);
    std::vector<PixelTicket> tickets;
    for (const Aov aov : aovs) {
        FILAMENT_ASSERT(aov != Aov::None, "renderAovs() takes AOVs other than None");
        view.aov = aov;
        renderer.render(scene, view, target);
        tickets.push_back(renderer.readPixels(target));
    }
    std::vector<Image> images;
    for (const PixelTicket ticket : tickets) {
        Result<Image> image = renderer.waitPixels(ticket);
        if (!image) return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

} // namespace

Result<std::vector<Image>> renderAovs(Engine& engine, Scene const& scene, View const& view, std::span<const Aov> aovs) {
    const PublicCall call(engine, "renderAovs(Engine, Scene, View)");
    View whole = view;
    whole.viewport.reset();
    return orOutOfMemory("render AOVs", {}, [&] { return drawAovs(engine, scene, whole, aovs); });
}

ExrLayer layerOf(Aov aov, Image const& image) {
    return { .name = toString(aov), .image = &image, .channels = channelsOf(aov) };
}

} // namespace filament_core
