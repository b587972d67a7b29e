// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ExplainPixel.h>

#include <filament_core/RenderAovs.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/MaterialShares.h"
#include "filament_core/engine/ShareSteps.h"
#include "filament_core/engine/WhatIsShown.h"

#include <array>
#include <cstring>

namespace filament_core {
namespace {

using engine::PublicCall;

/// Of the surface, in this order.
constexpr std::array kExplained{ Aov::Normal,     Aov::GeometricNormal,    Aov::BaseColor, Aov::Roughness,
                                 Aov::Metallic,   Aov::Occlusion,          Aov::Emissive,  Aov::ObjectId,
                                 Aov::MaterialId, Aov::MaterialInstanceId, Aov::TriangleId };

/// None: the material has no such number.
std::optional<float3> valueAt(Image const& image, uint2 pixel) {
    float4 value;
    const size_t at = size_t{ pixel.y } * image.width + pixel.x;
    std::memcpy(&value, image.pixels.data() + at * sizeof(value), sizeof(value));
    if (value.w != 1) return std::nullopt;
    return float3(value);
}

std::optional<float> numberOf(std::optional<float3> const& value) {
    return value ? std::optional(value->x) : std::nullopt;
}

std::optional<uint32_t> idOf(std::optional<float3> const& value) {
    return value ? std::optional(static_cast<uint32_t>(value->x)) : std::nullopt;
}

Result<std::optional<PixelSurface>> surfaceAt(Engine& engine, Scene const& scene, View const& view, uint2 pixel) {
    Renderer renderer(engine);
    const Result<PickHit> hit = renderer.waitPick(renderer.pick(scene, view, pixel));
    if (!hit) return hit.error();
    if (!*hit) return std::optional<PixelSurface>();
    PixelSurface surface{ .renderable = hit->renderable,
                          .light = hit->light,
                          .object = engine::nameAbove(scene, hit->node),
                          .primitive = hit->primitive,
                          .distanceMeters = hit->distanceMeters,
                          .positionWorld = hit->positionWorld };
    if (scene::MaterialInstance const* const shown = engine::shownInstance(scene, surface.renderable)) {
        surface.instance = shown->name;
        surface.material = shown->material->name;
    }
    const Result<std::vector<Image>> numbers = renderAovs(engine, scene, view, kExplained);
    if (!numbers) return numbers.error();
    const auto at = [&](size_t i) { return valueAt((*numbers)[i], pixel); };
    surface.normal = at(0), surface.geometricNormal = at(1), surface.baseColor = at(2);
    surface.roughness = numberOf(at(3)), surface.metallic = numberOf(at(4)), surface.occlusion = numberOf(at(5));
    surface.emissive = at(6);
    surface.objectId = idOf(at(7)), surface.materialId = idOf(at(8)), surface.materialInstanceId = idOf(at(9));
    surface.triangleId = idOf(at(10));
    return std::optional(std::move(surface));
}

/// By lobe and by texture of the pixel's material instance. `last`: the step that is the picture, whose pixel `at` has
/// the bits `whole`.
Result<void> addMaterial(Engine& engine, Scene const& scene, engine::ShareStep const& last, uint32_t frames, size_t at,
                         std::array<uint16_t, 4> const& whole, PixelExplanation& explanation) {
    auto& instances = engine.impl().instances;
    const MaterialInstance handle =
            engine::handleOf(instances, engine::shownInstance(scene, explanation.surface->renderable));
    if (!handle) return {};
    const engine::DrawPixel draw = [&]() -> Result<std::array<uint16_t, 4>> {
        std::array<uint16_t, 4> halves{};
        const Result<void> drawn = engine::drawShares(engine, scene, std::span(&last, 1), frames,
                                                      [&](Image&& image) { halves = engine::halvesAt(image, at); });
        return drawn ? Result<std::array<uint16_t, 4>>(halves) : drawn.error();
    };
    Result<std::vector<PixelLobe>> lobes = engine::pixelLobes(engine, handle, *explanation.surface, whole, draw);
    if (!lobes) return lobes.error();
    explanation.lobes = std::move(*lobes);
    Result<std::vector<PixelTexture>> textures = engine::pixelTextures(engine, handle, whole, draw);
    if (!textures) return textures.error();
    explanation.textures = std::move(*textures);
    return engine::readTexels(engine, scene, last.view, explanation.pixel, handle, *explanation.surface,
                              explanation.textures);
}

Result<PixelExplanation> explained(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                                   ShareOptions const& options) {
    FILAMENT_ASSERT(pixel.x < view.size.x && pixel.y < view.size.y, "a pixel to explain lies in its view");
    const std::vector<engine::ShareStep> steps = engine::shareSteps(scene, view, options);
    const size_t at = size_t{ pixel.y } * view.size.x + pixel.x;
    PixelExplanation explanation{ .pixel = pixel };
    std::array<uint16_t, 4> before{};
    const Result<void> drawn = engine::drawShares(engine, scene, steps, options.frames, [&](Image&& image) {
        const std::array<uint16_t, 4> after = engine::halvesAt(image, at);
        explanation.terms.push_back({ steps[explanation.terms.size()].term, engine::shareOf(before, after) });
        before = after;
    });
    if (!drawn) return drawn.error();
    explanation.value = engine::shareOf({}, before);
    View whole = steps.back().view;
    Result<std::optional<PixelSurface>> surface = surfaceAt(engine, scene, whole, pixel);
    if (!surface) return surface.error();
    explanation.surface = std::move(*surface);
    if (!explanation.surface) return explanation;
    if (Result<void> added = addMaterial(engine, scene, steps.back(), options.frames, at, before, explanation); !added)
        return added.error();
    return explanation;
}

} // namespace

Result<PixelExplanation> explainPixel(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                                      ShareOptions const& options) {
    const PublicCall call(engine, "explainPixel(Engine, Scene, View)");
    return orOutOfMemory("explain pixel", {}, [&] { return explained(engine, scene, view, pixel, options); });
}

} // namespace filament_core
