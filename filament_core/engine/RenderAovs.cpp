// SPDX-License-Identifier: Apache-2.0
#include <filament_core/RenderAovs.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/WhatIsShown.h"
#include "filament_core/prepare/NumberObjects.h"
#include "filament_core/prepare/PreparePick.h"
#include "filament_core/scene/SceneNodes.h"

#include <algorithm>
#include <utility>

namespace filament_core {
namespace {

using engine::PublicCall;

Result<std::vector<Image>> drawAovs(Renderer& renderer, Engine& engine, Scene const& scene, View view,
                                    std::span<const Aov> aovs) {
    view.viewport.reset();
    const Owned<Texture> numbers = engine.own(engine.create(TextureDesc{ .format = Format::RGBA32F,
                                                                         .width = view.size.x,
                                                                         .height = view.size.y,
                                                                         .renderable = true,
                                                                         .name = "renderAovs" }));
    if (!numbers.get()) return outOfMemory("render AOVs: no texture");
    const Owned<RenderTarget> target = engine.own(engine.create(RenderTargetDesc{ .color = numbers }));
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
    Renderer renderer(engine);
    return orOutOfMemory("render AOVs", {}, [&] { return drawAovs(renderer, engine, scene, view, aovs); });
}

Result<std::vector<Image>> renderAovs(Renderer& renderer, Scene const& scene, View const& view,
                                      std::span<const Aov> aovs) {
    const PublicCall call(&scene.impl(), "renderAovs(Renderer, Scene, View)");
    Engine& engine = *scene.impl().engine.self;
    return orOutOfMemory("render AOVs", {}, [&] { return drawAovs(renderer, engine, scene, view, aovs); });
}

PickHit objectOf(Scene const& scene, uint32_t objectId) {
    const PublicCall call(&scene.impl(), "objectOf(Scene)");
    scene::SceneData const& data = scene.impl().data;
    const std::optional<uint32_t> at = prepare::positionOf(data.renderables, objectId);
    if (!at) return {};
    const Renderable renderable = data.renderables.index.handleAt(*at);
    const auto shape = std::ranges::find(data.lightShapes, renderable, &scene::LightShape::renderable);
    if (shape != data.lightShapes.end()) return { .light = shape->light, .node = scene::nodeOf(data, shape->light) };
    return { .renderable = renderable,
             .node = scene::nodeOf(data, renderable),
             .primitive = prepare::primitiveOf(data, renderable) };
}

Material materialOf(Scene const& scene, uint32_t materialId) {
    const PublicCall call(&scene.impl(), "materialOf(Scene)");
    return engine::handleOf(scene.impl().engine.materials, engine::materialAt(scene, materialId));
}

MaterialInstance materialInstanceOf(Scene const& scene, uint32_t materialInstanceId) {
    const PublicCall call(&scene.impl(), "materialInstanceOf(Scene)");
    return engine::handleOf(scene.impl().engine.instances, engine::instanceAt(scene, materialInstanceId));
}

ExrLayer layerOf(Aov aov, Image const& image) {
    return { .name = toString(aov), .image = &image, .channels = channelsOf(aov) };
}

} // namespace filament_core
