// SPDX-License-Identifier: Apache-2.0
/// Shapes: the triangles of the showcase, generated from formulas.
///   Out     indexed triangles, counter-clockwise seen from outside, smooth unit normals, texture coordinates with v =
///           0 at the top; no tangents (the loader computes them).
///   Thread  any; pure functions.  Units: those of the arguments.
///   Limits  65 536 vertices per shape, asserted: 16-bit indices suffice.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::showcase {

struct Shape {
    std::vector<float3> positions;
    std::vector<float3> normals;
    std::vector<float2> uvs;
    std::vector<float4> colors; ///< linear, one a vertex; empty: none
    std::vector<uint32_t> indices;

    uint32_t triangleCount() const { return static_cast<uint32_t>(indices.size() / 3); }
};

/// Around the origin. `segments` around, half as many from pole to pole; the texture repeats `uvRepeats` times.
Shape sphere(float radius, uint32_t segments, float2 uvRepeats = { 1, 1 });

/// Around the origin, with edges and corners rounded by `radius` in `steps` steps. One unit of length covers
/// `uvPerUnit` of the texture on every side.
Shape roundedBox(float3 halfSize, float radius, uint32_t steps, float uvPerUnit = 1);

/// Around +Y: a circle of `tubeRadius` swept along a circle of `radius` in the xz plane.
Shape torus(float radius, float tubeRadius, uint32_t segments, uint32_t sides);

/// The (p, q) torus knot around +Z, within about `radius` of the origin. Vertex colours run once through the hues.
Shape torusKnot(uint32_t p, uint32_t q, float radius, float tubeRadius, uint32_t segments, uint32_t sides);

/// A surface of revolution around +Y. `profile` holds (distance from the axis, height), with the outside on its right
/// when followed from first to last. Normals average the neighbouring segments, so fine detail needs close points.
Shape lathe(std::span<const float2> profile, uint32_t segments, float2 uvRepeats = { 1, 1 });

/// A smooth curve through `points` with `steps` points per section (uniform Catmull-Rom; the ends are doubled).
std::vector<float2> smoothProfile(std::span<const float2> points, uint32_t steps);

} // namespace filament_core::showcase
