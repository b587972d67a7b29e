// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/LightFields.h"

#include <filament_core/Options.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace filament_core::view {
namespace {

constexpr std::array<std::string_view, kLightKinds> kKindNames{ "sun", "point", "spot", "rectangle", "disc", "tube" };
constexpr float kMostMeters = 1e4f, kMostIntensity = 1e9f;

struct FieldList {
    std::vector<LightField> fields;

    void number(std::string_view name, float& value, float least, float most, bool isLogarithmic = false) {
        fields.push_back({ name, LightFieldKind::Number, &value, least, most, isLogarithmic });
    }
    /// Of the sun, with the range of its option.
    void option(std::string_view name, float& value, std::string_view optionName, bool isLogarithmic = false) {
        Option const& option = *findOption(optionsOf<SunLight>(), optionName);
        number(name, value, static_cast<float>(option.least), static_cast<float>(option.most), isLogarithmic);
    }
    void meters(std::string_view name, float& value, float least = 0) { number(name, value, least, kMostMeters, true); }
    void flag(std::string_view name, bool& value) { fields.push_back({ name, LightFieldKind::Switch, &value }); }
    void place(double3& value) { fields.push_back({ "position, m", LightFieldKind::Place, &value }); }
    void direction(std::string_view name, float3& value) {
        fields.push_back({ name, LightFieldKind::Direction, &value });
    }
    void color(LinearColor& value) { fields.push_back({ "colour", LightFieldKind::Color, &value }); }
    void channels(LightChannels& value) { fields.push_back({ "channels", LightFieldKind::Channels, &value }); }

    void add(SunLight& light) {
        direction("direction", light.directionWorld);
        number("illuminance, lx", light.illuminance.value, 0, kMostIntensity, true);
        color(light.color);
        option("half angle, degrees", light.angularRadiusDegrees, "angularRadiusDegrees");
        flag("shows its disc", light.showsDisc);
        option("halo size", light.haloSize, "haloSize", true);
        option("halo falloff", light.haloFalloff, "haloFalloff", true);
        flag("casts shadows", light.castsShadows);
        flag("contact shadows", light.contactShadows);
        channels(light.lightChannels);
    }
    void add(PointLight& light) {
        place(light.positionWorld);
        addPunctual(light);
    }
    void add(SpotLight& light) {
        place(light.positionWorld);
        direction("direction", light.directionWorld);
        number("inner cone, radians", light.innerConeRadians, 0, std::max(light.outerConeRadians - kLeastCone, 0.0f));
        number("outer cone, radians", light.outerConeRadians, std::min(light.innerConeRadians + kLeastCone, kMostCone),
               kMostCone);
        addPunctual(light);
    }
    void addPunctual(auto& light) {
        number("intensity, cd", light.intensity.value, 0, kMostIntensity, true);
        color(light.color);
        meters("range, m", light.rangeMeters);
        meters("source radius, m", light.sourceRadiusMeters);
        flag("casts shadows", light.castsShadows);
        flag("contact shadows", light.contactShadows);
        channels(light.lightChannels);
    }
    void add(RectLight& light) {
        place(light.positionWorld);
        direction("direction", light.directionWorld);
        direction("up", light.upWorld);
        meters("width, m", light.widthMeters);
        meters("height, m", light.heightMeters);
        addArea(light);
        flag("two sided", light.isTwoSided);
    }
    void add(DiscLight& light) {
        place(light.positionWorld);
        direction("direction", light.directionWorld);
        meters("radius, m", light.radiusMeters);
        addArea(light);
        flag("two sided", light.isTwoSided);
    }
    void add(TubeLight& light) {
        place(light.positionWorld);
        direction("axis", light.axisWorld);
        meters("length, m", light.lengthMeters);
        meters("radius, m", light.radiusMeters);
        addArea(light);
    }
    void addArea(auto& light) {
        number("luminance, cd/m^2", light.luminance.value, 0, kMostIntensity, true);
        color(light.color);
        meters("range, m", light.rangeMeters);
        flag("casts shadows", light.castsShadows);
        flag("visible", light.isVisible);
        channels(light.lightChannels);
    }
};

template <size_t... Kinds>
LightDesc lightOfKind(size_t kind, std::index_sequence<Kinds...>) {
    LightDesc light;
    ((kind == Kinds ? void(light.emplace<Kinds>()) : void()), ...);
    return light;
}

std::string freeName(Document const& document, std::string_view base) {
    const auto isTaken = [&](std::string const& name) {
        return std::ranges::find(document.lights, name, &DocumentLight::name) != document.lights.end();
    };
    std::string name(base);
    for (int i = 2; isTaken(name); ++i) name = fmt::format("{} {}", base, i);
    return name;
}

void copyShared(std::vector<LightField> const& from, std::vector<LightField> const& to) {
    for (LightField const& target : to) {
        for (LightField const& source : from) {
            if (source.name != target.name || source.value.index() != target.value.index()) continue;
            std::visit([&](auto* value) { *value = *std::get<std::remove_cvref_t<decltype(value)>>(source.value); },
                       target.value);
        }
    }
}

} // namespace

std::vector<LightField> lightFields(LightDesc& light) {
    FieldList list;
    std::visit([&](auto& held) { list.add(held); }, light);
    return std::move(list.fields);
}

std::string_view lightKindName(size_t kind) { return kind < kKindNames.size() ? kKindNames[kind] : "light"; }

DocumentLight& addLight(Document& document, size_t kind, Camera const& camera) {
    DocumentLight light{ .name = freeName(document, lightKindName(kind)),
                         .light = lightOfKind(kind, std::make_index_sequence<kLightKinds>()) };
    const double3 forward = -double3(camera.worldFromView[2]);
    for (LightField const& field : lightFields(light.light)) {
        if (field.kind == LightFieldKind::Place) *std::get<double3*>(field.value) = camera.position() + forward;
        if (field.name == "direction") *std::get<float3*>(field.value) = float3(forward);
    }
    document.lights.push_back(std::move(light));
    return document.lights.back();
}

void removeLight(Document& document, size_t light) {
    if (light < document.lights.size()) document.lights.erase(document.lights.begin() + static_cast<ptrdiff_t>(light));
}

DocumentLight& copyLight(Document& document, size_t light) {
    DocumentLight copy = document.lights[light];
    copy.name = freeName(document, copy.name);
    document.lights.push_back(std::move(copy));
    return document.lights.back();
}

LightDesc withKind(LightDesc const& light, size_t kind) {
    LightDesc before = light;
    LightDesc after = lightOfKind(kind, std::make_index_sequence<kLightKinds>());
    copyShared(lightFields(before), lightFields(after));
    return after;
}

} // namespace filament_core::view
