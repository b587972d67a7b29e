// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ExplainPixel.h>

#include <filament_core/RenderAovs.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/ShareSteps.h"

#include <array>
#include <cstring>

namespace filament_core {
namespace {

using engine::PublicCall;

/// Of the surface, in this order.
constexpr std::array kExplained{ Aov::Normal,   Aov::GeometricNormal, Aov::BaseColor, Aov::Roughness,
                                 Aov::Metallic, Aov::Occlusion,       Aov::Emissive };

std::string nameAbove(Scene const& scene, Node node) {
    while (node && scene.name(node).empty()) node = scene.parent(node);
    return node ? scene.name(node) : std::string();
}

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

void nameMaterial(Scene const& scene, PixelSurface& surface) {
    scene::Renderables const& renderables = scene.impl().upToDate().renderables;
    if (!surface.renderable) return;
    const uint32_t drawable = renderables.drawable[renderables.index.at(surface.renderable)];
    scene::MaterialInstance const* const instance = renderables.drawables[drawable].material;
    if (!instance) return;
    surface.instance = instance->name;
    surface.material = instance->material->name;
}

Result<std::optional<PixelSurface>> surfaceAt(Engine& engine, Scene const& scene, View const& view, uint2 pixel) {
    Renderer renderer(engine);
    const Result<PickHit> hit = renderer.waitPick(renderer.pick(scene, view, pixel));
    if (!hit) return hit.error();
    if (!*hit) return std::optional<PixelSurface>();
    PixelSurface surface{ .renderable = hit->renderable,
                          .light = hit->light,
                          .object = nameAbove(scene, hit->node),
                          .primitive = hit->primitive,
                          .distanceMeters = hit->distanceMeters,
                          .positionWorld = hit->positionWorld };
    nameMaterial(scene, surface);
    const Result<std::vector<Image>> numbers = renderAovs(engine, scene, view, kExplained);
    if (!numbers) return numbers.error();
    const auto at = [&](size_t i) { return valueAt((*numbers)[i], pixel); };
    surface.normal = at(0), surface.geometricNormal = at(1), surface.baseColor = at(2);
    surface.roughness = numberOf(at(3)), surface.metallic = numberOf(at(4)), surface.occlusion = numberOf(at(5));
    surface.emissive = at(6);
    return std::optional(std::move(surface));
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
    return explanation;
}

} // namespace

Result<PixelExplanation> explainPixel(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                                      ShareOptions const& options) {
    const PublicCall call(engine, "explainPixel(Engine, Scene, View)");
    return orOutOfMemory("explain pixel", {}, [&] { return explained(engine, scene, view, pixel, options); });
}

} // namespace filament_core
