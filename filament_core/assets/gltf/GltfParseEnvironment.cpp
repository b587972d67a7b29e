// SPDX-License-Identifier: Apache-2.0
// EXT_lights_image_based: everything but the images.
#include "filament_core/assets/gltf/GltfEnvironment.h"
#include "filament_core/assets/gltf/GltfParseMaterial.h"

#include <bit>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr const char* kCure = "export the light again";

void refuse(JsonNode const& node, std::string const& what) {
    node.diagnostics().refuse(ErrorCode::Corrupt, "{}: {}; {}", node.path(), what, kCure);
}

double4 parseRotation(JsonNode const& node) {
    std::array<double, 4> r{ 0, 0, 0, 1 };
    node.numbers(r);
    const double4 rotation(r[0], r[1], r[2], r[3]);
    const double length = glm::length(rotation);
    if (!(length > 1e-6) || !std::isfinite(length)) {
        node.diagnostics().warn("{}: has no length and was ignored", node.path());
        return { 0, 0, 0, 1 };
    }
    if (std::abs(length - 1) > 5e-4) node.diagnostics().warn("{}: its length is not 1; it was normalised", node.path());
    return rotation / length;
}

std::array<double3, 9> parseIrradiance(JsonNode const& node) {
    std::array<double3, 9> irradiance{};
    const std::vector<JsonNode> rows = node.elements();
    if (rows.size() != irradiance.size()) {
        refuse(node, node.exists() ? fmt::format("has {} coefficients instead of 9", rows.size())
                                   : "missing, must be 9 arrays of 3 numbers");
        return irradiance;
    }
    for (size_t i = 0; i < rows.size(); ++i) {
        std::array<double, 3> c{};
        rows[i].numbers(c);
        irradiance[i] = { c[0], c[1], c[2] };
        for (const double value : c) {
            if (!(std::abs(value) <= kMaxIrradiance))
                refuse(rows[i], fmt::format("{} is no irradiance, which is at most {}", value, kMaxIrradiance));
        }
    }
    return irradiance;
}

uint32_t parseSize(JsonNode const& node) {
    const uint64_t size = node.requiredInteger();
    if (!node.diagnostics().ok()) return 1;
    if (!std::has_single_bit(size)) {
        refuse(node, fmt::format("{} is not a power of two", size));
        return 1;
    }
    if (size > kMaxCubeSize) {
        node.diagnostics().refuse(ErrorCode::Unsupported, "{}: {} texels are beyond the limit of {}; make them smaller",
                                  node.path(), size, kMaxCubeSize);
        return 1;
    }
    return static_cast<uint32_t>(size);
}

std::array<uint32_t, 6> parseFaces(JsonNode const& node, size_t imageCount) {
    std::array<uint32_t, 6> faces{ kNone, kNone, kNone, kNone, kNone, kNone };
    const std::vector<JsonNode> images = node.elements();
    if (images.size() != faces.size()) {
        refuse(node, fmt::format("has {} images instead of 6", images.size()));
        return faces;
    }
    for (size_t i = 0; i < faces.size(); ++i) faces[i] = images[i].requiredIndex(imageCount, "images");
    return faces;
}

std::vector<std::array<uint32_t, 6>> parseLevels(JsonNode const& node, uint32_t size, size_t imageCount) {
    std::vector<std::array<uint32_t, 6>> levels;
    const std::vector<JsonNode> rows = node.elements();
    const auto most = static_cast<size_t>(std::bit_width(size));
    if (rows.empty()) refuse(node, node.exists() ? "has no images" : "missing, must be arrays of 6 images");
    if (rows.size() > most && node.diagnostics().ok())
        refuse(node, fmt::format("has {} levels, but faces of {} texels have only {}", rows.size(), size, most));
    for (JsonNode const& row : rows) {
        if (!node.diagnostics().ok()) break;
        levels.push_back(parseFaces(row, imageCount));
    }
    return levels;
}

} // namespace

GltfImageBasedLight parseGltfImageBasedLight(JsonNode const& node, size_t imageCount) {
    GltfImageBasedLight light;
    light.name = node["name"].label();
    light.rotation = parseRotation(node["rotation"]);
    light.intensity = node["intensity"].numberInRange(1, 0, kMaxImageIntensity);
    light.irradiance = parseIrradiance(node["irradianceCoefficients"]);
    light.size = parseSize(node["specularImageSize"]);
    light.levels = parseLevels(node["specularImages"], light.size, imageCount);
    return light;
}

uint32_t parseGltfSceneLight(JsonNode const& scene, size_t lightCount) {
    const JsonNode light = scene.extension("EXT_lights_image_based");
    return light.exists() ? light["light"].requiredIndex(lightCount, "EXT_lights_image_based.lights") : kNone;
}

} // namespace filament_core::assets
