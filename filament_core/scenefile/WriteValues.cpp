// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/WriteValues.h"

#include "filament_core/scenefile/ReadOptions.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

namespace filament_core::scenefile {
namespace {

Json json(bool value) { return value; }
Json json(uint32_t value) { return value; }
Json json(double value) { return value; }
/// The fewest digits that give the number again. What is no number becomes a text, which no reader takes.
Json json(float value) {
    const std::string text = fmt::format("{}", value);
    Json parsed = Json::parse(text, nullptr, false);
    return parsed.is_discarded() ? Json(text) : parsed;
}
template <int N, class T>
Json json(glm::vec<N, T> const& value) {
    Json list = Json::array();
    for (int i = 0; i < N; ++i) list.push_back(json(value[i]));
    return list;
}
Json bitsJson(uint8_t bits) {
    Json list = Json::array();
    for (uint32_t i = 0; i < 8; ++i)
        if ((bits >> i & 1u) != 0) list.push_back(i);
    return list;
}

/// Sets what differs from the default, and removes what does not.
template <class T>
void put(Json& object, const char* key, T const& value, T const& byDefault) {
    if (value != byDefault)
        object[key] = json(value);
    else
        object.erase(key);
}

template <class L>
void putShared(Json& object, L const& light) {
    const L defaults{};
    put(object, "color", light.color, defaults.color);
    put(object, "castsShadows", light.castsShadows, defaults.castsShadows);
    if constexpr (requires { light.contactShadows; })
        put(object, "contactShadows", light.contactShadows, defaults.contactShadows);
    if constexpr (requires { light.rangeMeters; }) put(object, "range", light.rangeMeters, defaults.rangeMeters);
    if constexpr (requires { light.sourceRadiusMeters; })
        put(object, "sourceRadius", light.sourceRadiusMeters, defaults.sourceRadiusMeters);
    if constexpr (requires { light.isVisible; }) put(object, "visible", light.isVisible, defaults.isVisible);
    if constexpr (requires { light.isTwoSided; }) put(object, "twoSided", light.isTwoSided, defaults.isTwoSided);
    if (light.lightChannels != kDefaultLightChannels) object["channels"] = bitsJson(light.lightChannels);
}

float degrees(float radians) { return static_cast<float>(glm::degrees(static_cast<double>(radians))); }

Json lightJson(SunLight const& light) {
    const SunLight defaults;
    Json object{ { "direction", json(light.directionWorld) }, { "lux", json(light.illuminance.value) } };
    put(object, "angularRadiusDegrees", light.angularRadiusDegrees, defaults.angularRadiusDegrees);
    put(object, "showsDisc", light.showsDisc, defaults.showsDisc);
    put(object, "haloSize", light.haloSize, defaults.haloSize);
    put(object, "haloFalloff", light.haloFalloff, defaults.haloFalloff);
    return object;
}

Json lightJson(PointLight const& light) {
    return { { "at", json(light.positionWorld) }, { "candela", json(light.intensity.value) } };
}

Json lightJson(SpotLight const& light) {
    return { { "at", json(light.positionWorld) },
             { "direction", json(light.directionWorld) },
             { "candela", json(light.intensity.value) },
             { "innerDegrees", json(degrees(light.innerConeRadians)) },
             { "outerDegrees", json(degrees(light.outerConeRadians)) } };
}

Json lightJson(RectLight const& light) {
    Json object{ { "at", json(light.positionWorld) },
                 { "direction", json(light.directionWorld) },
                 { "nits", json(light.luminance.value) },
                 { "width", json(light.widthMeters) },
                 { "height", json(light.heightMeters) } };
    put(object, "up", light.upWorld, RectLight{}.upWorld);
    return object;
}

Json lightJson(DiscLight const& light) {
    return { { "at", json(light.positionWorld) },
             { "direction", json(light.directionWorld) },
             { "nits", json(light.luminance.value) },
             { "radius", json(light.radiusMeters) } };
}

Json lightJson(TubeLight const& light) {
    return { { "at", json(light.positionWorld) },
             { "axis", json(light.axisWorld) },
             { "nits", json(light.luminance.value) },
             { "length", json(light.lengthMeters) },
             { "radius", json(light.radiusMeters) } };
}

/// The member, an empty object at first; it goes if it stays empty.
template <class Write>
void within(Json& tree, const char* key, Write const& write) {
    Json& object = tree[key];
    if (!object.is_object()) object = Json::object();
    write(object);
    if (object.empty()) tree.erase(key);
}

template <HasOptions T>
void putOptions(Json& object, T const& value, T const& defaults) {
    for (Option const& option : optionsOf<T>()) {
        const std::string key(option.name);
        if (optionValue(option, &value) != optionValue(option, &defaults))
            object[key] = optionJson(option, &value);
        else
            object.erase(key);
    }
}

} // namespace

const char* listOf(LightDesc const& light) {
    constexpr const char* kLists[] = { "suns", "points", "spots", "rects", "discs", "tubes" };
    static_assert(std::variant_size_v<LightDesc> == std::size(kLists));
    return kLists[light.index()];
}

Json toJson(LightDesc const& light) {
    return std::visit(
            [](auto const& one) {
                Json object = lightJson(one);
                putShared(object, one);
                return object;
            },
            light);
}

void writeCamera(Json& tree, Camera const& camera, double3 const& origin) {
    const Lens defaults = SceneFileCamera{}.lens;
    const double3 eye = camera.position() - origin, back(camera.worldFromView[2]), up(camera.worldFromView[1]);
    within(tree, "camera", [&](Json& object) {
        object["eye"] = json(eye);
        object["at"] = json(eye - back);
        put(object, "up", up, double3(0, 1, 0));
        put(object, "fovDegrees", camera.lens.verticalFovDegrees, defaults.verticalFovDegrees);
        put(object, "near", camera.lens.nearMeters, defaults.nearMeters);
        put(object, "orthographicHeight", camera.lens.orthographicHeight, defaults.orthographicHeight);
        put(object, "far", camera.lens.farMeters, defaults.farMeters);
        put(object, "shift", camera.lens.shift, defaults.shift);
        put(object, "aspect", camera.lens.aspect, defaults.aspect);
    });
    const Exposure usual;
    within(tree, "exposure", [&](Json& object) {
        put(object, "aperture", camera.exposure.aperture, usual.aperture);
        put(object, "shutter", camera.exposure.shutterSeconds, usual.shutterSeconds);
        put(object, "iso", camera.exposure.iso, usual.iso);
    });
}

void writeView(Json& tree, View const& view, View const& defaults) {
    within(tree, "view", [&](Json& object) {
        put(object, "size", view.size, defaults.size);
        put(object, "samples", uint32_t{ view.samples }, uint32_t{ defaults.samples });
        put(object, "occlusionCulling", view.occlusionCulling, defaults.occlusionCulling);
        put(object, "lod.pixels", view.lod.pixels, defaults.lod.pixels);
        put(object, "clear", view.clearColor, defaults.clearColor);
        object.erase("debugView");
        if (view.debugView != defaults.debugView) object["debugView"] = toString(view.debugView);
        object.erase("layers");
        if (view.visibleLayers != defaults.visibleLayers) object["layers"] = bitsJson(view.visibleLayers);
        putOptions(object, view.section, defaults.section);
        putOptions(object, view.display, defaults.display);
    });
    within(tree, "quality", [&](Json& object) { putOptions(object, view.quality, defaults.quality); });
    within(tree, "effects", [&](Json& object) { putOptions(object, view.effects, defaults.effects); });
}

} // namespace filament_core::scenefile
