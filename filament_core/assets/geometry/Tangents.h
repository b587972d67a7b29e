// SPDX-License-Identifier: Apache-2.0
/// Tangents: per-vertex tangents as MikkTSpace defines them, so that normal maps baked elsewhere look right here.
///   Source   M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, chapter 4 and appendix A; required by
///            glTF 2.0 section 3.7.2.1. Own implementation.
///   Method   1. every triangle gets dP/du and its orientation (mirrored texture or not);
///            2. corners with equal position, normal and texture coordinate are one vertex, triangles that share an
///               edge of it are neighbours;
///            3. around a vertex, neighbours of one orientation form a group: across a mirror seam, or a hole, another;
///            4. a group's tangent is the mean of its triangles' dP/du in the plane of the normal, weighted by the
///               angle of the corner, so that the triangulation of flat polygons does not matter;
///            5. an input vertex whose corners fell into several groups is split.
///   In       a triangle list, indices in range, normals of unit length, all finite. v points down (glTF).
///   Out      tangents with w = +1 or -1: bitangent = cross(normal, tangent) * w points towards -v. A group without a
///            usable texture gradient gets an arbitrary tangent perpendicular to the normal.
///   Thread   any, no shared state. The same bits on every run.
///   Memory   about 60 B per corner while it runs.
///   Cost     bench/filament_core/assets/GltfBench.cpp
#pragma once

#include "base/math/Math.h"

#include <span>
#include <vector>

namespace filament_core::assets {

struct TangentInput {
    std::span<const float3> positions, normals;
    std::span<const float2> uvs;
    std::span<const uint32_t> indices; ///< of triangles
};

struct TangentOutput {
    std::vector<float4> tangents;  ///< per output vertex
    std::vector<uint32_t> sources; ///< input vertex of each output vertex; the first ones are the input's, in order
    std::vector<uint32_t> indices; ///< same triangles, output vertices
};

TangentOutput generateTangents(TangentInput const& input);

} // namespace filament_core::assets
