// SPDX-License-Identifier: Apache-2.0
/// Texels: which texels of an atlas a look-up may read, and the point of a surface that each of them stands for.
///   Rule    a texel belongs to the triangle in which its centre lies; else, if it is no further than a texel from a
///           triangle of a chart, to the nearest point of that chart. Bilinear filtering reads these texels, and a few
///           at corners, which stay empty (LightmapImage.h fills them).
///   Out     by row, then by column. Points keep kInset of a triangle's size from its edges: on an edge, a wall that
///           begins there could be on either side.
///   Thread  any; pure.  Cost: texels of the boxes of all triangles.
#pragma once

#include "tools/bake/Atlas.h"

namespace filament_core::bake {

inline constexpr double kInset = 1e-3; ///< least barycentric weight of a point

struct AtlasTexel {
    uint32_t x = 0, y = 0;
    uint32_t chart = 0;    ///< into Atlas::charts
    uint32_t triangle = 0; ///< of the surface
    double u = 0, v = 0;   ///< weights of its second and third corner
    double distance = 0;   ///< texels from its centre to the triangle; 0: the centre lies in it
};

std::vector<AtlasTexel> findTexels(Atlas const& atlas);

/// Moves the point from edges of its triangle, by kInset.
void keepInside(AtlasTexel& texel);

/// A point of a surface in the world.
struct SurfacePoint {
    double3 position{ 0.0 };
    double3 normal{ 0, 0, 1 }, faceNormal{ 0, 0, 1 }; ///< unit, on the same side
    double longestEdge = 0;                           ///< metres, of its triangle
    double coverMeters = 0;                           ///< what is nearer covers the point: a poster on a wall
};

SurfacePoint pointOf(BakeSurface const& surface, AtlasTexel const& texel);

} // namespace filament_core::bake
