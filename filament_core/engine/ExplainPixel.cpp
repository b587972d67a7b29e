// SPDX-License-Identifier: Apache-2.0
#include <filament_core/ExplainPixel.h>

#include <filament_core/RenderAovs.h>

#include "base/OutOfMemory.h"
#include "filament_core/engine/ShareSteps.h"
#include "filament_core/engine/WhatIsShown.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

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

// ---- lobes

/// In the order in which they are switched on, after the specular one; by one of the two parameters.
struct LobeParameters {
    std::string_view name, parameter, other;
};
constexpr std::array kLobes{ LobeParameters{ "diffuse", "baseColorFactor", "baseColor" },
                             LobeParameters{ "diffuseTransmission", "diffuseTransmission" },
                             LobeParameters{ "transmission", "transmission" },
                             LobeParameters{ "sheen", "sheenColor" },
                             LobeParameters{ "clearCoat", "clearCoat" },
                             LobeParameters{ "iridescence", "iridescence" },
                             LobeParameters{ "emission", "emissiveFactor", "emissive" } };

/// Of vectors red, green and blue: alpha stays.
size_t factorBytes(ParameterType type) {
    switch (type) {
    case ParameterType::Float:
        return sizeof(float);
    case ParameterType::Float3:
    case ParameterType::Float4:
        return sizeof(float3);
    default:
        return 0;
    }
}

/// The base colour of what is not metal is its diffuse one, and of metal its specular one.
std::string nameOf(LobeParameters const& lobe, PixelSurface const& surface) {
    const bool isOfBase = lobe.name == "diffuse";
    const bool isDiffuse = surface.roughness && surface.metallic.value_or(0) == 0;
    return std::string(isOfBase && !isDiffuse ? "baseColor" : lobe.name);
}

/// Changes the factors of one instance, and gives them back.
class SwitchedInstance {
public:
    SwitchedInstance(Engine::Impl& engine, MaterialInstance handle)
            : mEngine(engine), mHandle(handle), mInstance(engine.instances.get(handle)),
              mParameters(mInstance.parameters), mChanges(engine.instanceChanges) {}
    ~SwitchedInstance() {
        set(mParameters);
        mEngine.instanceChanges = mChanges; // nothing has changed
    }
    SwitchedInstance(SwitchedInstance const&) = delete;
    SwitchedInstance& operator=(SwitchedInstance const&) = delete;

    /// Those that the instance has, and that are not 0.
    std::vector<LobeParameters const*> lobes() const {
        std::vector<LobeParameters const*> found;
        for (LobeParameters const& lobe : kLobes)
            if (!factorOf(lobe).empty()) found.push_back(&lobe);
        return found;
    }

    void switchOff(std::span<LobeParameters const* const> off) {
        std::vector<std::byte> parameters = mParameters;
        for (LobeParameters const* lobe : off) {
            const std::span<const std::byte> factor = factorOf(*lobe);
            std::memset(parameters.data() + (factor.data() - mParameters.data()), 0, factor.size());
        }
        set(parameters);
    }

private:
    std::span<const std::byte> factorOf(LobeParameters const& lobe) const {
        for (const std::string_view name : { lobe.parameter, lobe.other }) {
            shader::Parameter const* const found =
                    name.empty() ? nullptr : mInstance.material->package.findParameter(name);
            const size_t bytes = found && found->arraySize == 0 ? factorBytes(found->type) : 0;
            if (bytes == 0 || found->offset + bytes > mParameters.size()) continue;
            const std::span<const std::byte> factor = std::span(mParameters).subspan(found->offset, bytes);
            if (std::ranges::any_of(factor, [](std::byte byte) { return byte != std::byte{ 0 }; })) return factor;
        }
        return {};
    }

    void set(std::vector<std::byte> const& parameters) {
        mEngine.markDirty(mHandle);
        std::ranges::copy(parameters, mInstance.parameters.begin());
        mInstance.parametersDirty = true;
    }

    Engine::Impl& mEngine;
    MaterialInstance mHandle;
    scene::MaterialInstance& mInstance;
    const std::vector<std::byte> mParameters;
    uint64_t mChanges;
};

/// What the lobes of the pixel's material add to the picture, by drawing it with some of them switched off: each is the
/// difference that a parameter made, so that their sum is the picture's half floats. `last`: the step that is the
/// picture, whose pixel `at` has the bits `whole`.
Result<std::vector<PixelLobe>> pixelLobes(Engine& engine, Scene const& scene, engine::ShareStep const& last,
                                          uint32_t frames, size_t at, std::array<uint16_t, 4> const& whole,
                                          PixelSurface const& surface) {
    std::vector<PixelLobe> terms;
    auto& instances = engine.impl().instances;
    const MaterialInstance handle = engine::handleOf(instances, engine::shownInstance(scene, surface.renderable));
    if (!instances.isLive(handle)) return terms;
    SwitchedInstance instance(engine.impl(), handle);
    std::vector<LobeParameters const*> off = instance.lobes();
    // All that metal reflects has the base colour.
    if (surface.metallic == 1.0f) std::erase_if(off, [](auto const* lobe) { return lobe->name == "diffuse"; });
    std::string name = off.empty() ? "all" : surface.roughness ? "specular" : "rest"; // unlit ones reflect nothing
    std::array<uint16_t, 4> before{};
    while (!off.empty()) {
        instance.switchOff(off);
        std::array<uint16_t, 4> after{};
        const Result<void> drawn = engine::drawShares(engine, scene, std::span(&last, 1), frames,
                                                      [&](Image&& image) { after = engine::halvesAt(image, at); });
        if (!drawn) return drawn.error();
        terms.push_back({ std::move(name), engine::shareOf(before, after) });
        before = after;
        name = nameOf(*off.front(), surface);
        off.erase(off.begin());
    }
    terms.push_back({ std::move(name), engine::shareOf(before, whole) });
    return terms;
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
    Result<std::vector<PixelLobe>> lobes =
            pixelLobes(engine, scene, steps.back(), options.frames, at, before, *explanation.surface);
    if (!lobes) return lobes.error();
    explanation.lobes = std::move(*lobes);
    return explanation;
}

} // namespace

Result<PixelExplanation> explainPixel(Engine& engine, Scene const& scene, View const& view, uint2 pixel,
                                      ShareOptions const& options) {
    const PublicCall call(engine, "explainPixel(Engine, Scene, View)");
    return orOutOfMemory("explain pixel", {}, [&] { return explained(engine, scene, view, pixel, options); });
}

} // namespace filament_core
