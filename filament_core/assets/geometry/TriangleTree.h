// SPDX-License-Identifier: Apache-2.0
/// TriangleTree: the triangles of a mesh in a tree of boxes, which finds the triangle nearest to a point.
///   In      finite positions, which outlive the tree, and three indices for each triangle, one triangle at least.
///   Thread  const functions from any.   Memory: about 40 B a triangle.   Fails: std::bad_alloc.
///   Cost    O(n log n) to build; a query visits a few dozen boxes, or one triangle if that is near enough.
#pragma once

#include "base/math/Math.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets {

/// A point of a triangle: the weights of its corners, which sum to 1.
struct TrianglePoint {
    double3 position{ 0.0 };
    double3 weights{ 0.0 };
};

/// The point of the triangle abc that is nearest to `point`. Ericson 2005, "Real-Time Collision Detection", section
/// 5.1.5.
TrianglePoint nearestPoint(double3 const& point, double3 const& a, double3 const& b, double3 const& c);

class TriangleTree {
public:
    using Triangle = std::array<uint32_t, 3>; ///< numbers of positions

    TriangleTree(std::span<const float3> positions, std::span<const uint32_t> indices);

    /// The least of measure(triangle, nearest point of it) over all triangles, where a measure is at least the distance
    /// of that point; or `enough`, if a triangle has no more than that.
    ///   hint  in: the triangle to try first, below the number of triangles; out: the one that was found.
    template <class Measure>
    double least(float3 const& point, double enough, uint32_t& hint, Measure const& measure) const;

private:
    struct Node {
        float3 min, max;
        uint32_t first = 0; ///< of mTriangles; of other nodes the second child, the first being the next node
        uint32_t count = 0; ///< triangles; 0: the node has children
    };

    uint32_t build(uint32_t begin, uint32_t end);
    Node nodeOf(uint32_t begin, uint32_t end) const;
    double squaredDistance(double3 const& point, Node const& node) const {
        const double3 outside = glm::max(glm::max(double3(node.min) - point, point - double3(node.max)), double3(0.0));
        return glm::dot(outside, outside);
    }
    template <class Measure>
    double measured(double3 const& point, uint32_t triangle, Measure const& measure) const {
        Triangle const& corners = mTriangles[triangle];
        return measure(corners, nearestPoint(point, double3(mPositions[corners[0]]), double3(mPositions[corners[1]]),
                                             double3(mPositions[corners[2]])));
    }

    std::span<const float3> mPositions;
    std::vector<Triangle> mTriangles;
    std::vector<Node> mNodes;
};

template <class Measure>
double TriangleTree::least(float3 const& at, double enough, uint32_t& hint, Measure const& measure) const {
    constexpr size_t kDeepest = 64; // halving 2^32 triangles takes 32 levels
    const double3 point(at);
    double best = measured(point, hint, measure);
    std::array<uint32_t, kDeepest> open;
    size_t count = 0;
    open[count++] = 0;
    while (count > 0 && best > enough) {
        const uint32_t index = open[--count];
        Node const& node = mNodes[index];
        if (!(squaredDistance(point, node) < best * best)) continue;
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const double found = measured(point, i, measure);
            if (found < best) best = found, hint = i;
        }
        if (node.count > 0) continue;
        const bool isSecondNearer =
                squaredDistance(point, mNodes[node.first]) < squaredDistance(point, mNodes[index + 1]);
        open[count++] = isSecondNearer ? index + 1 : node.first;
        open[count++] = isSecondNearer ? node.first : index + 1;
    }
    return std::max(best, enough);
}

} // namespace filament_core::assets
