// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scenefile/ReadLights.h"

#include <filament_core/Options.h>
#include <filament_core/Photometry.h>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace filament_core::scenefile {
namespace {

constexpr double kFarthestRange = 1e12, kBrightestLight = 1e9;

void readDirection(JsonReader& reader, float3& direction) {
    reader.read("direction", direction);
    if (direction == float3(0.0f)) reader.complain("direction", "expected one that is not zero");
}

/// A temperature in kelvin, of a lamp or of daylight, times a colour.
void readColor(JsonReader& reader, LinearColor& color) {
    reader.read("color", color);
    if (!(std::min({ color.x, color.y, color.z }) >= 0) || std::max({ color.x, color.y, color.z }) > 1e9f) {
        reader.complain("color", "expected 3 numbers from 0 to 1e9");
        color = LinearColor(1.0f);
    }
    if (reader.has("kelvin") && reader.has("daylightKelvin"))
        reader.complain("daylightKelvin", "a light has one temperature: leave out 'kelvin'");
    double kelvin = 0, daylight = 0;
    reader.read("kelvin", kelvin, 1000, 15'000);
    reader.read("daylightKelvin", daylight, 4000, 25'000);
    if (kelvin > 0) color *= color::fromTemperature(static_cast<float>(kelvin));
    if (daylight > 0) color *= color::fromDaylight(static_cast<float>(daylight));
}

/// Lumens, or watts and their efficacy; false if there are none.
bool readPower(JsonReader& reader, Lumen& power) {
    double lumens = 0, watts = 0, perWatt = static_cast<double>(efficacy::kLed.value);
    reader.read("lumens", lumens, 0, kBrightestLight);
    reader.read("watts", watts, 0, kBrightestLight);
    reader.read("lumensPerWatt", perWatt, 0, static_cast<double>(efficacy::kGreatest.value));
    power = { static_cast<float>(lumens) };
    if (reader.has("watts")) {
        power = luminousPower(Watt{ static_cast<float>(watts) }, LumensPerWatt{ static_cast<float>(perWatt) });
    } else if (reader.has("lumensPerWatt")) {
        reader.complain("lumensPerWatt", "belongs to 'watts'");
    }
    return reader.has("lumens") || reader.has("watts");
}

/// In one of the units of lamps; `fromPower` converts lumens.
template <class FromPower>
void readIntensity(JsonReader& reader, Candela& intensity, FromPower const& fromPower) {
    reader.read("candela", intensity.value, 0, kBrightestLight);
    Lumen power;
    if (readPower(reader, power)) intensity = fromPower(power);
    double lux = 0, meters = 1;
    reader.read("lux", lux, 0, kBrightestLight);
    reader.read("luxAtMeters", meters, 1e-3, 1e4);
    if (reader.has("lux")) {
        intensity = intensityFor(Lux{ static_cast<float>(lux) }, static_cast<float>(meters));
    } else if (reader.has("luxAtMeters")) {
        reader.complain("luxAtMeters", "belongs to 'lux'");
    }
    constexpr std::array kUnits{ "candela", "lumens", "watts", "lux" };
    if (std::ranges::count_if(kUnits, [&](const char* unit) { return reader.has(unit); }) > 1)
        reader.complain("candela", "a lamp has one intensity: candela, lumens, watts or lux");
}

template <class L>
void readShared(JsonReader& reader, L& light) {
    readColor(reader, light.color);
    reader.read("castsShadows", light.castsShadows);
    if constexpr (requires { light.contactShadows; }) reader.read("contactShadows", light.contactShadows);
    readLightChannels(reader, light.lightChannels);
}

template <class L>
void readPlace(JsonReader& reader, L& light) {
    reader.read("at", light.positionWorld);
    reader.read("range", light.rangeMeters, 0, kFarthestRange);
    reader.read("sourceRadius", light.sourceRadiusMeters, 0, kFarthestRange);
    readShared(reader, light);
}

void readCookie(JsonReader& reader, SceneFileLight& files, LightImageShape shape) {
    reader.read("cookie", files.image);
    files.imageShape = shape;
}

/// Returns whether the light has a profile or a cookie.
template <class L>
bool readProfile(JsonReader& reader, L& light, SceneFileLight& files, LightImageShape shape) {
    reader.read("profile", files.profile);
    readCookie(reader, files, shape);
    const bool isTurned = !files.profile.empty() || !files.image.empty();
    if (!isTurned && reader.has("up")) reader.complain("up", "belongs to 'profile' or 'cookie'");
    reader.read("up", light.upWorld);
    return isTurned;
}

template <class AreaLight>
void readArea(JsonReader& reader, AreaLight& light) {
    reader.read("at", light.positionWorld);
    reader.read("nits", light.luminance.value, 0, kBrightestLight);
    reader.read("range", light.rangeMeters, 0, kFarthestRange);
    readShared(reader, light);
    reader.read("visible", light.isVisible);
    if constexpr (requires { light.isTwoSided; }) {
        readDirection(reader, light.directionWorld);
        reader.read("twoSided", light.isTwoSided);
    }
}

} // namespace

void readBits(JsonReader& reader, const char* name, uint8_t& bits) {
    Json const* list =
            reader.raw(name, R"({"type": "array", "items": {"type": "integer", "minimum": 0, "maximum": 7}})");
    if (!list) return;
    const auto isBit = [](Json const& j) { return j.is_number_unsigned() && j.get<uint64_t>() < 8; };
    if (!list->is_array() || !std::all_of(list->begin(), list->end(), isBit))
        return reader.complain(name, "expected a list of numbers from 0 to 7");
    bits = 0;
    for (Json const& bit : *list) bits = static_cast<uint8_t>(bits | 1u << bit.get<uint32_t>());
}

void readLightChannels(JsonReader& reader, LightChannels& channels) { readBits(reader, "channels", channels); }

void readSun(JsonReader& reader, SceneFileLight& read) {
    SunLight sun;
    readDirection(reader, sun.directionWorld);
    reader.read("lux", sun.illuminance.value, 0, kBrightestLight);
    for (auto const& [name, value] :
         { std::pair("angularRadiusDegrees", &sun.angularRadiusDegrees), std::pair("haloSize", &sun.haloSize),
           std::pair("haloFalloff", &sun.haloFalloff) }) {
        Option const& option = *findOption(optionsOf<SunLight>(), name);
        reader.read(name, *value, option.least, option.most);
    }
    reader.read("showsDisc", sun.showsDisc);
    readCookie(reader, read, LightImageShape::Tiled);
    for (const char* key : { "up", "cookieMeters", "cookieOffset" })
        if (read.image.empty() && reader.has(key)) reader.complain(key, "belongs to 'cookie'");
    reader.read("up", sun.upWorld);
    reader.read("cookieMeters", sun.cookieMeters, 1e-3, 1e9);
    reader.read("cookieOffset", sun.cookieOffsetMeters);
    readShared(reader, sun);
    read.light = sun;
}

void readPoint(JsonReader& reader, SceneFileLight& read) {
    PointLight light;
    readPlace(reader, light);
    const bool isTurned = readProfile(reader, light, read, LightImageShape::Octahedron);
    if (isTurned || reader.isDescribing())
        readDirection(reader, light.directionWorld);
    else if (reader.has("direction"))
        reader.complain("direction", "belongs to 'profile' or 'cookie'");
    bool isCube = false;
    reader.read("cookieIsCube", isCube);
    if (isCube) read.imageShape = LightImageShape::Cube;
    readIntensity(reader, light.intensity, pointIntensity);
    read.light = light;
}

void readSpot(JsonReader& reader, SceneFileLight& read) {
    SpotLight light;
    readPlace(reader, light);
    readDirection(reader, light.directionWorld);
    readProfile(reader, light, read, LightImageShape::Projected);
    double inner = 20, outer = 35;
    reader.read("innerDegrees", inner, 0, 89);
    reader.read("outerDegrees", outer, 0.1, 90);
    if (reader.has("outerDegrees") && outer < inner + 0.1)
        reader.complain("outerDegrees", fmt::format("expected a number from {} to 90", inner + 0.1));
    if (!(outer > inner)) {
        reader.complain("innerDegrees", fmt::format("expected less than the {} of outerDegrees", outer));
        inner = 0;
    }
    light.innerConeRadians = static_cast<float>(glm::radians(inner));
    light.outerConeRadians = static_cast<float>(glm::radians(outer));
    bool isFocused = false;
    reader.read("focused", isFocused);
    readIntensity(reader, light.intensity, [&](Lumen power) {
        return isFocused ? focusedSpotIntensity(power, light.innerConeRadians, light.outerConeRadians)
                         : spotIntensity(power);
    });
    if (isFocused && !reader.has("lumens") && !reader.has("watts"))
        reader.complain("focused", "belongs to 'lumens' or 'watts'");
    read.light = light;
}

void readRect(JsonReader& reader, SceneFileLight& read) {
    RectLight light;
    reader.read("image", read.image);
    read.imageShape = LightImageShape::Emitted;
    readArea(reader, light);
    reader.read("up", light.upWorld);
    reader.read("width", light.widthMeters, 0, kFarthestRange);
    reader.read("height", light.heightMeters, 0, kFarthestRange);
    read.light = light;
}

void readDisc(JsonReader& reader, SceneFileLight& read) {
    DiscLight light;
    readArea(reader, light);
    reader.read("radius", light.radiusMeters, 0, kFarthestRange);
    read.light = light;
}

void readTube(JsonReader& reader, SceneFileLight& read) {
    TubeLight light;
    readArea(reader, light);
    reader.read("axis", light.axisWorld);
    if (light.axisWorld == float3(0.0f)) reader.complain("axis", "expected one that is not zero");
    reader.read("length", light.lengthMeters, 0, kFarthestRange);
    reader.read("radius", light.radiusMeters, 0, kFarthestRange);
    read.light = light;
}

} // namespace filament_core::scenefile
