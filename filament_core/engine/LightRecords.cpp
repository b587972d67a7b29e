// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/LightRecords.h"

#include "base/math/Elementary.h"

#include <filament_core/Options.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::engine {

using scene::LightRecord;

namespace {

// Floats lose the squares of components above 1.8e19 and below 1e-19; doubles hold those of every float.
float3 unitDirection(float3 direction) {
    const float length = glm::length(direction);
    if (length > 1e-15f && length < 1e18f) return direction / length;
    const double exact = glm::length(double3(direction));
    FILAMENT_ASSERT(exact > 0 && std::isfinite(exact), "a light's direction is finite and not zero");
    return float3(double3(direction) / exact);
}

constexpr float kLargestFloat = std::numeric_limits<float>::max();

// Negative values and NaN become 0.
float clampedOr0(float value, float most) { return value > 0 ? std::min(value, most) : 0.0f; }

void checkLight(LinearColor color, float rangeMeters, double3 const& positionWorld) {
    const auto isFinite = [](auto const& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    FILAMENT_ASSERT(isFinite(color) && color.x >= 0 && color.y >= 0 && color.z >= 0,
                    "a light's color is finite and >= 0");
    FILAMENT_ASSERT(rangeMeters >= 0 && std::isfinite(rangeMeters), "a light's range is finite and >= 0");
    FILAMENT_ASSERT(isFinite(positionWorld), "a light's position is finite");
}

// Across a direction, nearest to `side`; any if that is along the direction or not finite. All unit but `side`.
float3 acrossDirection(float3 direction, float3 side) {
    const double3 axis(direction), other = std::abs(direction.x) < 0.7f ? double3(1, 0, 0) : double3(0, 1, 0);
    const double length = glm::length(double3(side));
    const double3 wanted = length > 0 && std::isfinite(length) ? double3(side) / length : other;
    const double3 across = wanted - axis * glm::dot(wanted, axis);
    if (glm::dot(across, across) > 1e-12) return float3(glm::normalize(across));
    return float3(glm::normalize(other - axis * glm::dot(other, axis)));
}

/// To a record that has a direction; `up` as of PointLight::upWorld.
void setProfile(Engine::Impl const& engine, LightProfile profile, float3 up, LightRecord& record) {
    record.sideWorld = glm::cross(record.directionWorld, acrossDirection(record.directionWorld, up));
    record.profile = engine.lightProfiles.get(profile).words;
}

/// To a record that has a direction.
void setImage(Engine::Impl const& engine, LightImage image, float3 up, LightRecord& record) {
    record.sideWorld = glm::cross(record.directionWorld, acrossDirection(record.directionWorld, up));
    record.image = engine.lightImages.get(image).words;
}

LightImageShape shapeOf(Engine::Impl const& engine, LightImage image) {
    return engine.lightImages.get(image).description.shape;
}

/// The shorter side of the image touches the outer cone.
void setCookie(Engine::Impl const& engine, SpotLight const& light, LightRecord& record) {
    FILAMENT_ASSERT(shapeOf(engine, light.cookie) == LightImageShape::Projected, "the cookie of a spot is projected");
    constexpr float kWidestImage = 1.3962634f; // 80 degrees
    setImage(engine, light.cookie, light.upWorld, record);
    const float width = 2 * elementary::tan(std::min(light.outerConeRadians, kWidestImage));
    const float aspect = engine.lightImages.get(light.cookie).aspect;
    record.imageScale = float2(1 / (width * std::max(1 / aspect, 1.0f)), 1 / (width * std::max(aspect, 1.0f)));
}

void setCookie(Engine::Impl const& engine, PointLight const& light, LightRecord& record) {
    const LightImageShape shape = shapeOf(engine, light.cookie);
    FILAMENT_ASSERT(shape == LightImageShape::Octahedron || shape == LightImageShape::Cube,
                    "the cookie of a point light is an octahedron or a cube");
    setImage(engine, light.cookie, light.upWorld, record);
}

void setCookie(Engine::Impl const& engine, SunLight const& light, LightRecord& record) {
    FILAMENT_ASSERT(shapeOf(engine, light.cookie) == LightImageShape::Tiled, "the cookie of a sun is tiled");
    FILAMENT_ASSERT(light.cookieMeters > 1e-6f && light.cookieMeters < 1e12f,
                    "the cookie of a sun is between 1e-6 and 1e12 metres wide");
    FILAMENT_ASSERT(std::isfinite(light.cookieOffsetMeters.x) && std::isfinite(light.cookieOffsetMeters.y),
                    "the offset of a sun's cookie is finite");
    setImage(engine, light.cookie, light.upWorld, record);
    const float height = light.cookieMeters * engine.lightImages.get(light.cookie).aspect;
    record.imageScale = float2(1 / light.cookieMeters, 1 / height);
    record.imageOffset = -light.cookieOffsetMeters * record.imageScale;
}

/// The common part of area lights; the record lacks its shape.
template <class AreaLight>
LightRecord areaRecord(LightRecord::Type type, AreaLight const& light) {
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    const float nits = light.luminance.value;
    return { .type = type,
             .positionWorld = light.positionWorld,
             .color = light.color,
             .intensity = nits > 0 && std::isfinite(nits) ? nits : 0.0f,
             .rangeMeters = light.rangeMeters,
             .castsShadows = light.castsShadows,
             .channels = light.lightChannels,
             .isVisible = light.isVisible };
}

float2 halfExtentOf(float x, float y) {
    FILAMENT_ASSERT(x >= 0 && y >= 0 && std::isfinite(x) && std::isfinite(y),
                    "the sizes of a light are finite and not negative");
    return { x, y };
}

/// Its shadows are as soft as those of a disc of the same area.
void setExtent(LightRecord& record, float2 halfExtent) {
    const double square = double{ halfExtent.x } * double{ halfExtent.y };
    const double area = record.type == LightRecord::Type::Disc ? std::numbers::pi * square : 4 * square;
    record.halfExtent = halfExtent;
    record.sourceRadius = static_cast<float>(std::sqrt(area / std::numbers::pi));
}

LightRecord recordOf(Engine::Impl const& engine, SunLight const& given) {
    checkLight(given.color, 0, double3(0.0));
    const SunLight light = clamped(given); // its disc and halo: a direction or colour that is no number is misuse
    LightRecord record{ .type = LightRecord::Type::Sun,
                        .directionWorld = unitDirection(given.directionWorld),
                        .color = given.color,
                        .intensity = given.illuminance.value,
                        .sourceRadius = elementary::tan(glm::radians(light.angularRadiusDegrees)),
                        .castsShadows = light.castsShadows,
                        .contactShadows = light.contactShadows,
                        .channels = light.lightChannels,
                        .showsDisc = light.showsDisc,
                        .haloSize = light.haloSize,
                        .haloFalloff = light.haloFalloff };
    if (given.cookie) setCookie(engine, given, record);
    return record;
}

LightRecord recordOf(Engine::Impl const& engine, PointLight const& light) {
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    LightRecord record{ .type = LightRecord::Type::Point,
                        .positionWorld = light.positionWorld,
                        .color = light.color,
                        .intensity = light.intensity.value,
                        .rangeMeters = light.rangeMeters,
                        .sourceRadius = clampedOr0(light.sourceRadiusMeters, kLargestFloat),
                        .castsShadows = light.castsShadows,
                        .contactShadows = light.contactShadows,
                        .channels = light.lightChannels };
    if (light.profile || light.cookie) record.directionWorld = unitDirection(light.directionWorld);
    if (light.profile) setProfile(engine, light.profile, light.upWorld, record);
    if (light.cookie) setCookie(engine, light, record);
    return record;
}

LightRecord recordOf(Engine::Impl const& engine, SpotLight const& light) {
    checkLight(light.color, light.rangeMeters, light.positionWorld);
    FILAMENT_ASSERT(light.innerConeRadians >= 0 && light.innerConeRadians < light.outerConeRadians &&
                            light.outerConeRadians <= 1.5707964f,
                    "a spot has 0 <= inner < outer <= pi/2");
    LightRecord record{ .type = LightRecord::Type::Spot,
                        .positionWorld = light.positionWorld,
                        .directionWorld = unitDirection(light.directionWorld),
                        .color = light.color,
                        .intensity = light.intensity.value,
                        .rangeMeters = light.rangeMeters,
                        .innerConeRadians = light.innerConeRadians,
                        .outerConeRadians = light.outerConeRadians,
                        .sourceRadius = clampedOr0(light.sourceRadiusMeters, kLargestFloat),
                        .castsShadows = light.castsShadows,
                        .contactShadows = light.contactShadows,
                        .channels = light.lightChannels };
    if (light.profile) setProfile(engine, light.profile, light.upWorld, record);
    if (light.cookie) setCookie(engine, light, record);
    return record;
}

LightRecord recordOf(Engine::Impl const& engine, RectLight const& light) {
    LightRecord record = areaRecord(LightRecord::Type::Rect, light);
    record.directionWorld = unitDirection(light.directionWorld);
    const float3 up = acrossDirection(record.directionWorld, light.upWorld);
    record.sideWorld = glm::cross(record.directionWorld, up);
    setExtent(record, halfExtentOf(light.widthMeters / 2, light.heightMeters / 2));
    record.isTwoSided = light.isTwoSided;
    if (light.image) {
        FILAMENT_ASSERT(shapeOf(engine, light.image) == LightImageShape::Emitted,
                        "the image of a rectangle is emitted");
        record.image = engine.lightImages.get(light.image).words;
    }
    return record;
}

LightRecord recordOf(Engine::Impl const&, DiscLight const& light) {
    LightRecord record = areaRecord(LightRecord::Type::Disc, light);
    record.directionWorld = unitDirection(light.directionWorld);
    record.sideWorld = acrossDirection(record.directionWorld, {});
    setExtent(record, halfExtentOf(light.radiusMeters, light.radiusMeters));
    record.isTwoSided = light.isTwoSided;
    return record;
}

LightRecord recordOf(Engine::Impl const&, TubeLight const& light) {
    LightRecord record = areaRecord(LightRecord::Type::Tube, light);
    record.sideWorld = unitDirection(light.axisWorld);
    setExtent(record, halfExtentOf(light.lengthMeters / 2, light.radiusMeters));
    return record;
}

} // namespace

LightRecord recordOf(Engine::Impl const& engine, LightDesc const& light) {
    return std::visit([&](auto const& desc) { return recordOf(engine, desc); }, light);
}

} // namespace filament_core::engine
