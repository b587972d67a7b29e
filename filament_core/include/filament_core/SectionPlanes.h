// SPDX-License-Identifier: Apache-2.0
/// SectionPlanes: planes that cut open what a view shows (View::section): models that were loaded with
/// GltfLoadOptions::sectionPlanes, and materials with `sectionPlanes : true`. docs/sections.md.
///   Thread  any; a plain value.   Fails: never; a plane without a direction, or with a number that is not finite, cuts
///           nothing.
#pragma once

#include <filament_core/EnumNames.h>
#include <filament_core/Math.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace filament_core {

/// What several planes leave.
enum class SectionCut : uint8_t {
    Each,   ///< what lies in front of all planes: a slab, a box
    Corner, ///< what lies in front of any plane: a corner is cut out
};
template <>
struct EnumNames<SectionCut> {
    static constexpr std::array<std::string_view, 2> values{ "each", "corner" };
};

struct SectionPlanes {
    static constexpr size_t kMost = 6;
    /// A point p of the world, in metres, is in front of a plane where dot(xyz, p) + w >= 0. xyz is of any length; the
    /// zero vector: none.
    std::array<double4, kMost> planes{ double4(0), double4(0), double4(0), double4(0), double4(0), double4(0) };
    SectionCut cut = SectionCut::Each;
    bool caps = true;                       ///< solids are closed where they are cut; false: their inner sides are seen
    float4 capColor{ 0.5f, 0.5f, 0.5f, 0 }; ///< linear base colour of caps, [0, 1]; a: its share, the rest is that of
                                            ///< each material
    float hatchMeters = 0;                  ///< distance between hatching lines on caps, [0, 1e6]; 0: none
    float hatchWidth = 0.2f;                ///< of a line, as a share of that distance, [0, 1]
    float3 hatchColor{ 0.02f };             ///< linear base colour of the lines, [0, 1]

    /// A plane that cuts: with a direction, and finite.
    static bool isPlane(double4 const& plane) {
        const double squared = plane.x * plane.x + plane.y * plane.y + plane.z * plane.z;
        return squared > 0 && std::isfinite(squared) && std::isfinite(plane.w);
    }
    /// At least one plane cuts.
    bool isUsed() const {
        for (double4 const& plane : planes)
            if (isPlane(plane)) return true;
        return false;
    }
    friend bool operator==(SectionPlanes const&, SectionPlanes const&) = default;
};

/// The plane through a point of the world that keeps what lies in the direction of `normal`, which has any length.
inline double4 sectionPlane(double3 const& pointWorld, double3 const& normal) {
    return double4(normal, -dot(normal, pointWorld));
}

} // namespace filament_core
