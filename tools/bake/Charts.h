// SPDX-License-Identifier: Apache-2.0
/// Charts: a mesh cut into flat pieces, each of which lies in a plane without overlapping itself.
///   In      positions in metres and triangles; any mesh, also one with holes, equal or degenerate triangles, or more
///           than two triangles at an edge.
///   Out     each triangle in exactly one chart, with the places of its corners in the chart's plane, in metres.
///   Method  a chart grows from the largest triangle that is left, over edges whose ends have equal positions, and is
///           projected along the normal of that triangle. A neighbour joins if its normal is close to it and if its
///           projection overlaps no triangle of the chart. After that the chart is turned so that its box is small.
///   Error   areas shrink by the cosine between normal and projection, at worst by `leastCosine`; angles as much.
///   Limits  triangles without an area (below 1e-12 of the square of the mesh's size) have a place in the chart of a
///           neighbour or, if they have none, a chart of their own that is a point.
///   Thread  any; pure: the same charts for the same mesh.  Memory: about 200 bytes a triangle.
///   Cost    triangles times those of the chart in the same cell of a grid, of which there are few.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::bake {

struct ChartOptions {
    double leastCosine = 0.8; ///< (0, 1]: between the normals of a chart's triangles and its projection
};

struct Chart {
    std::vector<uint32_t> triangles; ///< of the mesh, in the order in which they joined
    std::vector<double2> corners;    ///< metres; three for each of them; the smallest coordinates are 0
    double2 size{ 0.0 };             ///< metres
};

/// `indices`: three for each triangle, each below positions.size().
std::vector<Chart> makeCharts(std::span<const double3> positions, std::span<const uint32_t> indices,
                              ChartOptions const& options = {});

/// Twice the area of a triangle in a plane; positive: counter-clockwise.
double doubleArea(double2 a, double2 b, double2 c);

/// Whether two counter-clockwise triangles share more than a border of `tolerance` metres.
bool overlap(std::span<const double2, 3> a, std::span<const double2, 3> b, double tolerance);

} // namespace filament_core::bake
