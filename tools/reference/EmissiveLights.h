// SPDX-License-Identifier: Apache-2.0
/// EmissiveLights: glowing surfaces as lights that can be sampled, so that a lamp of a few triangles is found at once.
///   Method  picks a triangle in proportion to its area times its emission (luminance, the mean of four points on it),
///           then a point uniform in area. A triangle that is dark at those points is never picked. Paths find it by
///           chance, with the full weight, so that images stay unbiased.
///   Source  Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", sections 6.5.4 and 12.2.
///   Unit    radiance as in SurfaceSample::emitted: added to the image without exposure.
///   Memory  40 bytes per emissive triangle, 4 per part. Thread: read-only after construction.
#pragma once

#include "tools/reference/Distribution.h"
#include "tools/reference/Intersector.h"

#include <vector>

namespace filament_core::reference {

struct EmissiveSample {
    double3 direction{ 0.0 }; ///< from the point to the light, unit
    double distance = 0;
    double3 radiance{ 0.0 };
    double pdf = 0; ///< per steradian; 0: no light
};

class EmissiveLights {
public:
    EmissiveLights() = default;
    /// Keeps a reference to `parts`.
    explicit EmissiveLights(std::vector<Part> const& parts);

    bool empty() const { return mTriangles.empty(); }
    /// u in [0, 1)^2, choice in [0, 1).
    EmissiveSample sample(double3 position, double2 u, double choice) const;
    /// Density of sample() for the point that a ray in `direction` (unit) has hit.
    double pdf(Hit const& hit, double3 direction) const;

private:
    struct Triangle {
        uint32_t part = 0, index = 0;
        double area = 0;
    };
    void addPart(uint32_t part, std::vector<double>& weights);
    double density(uint32_t light, double distance, double cosine) const;

    std::vector<Part> const* mParts = nullptr;
    std::vector<Triangle> mTriangles;
    std::vector<uint32_t> mFirstOfPart; // kNone: not emissive; else all triangles, in order
    Distribution mChoice;
};

} // namespace filament_core::reference
