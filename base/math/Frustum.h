// SPDX-License-Identifier: Apache-2.0
/// Frustum: the planes of a view in the camera-relative world space of the shaders. There is no far plane, because the
/// projection has none.
#pragma once

#include "base/math/Math.h"
#include "base/math/Simd.h"

#include <array>

namespace filament_core {

struct Frustum {
    /// left, right, bottom, top, near: dot(xyz, p) + w >= 0 inside. Normals are unit length.
    std::array<float4, 5> planes;
};

/// Gribb & Hartmann 2001, "Fast extraction of viewing frustum planes", for clip z in [0, w] with reversed depth.
Frustum frustumFromClip(float4x4 const& clipFromWorld);

/// False only if the box is outside one of the planes: conservative at edges and corners.
inline bool intersects(Frustum const& frustum, float3 center, float3 halfExtent) {
    for (float4 const& plane : frustum.planes) {
        const float3 normal(plane);
        const float reach = glm::dot(glm::abs(normal), halfExtent);
        if (glm::dot(normal, center) + plane.w < -reach) return false;
    }
    return true;
}

/// Eight boxes, one member per component.
struct Box8 {
    std::array<simd::Float8, 3> center, halfExtent;
};

/// A frustum prepared for testing eight boxes at a time.
class Frustum8 {
public:
    explicit Frustum8(Frustum const& frustum) {
        for (size_t i = 0; i < frustum.planes.size(); ++i) {
            mPlanes[i] = frustum.planes[i];
            mReaches[i] = glm::abs(float3(frustum.planes[i]));
        }
    }

    /// Bit i: intersects() of box i. The same bits also for NaN and infinities, since the operations have the same
    /// order.
    uint32_t intersects(Box8 const& boxes) const {
        simd::Mask8 outside{};
        for (size_t i = 0; i < mPlanes.size(); ++i) {
            const simd::Float8 distance = simd::dot(float3(mPlanes[i]), boxes.center) + mPlanes[i].w;
            outside = outside | (distance < -simd::dot(mReaches[i], boxes.halfExtent));
        }
        return ~simd::bits8(outside) & 0xFFu;
    }

private:
    std::array<float4, 5> mPlanes;
    std::array<float3, 5> mReaches; // extent of a box along each normal: absolute values
};

inline bool intersectsSphere(Frustum const& frustum, float3 center, float radius) {
    for (float4 const& plane : frustum.planes) {
        if (glm::dot(float3(plane), center) + plane.w < -radius) return false;
    }
    return true;
}

} // namespace filament_core
