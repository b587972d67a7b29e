// SPDX-License-Identifier: Apache-2.0
// Lights, environment and cameras of a saved scene.
#include "filament_core/engine/EnvironmentImpl.h"
#include "filament_core/engine/gltf/SaveContext.h"

#include <filament_core/Environment.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::engine {
namespace {

using scene::LightRecord;

/// At a place, with -Z along a direction and +X along `side`, as far as it is across.
double4x4 placed(double3 const& position, float3 direction, float3 side) {
    const double3 back = -glm::normalize(double3(direction));
    double3 right = double3(side) - back * glm::dot(double3(side), back);
    if (!(glm::dot(right, right) > 1e-12))
        right = glm::cross(std::abs(back.y) < 0.9 ? double3(0, 1, 0) : double3(1, 0, 0), back);
    right = glm::normalize(right);
    double4x4 matrix(1.0);
    matrix[0] = double4(right, 0);
    matrix[1] = double4(glm::cross(back, right), 0);
    matrix[2] = double4(back, 0);
    matrix[3] = double4(position, 1);
    return matrix;
}

assets::LightType gltfTypeOf(LightRecord::Type type) {
    if (type == LightRecord::Type::Sun) return assets::LightType::Directional;
    return type == LightRecord::Type::Spot ? assets::LightType::Spot : assets::LightType::Point;
}

const char* typeNameOf(LightRecord::Type type) {
    constexpr std::array kNames{ "sun", "point", "spot", "rect", "disc", "tube" };
    return kNames[static_cast<size_t>(type)];
}

/// What KHR_lights_punctual does not have, as JSON: "name": value.
std::vector<std::string> extrasOf(LightRecord const& light) {
    std::vector<std::string> extras;
    const auto add = [&](bool isUsed, const char* name, auto const& value) {
        if (isUsed) extras.push_back(fmt::format("\"{}\": {}", name, value));
    };
    const bool isSun = light.type == LightRecord::Type::Sun;
    add(!light.castsShadows, "castsShadows", false);
    add(light.contactShadows, "contactShadows", true);
    add(light.channels != kDefaultLightChannels, "lightChannels", static_cast<uint32_t>(light.channels));
    if (light.isArea()) {
        add(true, "width", 2 * light.halfExtent.x);
        add(true, "height", 2 * light.halfExtent.y);
        add(true, "nits", light.intensity);
        add(true, "color", fmt::format("[{}, {}, {}]", light.color.x, light.color.y, light.color.z));
        add(light.rangeMeters > 0, "range", light.rangeMeters);
        add(light.isTwoSided, "twoSided", true);
        add(light.isVisible, "visible", true);
    } else if (!isSun) {
        add(light.sourceRadius > 0, "sourceRadius", light.sourceRadius);
    }
    if (isSun && light.showsDisc) {
        add(true, "showsDisc", true);
        add(true, "haloSize", light.haloSize);
        add(true, "haloFalloff", light.haloFalloff);
    }
    return extras;
}

std::string joined(std::vector<std::string> const& parts) {
    std::string all;
    for (std::string const& part : parts) all += (all.empty() ? "" : ", ") + part;
    return all;
}

/// As JSON text.
std::string environmentExtras(std::string const& name, scene::IndirectLightRecord const& light) {
    std::string quoted;
    for (const char c : name) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
    return fmt::format(R"({{"filament": {{"environment": "{}", "lux": {}, "degrees": {}}}}})", quoted,
                       light.illuminance.value, glm::degrees(light.rotationRadians));
}

/// Whether the image-based light of the first file lights the scene.
bool isOfFirstFile(SaveContext const& context) {
    if (context.sources.empty()) return false;
    std::optional<Environment> const& environment = context.sources.front().model->environment;
    const backend::TextureHandle light = context.scene.data.indirectLight.specular;
    if (!environment || !light) return false;
    return context.engine.indirectLights.get(environment->indirectLight()).light.specular == light;
}

void addCamera(SaveContext& context, GltfCamera const& camera) {
    Lens const& lens = camera.camera.lens;
    assets::CameraData data{ .name = camera.name,
                             .isParallel = lens.isOrthographic(),
                             .verticalFovRadians = glm::radians(lens.verticalFovDegrees),
                             .halfHeightMeters = lens.orthographicHeight / 2,
                             .nearMeters = lens.nearMeters,
                             .farMeters = lens.farMeters,
                             .aspect = lens.aspect };
    if (lens.shift != float2(0.0f))
        context.warn("camera '{}': its shift is not written; keep the camera in a scene file", camera.name);
    context.merge.cameras.push_back({ std::move(data), camera.camera.worldFromView });
}

} // namespace

assets::GltfMergeNode savedLight(SaveContext& context, LightRecord const& record, std::string const& name) {
    const std::string shown = name.empty() ? typeNameOf(record.type) : name;
    const bool isTube = record.type == LightRecord::Type::Tube, isPoint = record.type == LightRecord::Type::Point;
    const bool isTurned = !isPoint || record.profile || record.image;
    // A tube shines to all sides: its node has its axis along +X.
    const float3 direction = isTube ? placed(double3(0), record.sideWorld, {})[0] : record.directionWorld;
    assets::GltfMergeNode node{ .name = shown };
    node.transform = isTurned ? placed(record.positionWorld, direction, record.sideWorld) : double4x4(1.0);
    (*node.transform)[3] = double4(record.type == LightRecord::Type::Sun ? double3(0) : record.positionWorld, 1);
    const std::vector<std::string> extras = extrasOf(record);
    const std::string object = extras.empty() ? std::string()
                                              : fmt::format(R"({{"filament": {{"light": "{}", {}}}}})",
                                                            typeNameOf(record.type), joined(extras));
    if (record.profile || record.image)
        context.warn("light '{}': its {} is not written; keep the light in a scene file", shown,
                     record.profile ? "photometric profile" : "image");
    if (record.isArea()) {
        context.warn("light '{}': glTF has no area lights; its values are extras of a node, which loadGltf() does not "
                     "read; keep the light in a scene file",
                     shown);
        node.extras = object;
        return node;
    }
    if (!extras.empty())
        context.warn("light '{}': {} are extras, which loadGltf() does not read; keep the light in a scene file", shown,
                     joined(extras));
    assets::LightData data{ .name = shown,
                            .type = gltfTypeOf(record.type),
                            .color = record.color,
                            .intensity = record.intensity,
                            .rangeMeters = record.rangeMeters };
    if (record.type == LightRecord::Type::Spot) {
        data.innerConeRadians = record.innerConeRadians;
        data.outerConeRadians = record.outerConeRadians;
    }
    // Colours are in [0, 1] there (KHR_lights_punctual has no limit, other programs do).
    const float most = std::max({ data.color.x, data.color.y, data.color.z });
    if (most > 1) data.color = data.color / most, data.intensity *= most;
    node.light = static_cast<uint32_t>(context.merge.lights.size());
    context.merge.lights.push_back({ std::move(data), object });
    return node;
}

void saveSurroundings(SaveContext& context, GltfSaveOptions const& options) {
    context.merge.copyright = options.copyright;
    scene::IndirectLightRecord const& light = context.scene.data.indirectLight;
    context.merge.keepsEnvironment = isOfFirstFile(context);
    if (!options.environment.empty())
        context.merge.extras = environmentExtras(options.environment, light);
    else if (light.specular && !context.merge.keepsEnvironment)
        context.warn("the environment is not written; name it by GltfSaveOptions::environment, or keep a scene file");
    for (GltfCamera const& camera : options.cameras) addCamera(context, camera);
}

} // namespace filament_core::engine
