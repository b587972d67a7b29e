// SPDX-License-Identifier: Apache-2.0
// Lights of a file: KHR_lights_punctual, and what it lacks: FILAMENT_light, docs/gltf.md.
#include "filament_core/assets/gltf/GltfParseMaterial.h"
#include "filament_core/assets/gltf/GltfUri.h"
#include "filament_core/assets/tables/LightImageTable.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>

namespace filament_core::assets {
namespace {

constexpr uint64_t kOwnLightVersion = 1;

/// KHR_lights_punctual: 0 <= inner < outer <= pi/2. Equal cones are a hard edge, and stay one.
void parseCones(JsonNode const& spot, LightData& light) {
    constexpr float kHalfPi = 1.57079633f, kNarrowest = 1e-3f; // below, the falloff has no digits left in a float
    light.outerConeRadians = spot["outerConeAngle"].numberInRange(0.7853982f, kNarrowest, kHalfPi);
    light.innerConeRadians = spot["innerConeAngle"].numberInRange(0, 0, kHalfPi);
    if (light.innerConeRadians < light.outerConeRadians) return;
    spot.diagnostics().warn("{}: the inner cone is not inside of the outer one and was narrowed", spot.path());
    light.innerConeRadians = std::nextafter(light.outerConeRadians, 0.0f);
}

/// What `known` keeps of the number is what the file says; absent ones stay.
void parseNumber(JsonNode const& node, float& known, float low, float high) {
    known = node.numberInRange(known, low, high);
}

void parseArea(JsonNode const& area, LightData& light) {
    const std::string shape = area["shape"].text();
    float2& size = light.sizeMeters;
    if (shape == "rect") {
        light.shape = AreaShape::Rect;
        size = float2(area["width"].numberInRange(1, 0, kMaxFloat), area["height"].numberInRange(1, 0, kMaxFloat));
    } else if (shape == "disc") {
        light.shape = AreaShape::Disc;
        size = float2(area["radius"].numberInRange(0.5f, 0, kMaxFloat));
    } else if (shape == "tube") {
        light.shape = AreaShape::Tube;
        size = float2(area["length"].numberInRange(1, 0, kMaxFloat), area["radius"].numberInRange(0.02f, 0, kMaxFloat));
    } else {
        area.diagnostics().warn("{}.shape: '{}' is none of rect, disc and tube; the light has no area", area.path(),
                                shape);
        return;
    }
    const double view = largestView(light);
    const double nits = view > 0 ? double{ light.intensity } / view : 0;
    light.luminance =
            area["luminance"].numberInRange(static_cast<float>(std::min(nits, double{ kMaxFloat })), 0, kMaxFloat);
    light.isTwoSided = light.shape != AreaShape::Tube && area["twoSided"].boolean(false);
    light.isVisible = area["visible"].boolean(false);
}

std::vector<uint32_t> parseWords(JsonNode const& node) {
    const std::string uri = node.text();
    const Result<std::vector<std::byte>> bytes =
            isDataUri(uri) ? readGltfUri(uri, GltfFolder(std::filesystem::path()))
                           : Result<std::vector<std::byte>>(fail(ErrorCode::Corrupt, "it must be a data URI"));
    if (!bytes || bytes->size() % 4 != 0) {
        node.diagnostics().warn("{}: {}; it is left out", node.path(),
                                bytes ? "the bytes are no words" : bytes.error().message);
        return {};
    }
    std::vector<uint32_t> words(bytes->size() / 4);
    if (!words.empty()) std::memcpy(words.data(), bytes->data(), bytes->size());
    return words;
}

/// Whether shaders can look it up: that all levels are where lightImageTable() puts them. Any word is a colour.
bool isImageTable(std::span<const uint32_t> words) {
    if (words.size() < kLightImageHeaderWords) return false;
    uint32_t width = words[0], height = words[1];
    if (width == 0 || height == 0 || std::max(width, height) > kMaxLightImageSize) return false;
    const uint32_t levels = static_cast<uint32_t>(std::bit_width(std::max(width, height)));
    size_t at = kLightImageHeaderWords + levels;
    if (words[2] != levels - 1 || words.size() < at) return false;
    for (uint32_t i = 0; i < levels; ++i) {
        if (words[kLightImageHeaderWords + i] != at) return false;
        at += size_t{ width + 2 } * (height + 2);
        width = std::max(width / 2, 1u), height = std::max(height / 2, 1u);
    }
    return words.size() == at;
}

/// Rows, columns, rows a radian, and two entries of 16 bits a word.
bool isProfileTable(std::span<const uint32_t> words) {
    constexpr uint32_t kMost = 1024;
    if (words.size() < 3 || words[0] < 2 || words[0] > kMost || words[1] < 1 || words[1] > kMost) return false;
    const float rows = std::bit_cast<float>(words[2]);
    return rows > 0 && rows < 1e4f && words.size() == 3 + (size_t{ words[0] } * words[1] + 1) / 2;
}

void parseTables(JsonNode const& own, LightData& light) {
    LightTables tables;
    if (const JsonNode image = own["image"]; image.exists()) {
        const bool hasImage = light.shape == AreaShape::None || light.shape == AreaShape::Rect;
        tables.image = parseWords(image["words"]);
        const bool isSquare = light.type != LightType::Point || light.shape != AreaShape::None ||
                              (tables.image.size() > 1 && tables.image[0] == tables.image[1]);
        if (!hasImage || !isSquare || !isImageTable(tables.image)) {
            own.diagnostics().warn("{}.image: is no image for this light; it is left out", own.path());
            tables.image.clear();
        }
        parseNumber(image["aspect"], tables.aspect, 1.0f / 16384, 16384);
        parseNumber(image["width"], tables.imageMeters, 1.01e-6f, 0.99e12f);
        std::array<double, 2> offset{ 0, 0 };
        image["offset"].numbers(offset);
        for (int i = 0; i < 2; ++i)
            tables.imageOffset[i] = static_cast<float>(std::clamp(offset[static_cast<size_t>(i)], -1e12, 1e12));
    }
    if (const JsonNode profile = own["profile"]; profile.exists()) {
        const bool hasProfile = light.shape == AreaShape::None && light.type != LightType::Directional;
        tables.profile = parseWords(profile["words"]);
        if (!hasProfile || !isProfileTable(tables.profile)) {
            own.diagnostics().warn("{}.profile: is no profile for this light; it is left out", own.path());
            tables.profile.clear();
        }
        parseNumber(profile["peak"], tables.peak, 0, kMaxFloat);
        parseNumber(profile["lumens"], tables.lumens, 0, kMaxFloat);
    }
    if (!tables.image.empty() || !tables.profile.empty())
        light.tables = std::make_shared<const LightTables>(std::move(tables));
}

void parseOwnValues(JsonNode const& own, LightData& light) {
    if (const JsonNode color = own["color"]; color.exists()) {
        const auto exact = parseFactors<3>(color, 1, 0, kMaxFloat);
        light.color = { exact[0], exact[1], exact[2] };
    }
    parseNumber(own["intensity"], light.intensity, 0, kMaxFloat);
    light.castsShadows = own["castsShadows"].boolean(true);
    light.contactShadows = own["contactShadows"].boolean(false);
    light.channels = static_cast<uint8_t>(own["lightChannels"].numberInRange(1, 0, 255));
    parseNumber(own["sourceRadius"], light.sourceRadiusMeters, 0, kMaxFloat);
    parseNumber(own["angularRadius"], light.angularRadiusDegrees, 0, 20);
    light.showsDisc = own["showsDisc"].boolean(false);
    parseNumber(own["haloSize"], light.haloSize, 1, 1000);
    parseNumber(own["haloFalloff"], light.haloFalloff, 0, 10'000);
    if (const JsonNode area = own["area"]; area.exists()) parseArea(area, light);
    parseTables(own, light);
}

/// What is wrong with it costs the extension, not the light.
void parseOwnLight(JsonNode const& extension, LightData& light) {
    if (!extension.exists()) return;
    Diagnostics found;
    const JsonNode own = extension.reportingTo(found);
    LightData read = light;
    const uint64_t version = own["version"].requiredInteger();
    if (found.ok() && version != kOwnLightVersion)
        found.refuse(ErrorCode::Unsupported, "{}.version: {} is unknown, {} is read", own.path(), version,
                     kOwnLightVersion);
    if (found.ok()) parseOwnValues(own, read);
    for (std::string const& warning : found.takeWarnings()) extension.diagnostics().warn("{}", warning);
    if (found.ok())
        light = read;
    else
        extension.diagnostics().warn("{}; the light is read without this extension", found.error().message);
}

} // namespace

std::optional<LightData> parseGltfLight(JsonNode const& node) {
    LightData light;
    light.name = node["name"].label();
    const std::string type = node["type"].text();
    if (type == "directional") {
        light.type = LightType::Directional;
    } else if (type == "spot") {
        light.type = LightType::Spot;
    } else if (type != "point") {
        node.diagnostics().warn("{}.type: '{}' is none of directional, point and spot; the light is left out",
                                node.path(), type);
        return std::nullopt;
    }
    const auto color = parseFactors<3>(node["color"], 1, 0, kMaxFloat);
    light.color = { color[0], color[1], color[2] };
    light.intensity = node["intensity"].numberInRange(1, 0, kMaxFloat);
    light.rangeMeters = node["range"].numberInRange(0, 0, kMaxFloat);
    if (light.type == LightType::Spot) parseCones(node["spot"], light);
    parseOwnLight(node.extension("FILAMENT_light"), light);
    return light;
}

} // namespace filament_core::assets
