// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PixelGrid.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

using simd::Float4;
using simd::Float8;

float4 rowOf(float4x4 const& matrix, int row) {
    return { matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row] };
}

/// One coordinate of the eight corners.
Float8 cornersOf(float center, float halfExtent, int axis) {
    const float low = center - halfExtent, high = center + halfExtent;
    if (axis == 0) return { Float4{ low, high, low, high }, Float4{ low, high, low, high } };
    if (axis == 1) return { Float4{ low, low, high, high }, Float4{ low, low, high, high } };
    return { Float4{ low, low, low, low }, Float4{ high, high, high, high } };
}

struct Interval {
    float least, most;
};

Interval intervalOf(Float8 const& lanes) {
    std::array<float, simd::kLanes> all;
    simd::store8(all, lanes);
    Interval interval{ all[0], all[0] };
    for (const float value : all) {
        interval.least = std::min(interval.least, value);
        interval.most = std::max(interval.most, value);
    }
    return interval;
}

/// Of pixels from -1 to 1 that are `halfSize` * 2 wide: whether a centre lies in the interval. NaN: yes.
bool containsCenter(Interval ndc, float halfSize) {
    const float least = ndc.least * halfSize + (halfSize - PixelGrid::kMarginPixels - 0.5f);
    const float most = ndc.most * halfSize + (halfSize + PixelGrid::kMarginPixels - 0.5f);
    return !(std::ceil(least) > std::floor(most));
}

} // namespace

PixelGrid::PixelGrid(float4x4 const& clipFromWorld, uint2 size)
        : mX(float3(rowOf(clipFromWorld, 0))), mY(float3(rowOf(clipFromWorld, 1))), mW(float3(rowOf(clipFromWorld, 3))),
          mOffset(rowOf(clipFromWorld, 0).w, rowOf(clipFromWorld, 1).w, rowOf(clipFromWorld, 3).w),
          mHalfSize(float2(size) * 0.5f), mSquaredScale(std::max(glm::dot(mX, mX) * mHalfSize.x * mHalfSize.x,
                                                                 glm::dot(mY, mY) * mHalfSize.y * mHalfSize.y)) {}

uint32_t PixelGrid::mayMiss8(std::array<Float8, 3> const& center, std::array<Float8, 3> const& halfExtent) const {
    if (isEmpty()) return 0;
    // The radius is less than a pixel, compared as squares: this runs for every box of the scene, and needs neither a
    // root nor a division.
    const Float8 w = simd::dot(mW, center) + mOffset.z;
    const Float8 squaredRadius =
            halfExtent[0] * halfExtent[0] + halfExtent[1] * halfExtent[1] + halfExtent[2] * halfExtent[2];
    return simd::bits8(squaredRadius * mSquaredScale < w * w);
}

bool PixelGrid::missesAll(float3 center, float3 halfExtent) const {
    const float w0 = glm::dot(mW, center) + mOffset.z;
    if (!(glm::dot(halfExtent, halfExtent) * mSquaredScale < w0 * w0)) return false;
    const std::array<Float8, 3> corners{ cornersOf(center.x, halfExtent.x, 0), cornersOf(center.y, halfExtent.y, 1),
                                         cornersOf(center.z, halfExtent.z, 2) };
    const Float8 w = simd::dot(mW, corners) + mOffset.z;
    if (!(intervalOf(w).least > 1e-6f)) return false; // beside or behind the camera
    const Interval x = intervalOf((simd::dot(mX, corners) + mOffset.x) / w);
    const Interval y = intervalOf((simd::dot(mY, corners) + mOffset.y) / w);
    return !containsCenter(x, mHalfSize.x) || !containsCenter(y, mHalfSize.y);
}

} // namespace filament_core::prepare
