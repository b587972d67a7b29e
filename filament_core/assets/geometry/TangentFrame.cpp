// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/TangentFrame.h"

#include <algorithm>
#include <cmath>

namespace filament_core::assets {
namespace {

constexpr float kScale = 32767.0f;

/// Shepperd 1978, "Quaternion from rotation matrix": divides by the largest of the four components, so that the others
/// lose no digits. Columns x, y, z are orthonormal and right-handed. Returns (x, y, z, w).
float4 quaternionFromBasis(float3 x, float3 y, float3 z) {
    const float trace = x.x + y.y + z.z;
    if (trace >= std::max({ x.x, y.y, z.z })) {
        const float s = 2.0f * std::sqrt(std::max(1.0f + trace, 0.0f)); // 4 w
        return { (y.z - z.y) / s, (z.x - x.z) / s, (x.y - y.x) / s, 0.25f * s };
    }
    if (x.x >= y.y && x.x >= z.z) {
        const float s = 2.0f * std::sqrt(std::max(1.0f + x.x - y.y - z.z, 0.0f)); // 4 x
        return { 0.25f * s, (x.y + y.x) / s, (z.x + x.z) / s, (y.z - z.y) / s };
    }
    if (y.y >= z.z) {
        const float s = 2.0f * std::sqrt(std::max(1.0f + y.y - x.x - z.z, 0.0f)); // 4 y
        return { (x.y + y.x) / s, 0.25f * s, (y.z + z.y) / s, (z.x - x.z) / s };
    }
    const float s = 2.0f * std::sqrt(std::max(1.0f + z.z - x.x - y.y, 0.0f)); // 4 z
    return { (z.x + x.z) / s, (y.z + z.y) / s, 0.25f * s, (x.y - y.x) / s };
}

} // namespace

float3 anyTangent(float3 normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    return { 1.0f + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a, -sign * normal.x };
}

float3 normalizedOr(float3 vector, float3 fallback) {
    const float largest = std::max({ std::abs(vector.x), std::abs(vector.y), std::abs(vector.z) });
    const bool isFinite = std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
    if (!isFinite || !(largest > 1e-30f)) return fallback;
    const float3 scaled = vector / largest; // so that the square neither vanishes nor overflows
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

float4 tangentFrameQuaternion(float3 normal, float3 tangent, float handedness, float leastW) {
    const float3 z = normalizedOr(normal, float3(0, 0, 1));
    const float3 unit = normalizedOr(tangent, z);
    const float3 inPlane = unit - z * glm::dot(z, unit);
    const bool isParallel = glm::dot(inPlane, inPlane) < 1e-8f; // only rounding error remains
    const float3 x = isParallel ? anyTangent(z) : normalizedOr(inPlane, anyTangent(z));
    float4 q = quaternionFromBasis(x, glm::cross(z, x), z);
    if (q.w < 0) q = -q;
    if (q.w < leastW) { // keep it a unit quaternion
        q *= std::sqrt(1.0f - leastW * leastW);
        q.w = leastW;
    }
    return glm::clamp(handedness < 0 ? -q : q, -1.0f, 1.0f);
}

std::array<int16_t, 4> encodeTangentFrame(float3 normal, float3 tangent, float handedness) {
    const float4 q = tangentFrameQuaternion(normal, tangent, handedness, 1.0f / kScale);
    std::array<int16_t, 4> encoded;
    for (size_t i = 0; i < 4; ++i) encoded[i] = static_cast<int16_t>(std::lround(q[static_cast<int>(i)] * kScale));
    return encoded;
}

} // namespace filament_core::assets
