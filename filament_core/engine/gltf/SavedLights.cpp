// SPDX-License-Identifier: Apache-2.0
// Lights, environment and cameras of a saved scene.
#include "base/math/Elementary.h"
#include "filament_core/engine/EnvironmentImpl.h"
#include "filament_core/engine/gltf/SaveContext.h"

#include <filament_core/Environment.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

namespace filament_core::engine {
namespace {

using scene::LightRecord;

/// At a place, with -Z along a direction and +X along `side`, as far as it is across. The numbers of unit vectors stay
/// as they are, so that the loader gets them back.
double4x4 placed(double3 const& position, float3 direction, float3 side) {
    const double3 back = -double3(direction);
    double3 right(side);
    if (std::abs(glm::dot(right, back)) > 1e-6 || std::abs(glm::dot(right, right) - 1) > 1e-6)
        right = glm::normalize(glm::cross(std::abs(back.y) < 0.9 ? double3(0, 1, 0) : double3(1, 0, 0), back));
    double4x4 matrix(1.0);
    matrix[0] = double4(right, 0);
    matrix[1] = double4(glm::cross(back, right), 0);
    matrix[2] = double4(back, 0);
    matrix[3] = double4(position, 1);
    return matrix;
}

/// Along +X, which a tube shines around.
double4x4 placedAlong(double3 const& position, float3 axis) {
    const float3 across = glm::cross(axis, std::abs(axis.y) < 0.9f ? float3(0, 1, 0) : float3(1, 0, 0));
    return placed(position, glm::normalize(across), axis);
}

const char* typeNameOf(LightRecord::Type type) {
    constexpr std::array kNames{ "sun", "point", "spot", "rect", "disc", "tube" };
    return kNames[static_cast<size_t>(type)];
}

assets::AreaShape shapeOf(LightRecord::Type type) {
    if (type == LightRecord::Type::Rect) return assets::AreaShape::Rect;
    if (type == LightRecord::Type::Disc) return assets::AreaShape::Disc;
    return type == LightRecord::Type::Tube ? assets::AreaShape::Tube : assets::AreaShape::None;
}

/// Of areas, what programs show that know no areas.
assets::LightType gltfTypeOf(LightRecord const& record) {
    if (record.type == LightRecord::Type::Sun) return assets::LightType::Directional;
    if (record.type == LightRecord::Type::Spot) return assets::LightType::Spot;
    const bool hasFront = record.type == LightRecord::Type::Rect || record.type == LightRecord::Type::Disc;
    return hasFront && !record.isTwoSided ? assets::LightType::Spot : assets::LightType::Point;
}

/// The number near `guess` of which `made` gives `wanted`, to the bit if there is one.
template <class Made>
float inverseOf(float wanted, float guess, Made const& made) {
    float low = guess;
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) low = std::nextafter(low, -std::numeric_limits<float>::infinity());
    for (int i = 0; i < 2 * kSteps; ++i, low = std::nextafter(low, std::numeric_limits<float>::infinity()))
        if (made(low) == wanted) return low;
    return guess;
}

/// The degrees of which a sun's record has the tangent, to the bit if there are such degrees.
float angularRadiusOf(float tangent) {
    const double radians = elementary::atan2(double{ tangent }, 1.0);
    const float degrees = inverseOf(tangent, static_cast<float>(glm::degrees(radians)),
                                    [](float of) { return elementary::tan(glm::radians(of)); });
    return std::clamp(degrees, 0.0f, 20.0f);
}

std::shared_ptr<const assets::LightTables> tablesOf(Engine::Impl& engine, LightRecord const& record) {
    assets::LightTables tables;
    if (record.image) {
        tables.image = *record.image;
        const float2 scale = record.imageScale; // LightRecords.cpp
        tables.aspect = scale.x / scale.y;
        engine.lightImages.forEach([&](LightImageState const& state) {
            if (state.words == record.image) tables.aspect = state.aspect;
        });
        if (record.type == LightRecord::Type::Sun) {
            tables.imageMeters = inverseOf(scale.x, 1 / scale.x, [](float meters) { return 1 / meters; });
            for (int i = 0; i < 2; ++i)
                tables.imageOffset[i] = inverseOf(record.imageOffset[i], -record.imageOffset[i] / scale[i],
                                                  [&](float offset) { return -offset * scale[i]; });
        }
    }
    if (record.profile) {
        tables.profile = *record.profile;
        engine.lightProfiles.forEach([&](LightProfileState const& state) {
            if (state.words != record.profile) return;
            tables.peak = state.description.peak.value;
            tables.lumens = state.description.flux.value;
        });
    }
    return std::make_shared<const assets::LightTables>(std::move(tables));
}

assets::LightData dataOf(LightRecord const& record, std::string const& name) {
    const bool isArea = record.isArea(), isDisc = record.type == LightRecord::Type::Disc;
    assets::LightData data{ .name = name,
                            .type = gltfTypeOf(record),
                            .color = record.color,
                            .intensity = record.intensity,
                            .rangeMeters = record.rangeMeters,
                            .castsShadows = record.castsShadows,
                            .contactShadows = record.contactShadows,
                            .channels = record.channels,
                            .shape = shapeOf(record.type),
                            .isTwoSided = record.isTwoSided,
                            .isVisible = record.isVisible };
    if (isArea) {
        const bool isTube = record.type == LightRecord::Type::Tube;
        data.sizeMeters = isDisc ? record.halfExtent : record.halfExtent * float2(2, isTube ? 1 : 2);
        data.luminance = record.intensity;
        data.outerConeRadians = glm::half_pi<float>();
    } else if (record.type == LightRecord::Type::Sun) {
        data.angularRadiusDegrees = angularRadiusOf(record.sourceRadius);
        data.showsDisc = record.showsDisc;
        data.haloSize = record.haloSize;
        data.haloFalloff = record.haloFalloff;
    } else {
        data.sourceRadiusMeters = record.sourceRadius;
    }
    if (record.type == LightRecord::Type::Spot) {
        data.innerConeRadians = record.innerConeRadians;
        data.outerConeRadians = record.outerConeRadians;
    }
    return data;
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
    const bool isSun = record.type == LightRecord::Type::Sun, isPoint = record.type == LightRecord::Type::Point;
    const bool isTurned = !isPoint || record.profile || record.image;
    const double3 at = isSun ? double3(0) : record.positionWorld;
    assets::GltfMergeNode node{ .name = shown };
    if (record.type == LightRecord::Type::Tube)
        node.transform = placedAlong(at, record.sideWorld);
    else
        node.transform = placed(at, isTurned ? record.directionWorld : float3(0, 0, -1),
                                isTurned ? record.sideWorld : float3(1, 0, 0));
    node.light = static_cast<uint32_t>(context.merge.lights.size());
    context.merge.lights.push_back(dataOf(record, shown));
    if (record.profile || record.image) context.merge.lights.back().tables = tablesOf(context.engine, record);
    return node;
}

bool isSameLight(LightRecord const& a, LightRecord const& b) {
    // All members: one more or less does not compile.
    const auto members = [](LightRecord const& light) {
        auto const& [type, position, direction, color, intensity, range, inner, outer, radius, casts, contact, channels,
                     isTwoSided, isVisible, side, extent, profile, image, scale, offset, disc, haloSize, falloff] =
                light;
        return std::tie(type, position, direction, color, intensity, range, inner, outer, radius, casts, contact,
                        channels, isTwoSided, isVisible, side, extent, profile, image, scale, offset, disc, haloSize,
                        falloff);
    };
    return members(a) == members(b);
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
