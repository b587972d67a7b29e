// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/LightBounds.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr float kSmallestNormal = std::numeric_limits<float>::min();

float3 depthSpace(ViewSpace const& space, float3 v) {
    const float3 view = float3x3(space.viewFromWorld) * v;
    return { view.x, view.y, -view.z };
}

// Devices may flush what is smaller than the smallest normal float: such a light is unlimited.
float rangeOf(shader::PunctualLight const& light, FroxelMargins margins) {
    const float inverseSquare = light.positionRange.w;
    const bool isLimited = inverseSquare >= kSmallestNormal && inverseSquare <= std::numeric_limits<float>::max();
    return isLimited ? 1 / std::sqrt(inverseSquare) * (1 + margins.range()) : kEverywhere;
}

LightCone coneOf(shader::PunctualLight const& light, float3 apex, ViewSpace const& space, FroxelMargins margins) {
    LightCone cone;
    const float3 axis(light.directionScale);
    const float cosine = -light.offset.x / light.directionScale.w - margins.cosine();
    const bool isUnit = std::abs(glm::dot(axis, axis) - 1) < 1e-5f;
    if (light.colorIntensity.w != float{ shader::kShapeSpot } || !isUnit || !(cosine > 0)) return cone;
    cone.apex = apex;
    cone.axis = depthSpace(space, axis);
    cone.cosine = std::min(cosine, 1.0f);
    cone.sine = std::sqrt(std::max(1 - cone.cosine * cone.cosine, 0.0f));
    cone.isNarrow = true;
    return cone;
}

// The smallest sphere around the part of a ball that is in a cone with its apex at the centre: through apex and rim for
// angles up to 45 degrees, around the rim beyond.
LightSphere sphereOf(LightSphere const& ball, LightCone const& cone) {
    if (!cone.isNarrow) return ball;
    const bool isRim = cone.cosine < std::sqrt(0.5f);
    const float along = isRim ? cone.cosine * ball.radius : ball.radius / (2 * cone.cosine);
    return { ball.center + cone.axis * along, isRim ? cone.sine * ball.radius : along };
}

} // namespace

LightBounds boundsOf(shader::PunctualLight const& light, ViewSpace const& space, FroxelMargins margins) {
    LightBounds bounds;
    const float3 center = depthSpace(space, float3(light.positionRange));
    const float range = rangeOf(light, margins), distance = glm::length(center);
    if (!(range + distance < std::numeric_limits<float>::max())) return bounds;
    bounds.cone = coneOf(light, center, space, margins);
    bounds.sphere = sphereOf({ center, range }, bounds.cone);
    bounds.sphere.radius = bounds.sphere.radius * (1 + margins.range()) + (distance + range) * margins.place();
    return bounds;
}

// Distance of the sphere's centre from the cone's side, in the plane through centre and axis. The cross product keeps
// its digits near the axis, where a difference of squares would lose them.
bool intersects(LightCone const& cone, float3 center, float radius) {
    const float3 from = center - cone.apex;
    const float along = glm::dot(from, cone.axis), across = glm::length(glm::cross(from, cone.axis));
    const float slack = radius + 1e-5f * (std::abs(along) + across);
    return !(cone.cosine * across - cone.sine * along > slack) && !(along < -slack);
}

} // namespace filament_core::prepare
