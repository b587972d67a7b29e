// SPDX-License-Identifier: Apache-2.0
/// Frustum: the planes of a view, in the camera-relative world space of the shaders. Without a far plane: the
/// projection has none.
#pragma once

#include "filament_core/math/Math.h"

#include <array>

namespace filament {

struct Frustum {
    /// left, right, bottom, top, near: dot(xyz, p) + w >= 0 inside. Normals are unit length.
    std::array<float4, 5> planes;
};

/// Gribb & Hartmann 2001, "Fast extraction of viewing frustum planes", for clip z in [0, w] with reversed depth.
Frustum frustumFromClip(float4x4 const& clipFromWorld);

/// False only if the box is outside of one plane: conservative at edges and corners.
inline bool intersects(Frustum const& frustum, float3 center, float3 halfExtent) {
    for (float4 const& plane : frustum.planes) {
        const float3 normal(plane);
        const float reach = glm::dot(glm::abs(normal), halfExtent);
        if (glm::dot(normal, center) + plane.w < -reach) return false;
    }
    return true;
}

inline bool intersectsSphere(Frustum const& frustum, float3 center, float radius) {
    for (float4 const& plane : frustum.planes) {
        if (glm::dot(float3(plane), center) + plane.w < -radius) return false;
    }
    return true;
}

} // namespace filament
