// SPDX-License-Identifier: Apache-2.0
/// PolygonTriangles: triangles of a flat polygon without holes, which may be concave.
///   How     a fan from the first corner where that covers the polygon, as of all convex ones; otherwise ears are cut
///           off (Meisters 1975, "Polygons have ears"), seen along the normal of Newell's method (Tampieri 1992).
///   Result  corners - 2 triangles, in the polygon's direction, each of three places of corners. Polygons that cross
///           themselves or have no area get that many too, of which some overlap.
///   Cost    O(n) of fans, O(n^2) to O(n^3) of others. After kMostSteps looks at corners (some 10 s) an object makes
///           fans alone, so that no file takes forever.
///   Thread  any; an object at a time.
#pragma once

#include <filament_core/Math.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets {

class PolygonTriangles {
public:
    static constexpr uint64_t kMostSteps = uint64_t{ 1 } << 30;

    /// `corners`: three at least, finite. Valid until the next call.
    std::span<const std::array<uint32_t, 3>> of(std::span<const float3> corners);

private:
    void project(std::span<const float3> corners);
    bool isFan() const;
    void addFan(std::span<const uint32_t> corners);
    void cutEars();
    bool isEar(size_t place, bool mayTouch);
    /// Twice the area of the triangle; positive in the polygon's direction.
    double area(uint32_t a, uint32_t b, uint32_t c) const;

    std::vector<double2> mPoints;   ///< of the corners, in the plane
    std::vector<uint32_t> mCorners; ///< that no ear has taken
    std::vector<std::array<uint32_t, 3>> mTriangles;
    uint64_t mSteps = 0; ///< of all polygons so far
};

} // namespace filament_core::assets
