// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/TriangleTree.h"

#include "base/Assert.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

constexpr uint32_t kTrianglesOfLeaf = 4;

TrianglePoint pointOf(double3 const& a, double3 const& b, double3 const& c, double3 const& weights) {
    return { a * weights.x + b * weights.y + c * weights.z, weights };
}

/// Of a part of a whole that may be nothing.
double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

} // namespace

TrianglePoint nearestPoint(double3 const& point, double3 const& a, double3 const& b, double3 const& c) {
    // Ericson 2004, "Real-Time Collision Detection", section 5.1.5: the regions of corners and edges in this order. A
    // test relies on those before it, so it cannot be moved.
    const double3 ab = b - a, ac = c - a;
    const double3 ap = point - a, bp = point - b, cp = point - c;
    const double abA = glm::dot(ab, ap), acA = glm::dot(ac, ap);
    if (abA <= 0 && acA <= 0) return { a, { 1, 0, 0 } };
    const double abB = glm::dot(ab, bp), acB = glm::dot(ac, bp);
    if (abB >= 0 && acB <= abB) return { b, { 0, 1, 0 } };
    const double areaC = abA * acB - abB * acA;
    if (areaC <= 0 && abA >= 0 && abB <= 0) {
        const double along = share(abA, abA - abB);
        return pointOf(a, b, c, { 1 - along, along, 0 });
    }
    const double abC = glm::dot(ab, cp), acC = glm::dot(ac, cp);
    if (acC >= 0 && abC <= acC) return { c, { 0, 0, 1 } };
    const double areaB = abC * acA - abA * acC;
    if (areaB <= 0 && acA >= 0 && acC <= 0) {
        const double along = share(acA, acA - acC);
        return pointOf(a, b, c, { 1 - along, 0, along });
    }
    const double areaA = abB * acC - abC * acB;
    if (areaA <= 0 && acB - abB >= 0 && abC - acC >= 0) {
        const double along = share(acB - abB, (acB - abB) + (abC - acC));
        return pointOf(a, b, c, { 0, 1 - along, along });
    }
    const double whole = areaA + areaB + areaC;
    const double ofB = share(areaB, whole), ofC = share(areaC, whole);
    return pointOf(a, b, c, { 1 - ofB - ofC, ofB, ofC });
}

TriangleTree::TriangleTree(std::span<const float3> positions, std::span<const uint32_t> indices)
        : mPositions(positions), mTriangles(indices.size() / 3) {
    FILAMENT_ASSERT(!mTriangles.empty(), "a tree has a triangle");
    for (size_t i = 0; i < mTriangles.size(); ++i)
        mTriangles[i] = { indices[3 * i], indices[3 * i + 1], indices[3 * i + 2] };
    mNodes.reserve(mTriangles.size());
    build(0, static_cast<uint32_t>(mTriangles.size()));
}

TriangleTree::Node TriangleTree::nodeOf(uint32_t begin, uint32_t end) const {
    const float3 first = mPositions[mTriangles[begin][0]];
    Node node{ .min = first, .max = first, .first = begin, .count = end - begin };
    for (uint32_t i = begin; i < end; ++i) {
        for (const uint32_t corner : mTriangles[i]) {
            node.min = glm::min(node.min, mPositions[corner]);
            node.max = glm::max(node.max, mPositions[corner]);
        }
    }
    return node;
}

/// Halves by the middles of the triangles along the longest side of their box.
uint32_t TriangleTree::build(uint32_t begin, uint32_t end) {
    const auto number = static_cast<uint32_t>(mNodes.size());
    mNodes.push_back(nodeOf(begin, end));
    if (end - begin <= kTrianglesOfLeaf) return number;
    const float3 size = mNodes[number].max - mNodes[number].min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middleOf = [&](Triangle const& triangle) {
        return mPositions[triangle[0]][axis] + mPositions[triangle[1]][axis] + mPositions[triangle[2]][axis];
    };
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(mTriangles.begin() + begin, mTriangles.begin() + middle, mTriangles.begin() + end,
                     [&](Triangle const& a, Triangle const& b) {
                         const float ofA = middleOf(a), ofB = middleOf(b);
                         // Equal middles are ordered by their indices: std::nth_element() may place equal ones as it
                         // likes, and the tree must be the same with every standard library.
                         return ofA != ofB ? ofA < ofB : a < b;
                     });
    // The first child follows its parent directly, so a node stores only where the second one is.
    build(begin, middle);
    const uint32_t second = build(middle, end);
    mNodes[number].first = second;
    mNodes[number].count = 0;
    return number;
}

} // namespace filament_core::assets
