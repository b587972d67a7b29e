// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/meshfiles/PolygonTriangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace filament_core::assets {

std::span<const std::array<uint32_t, 3>> PolygonTriangles::of(std::span<const float3> corners) {
    mTriangles.clear();
    mCorners.resize(corners.size());
    std::iota(mCorners.begin(), mCorners.end(), 0u);
    if (corners.size() > 3) project(corners);
    if (corners.size() == 3 || isFan()) {
        addFan(mCorners);
    } else {
        cutEars();
    }
    return mTriangles;
}

void PolygonTriangles::project(std::span<const float3> corners) {
    double3 normal(0.0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const double3 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        normal += double3((a.y - b.y) * (a.z + b.z), (a.z - b.z) * (a.x + b.x), (a.x - b.x) * (a.y + b.y));
    }
    // without the axis along which the polygon is seen largest; the other two in the order that keeps its direction
    const double3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const bool isAhead = normal[axis] >= 0;
    const int u = (axis + (isAhead ? 1 : 2)) % 3, v = (axis + (isAhead ? 2 : 1)) % 3;
    mPoints.clear();
    for (float3 const& corner : corners) mPoints.emplace_back(double(corner[u]), double(corner[v]));
}

double PolygonTriangles::area(uint32_t a, uint32_t b, uint32_t c) const {
    const double2 ab = mPoints[b] - mPoints[a], ac = mPoints[c] - mPoints[a];
    return ab.x * ac.y - ab.y * ac.x;
}

bool PolygonTriangles::isFan() const {
    for (uint32_t corner = 2; corner < mPoints.size(); ++corner)
        if (area(0, corner - 1, corner) < 0) return false;
    return true;
}

void PolygonTriangles::addFan(std::span<const uint32_t> corners) {
    for (size_t i = 2; i < corners.size(); ++i) mTriangles.push_back({ corners[0], corners[i - 1], corners[i] });
}

/// `mayTouch`: other corners may lie on its sides, as where a polygon touches itself.
bool PolygonTriangles::isEar(size_t place, bool mayTouch) {
    const size_t count = mCorners.size();
    const uint32_t a = mCorners[(place + count - 1) % count], b = mCorners[place], c = mCorners[(place + 1) % count];
    mSteps += 1;
    if (!(area(a, b, c) > 0)) return false;
    mSteps += count;
    for (const uint32_t other : mCorners) {
        const double2 point = mPoints[other];
        if (point == mPoints[a] || point == mPoints[b] || point == mPoints[c]) continue;
        const double least = std::min({ area(a, b, other), area(b, c, other), area(c, a, other) });
        if (mayTouch ? least > 0 : least >= 0) return false;
    }
    return true;
}

void PolygonTriangles::cutEars() {
    size_t place = 1, misses = 0;
    while (mCorners.size() > 3 && misses < 2 * mCorners.size() && mSteps < kMostSteps) {
        const size_t count = mCorners.size();
        place %= count;
        if (!isEar(place, misses >= count)) {
            ++place, ++misses;
            continue;
        }
        mTriangles.push_back({ mCorners[(place + count - 1) % count], mCorners[place], mCorners[(place + 1) % count] });
        mCorners.erase(mCorners.begin() + static_cast<ptrdiff_t>(place));
        ++place; // not the neighbour: ears all around make fewer slivers
        misses = 0;
    }
    addFan(mCorners);
}

} // namespace filament_core::assets
