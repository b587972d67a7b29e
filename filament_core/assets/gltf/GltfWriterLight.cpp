// SPDX-License-Identifier: Apache-2.0
// Lights as JSON: KHR_lights_punctual, and what it lacks: FILAMENT_light, docs/gltf.md.
#include "filament_core/assets/gltf/GltfWriterJson.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace filament_core::assets {
namespace {

constexpr double kMost = std::numeric_limits<float>::max(), kHalfPi = 1.57079632679489661923;

/// What the values of a light are there: JSON has no others.
double finite(double value) { return value > 0 ? std::min(value, kMost) : 0.0; }

template <class T>
void addUnless(T const& rest, Json& object, const char* key, T const& value) {
    if (value != rest) object[key] = value;
}

Json colorJson(float3 color) { return { finite(color.x), finite(color.y), finite(color.z) }; }

Json areaJson(LightData const& light) {
    constexpr std::array kNames{ "", "rect", "disc", "tube" };
    Json area{ { "shape", kNames[static_cast<size_t>(light.shape)] } };
    if (light.shape == AreaShape::Rect) area["width"] = light.sizeMeters.x, area["height"] = light.sizeMeters.y;
    if (light.shape == AreaShape::Disc) area["radius"] = light.sizeMeters.x;
    if (light.shape == AreaShape::Tube) area["length"] = light.sizeMeters.x, area["radius"] = light.sizeMeters.y;
    area["luminance"] = finite(double{ light.luminance });
    addUnless(false, area, "twoSided", light.isTwoSided);
    addUnless(false, area, "visible", light.isVisible);
    return area;
}

/// RFC 4648, section 4.
std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<uint32_t>(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

std::string dataUri(std::vector<uint32_t> const& words) {
    return "data:application/octet-stream;base64," + base64(std::as_bytes(std::span(words)));
}

Json imageJson(LightTables const& tables, bool isSun) {
    Json image{ { "aspect", tables.aspect } };
    if (isSun) image["width"] = tables.imageMeters, image["offset"] = { tables.imageOffset.x, tables.imageOffset.y };
    std::vector<uint32_t> words = tables.image;
    words[3] = 0; // its number in one engine
    image["words"] = dataUri(words);
    return image;
}

Json ownJson(LightData const& light) {
    const LightData rest;
    Json own = Json::object();
    addUnless(rest.castsShadows, own, "castsShadows", light.castsShadows);
    addUnless(rest.contactShadows, own, "contactShadows", light.contactShadows);
    addUnless(rest.channels, own, "lightChannels", light.channels);
    if (light.type == LightType::Directional) {
        addUnless(rest.angularRadiusDegrees, own, "angularRadius", light.angularRadiusDegrees);
        addUnless(rest.showsDisc, own, "showsDisc", light.showsDisc);
        addUnless(rest.haloSize, own, "haloSize", light.haloSize);
        addUnless(rest.haloFalloff, own, "haloFalloff", light.haloFalloff);
    } else if (light.shape != AreaShape::None) {
        own["area"] = areaJson(light);
    } else {
        addUnless(rest.sourceRadiusMeters, own, "sourceRadius", light.sourceRadiusMeters);
    }
    if (light.tables && !light.tables->image.empty())
        own["image"] = imageJson(*light.tables, light.type == LightType::Directional);
    if (light.tables && !light.tables->profile.empty())
        own["profile"] = { { "peak", finite(double{ light.tables->peak }) },
                           { "lumens", finite(double{ light.tables->lumens }) },
                           { "words", dataUri(light.tables->profile) } };
    return own;
}

const char* typeNameOf(LightType type) {
    constexpr std::array kNames{ "directional", "point", "spot" };
    return kNames[static_cast<size_t>(type)];
}

} // namespace

Json punctualLightJson(LightData const& light) {
    const bool isArea = light.shape != AreaShape::None;
    const double given = isArea ? largestView(light) * finite(double{ light.luminance }) : double{ light.intensity };
    // Colours are in [0, 1] there; the exact ones beyond are in the extension.
    const double most = std::max({ double{ light.color.x }, double{ light.color.y }, double{ light.color.z }, 1.0 });
    Json json{ { "name", light.name },
               { "color",
                 { finite(double{ light.color.x } / most), finite(double{ light.color.y } / most),
                   finite(double{ light.color.z } / most) } },
               { "intensity", finite(finite(given) * most) },
               { "type", typeNameOf(light.type) } };
    if (light.type == LightType::Spot) {
        json["spot"] = { { "innerConeAngle", light.innerConeRadians },
                         { "outerConeAngle", std::min(double{ light.outerConeRadians }, kHalfPi) } };
    }
    if (light.rangeMeters > 0) json["range"] = light.rangeMeters;
    Json own = ownJson(light);
    if (most > 1) own["color"] = colorJson(light.color);
    if (most > 1 && !isArea) own["intensity"] = finite(given);
    if (own.empty()) return json;
    Json versioned{ { "version", 1 } };
    versioned.update(own);
    json["extensions"]["FILAMENT_light"] = std::move(versioned);
    return json;
}

} // namespace filament_core::assets
