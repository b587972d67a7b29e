// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/Tangents.h"

#include "base/Hash.h"
#include "base/math/Elementary.h"
#include "filament_core/assets/files/NoIndex.h"
#include "filament_core/assets/geometry/TangentFrame.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::assets {
namespace {

constexpr uint32_t kCorners = 3;

bool isNotZero(float value) { return std::abs(value) > std::numeric_limits<float>::min(); }

uint32_t nextCorner(uint32_t corner) { return corner % kCorners == 2 ? corner - 2 : corner + 1; }
uint32_t previousCorner(uint32_t corner) { return corner % kCorners == 0 ? corner + 2 : corner - 1; }

struct Triangle {
    float3 dPdu{ 0.0f };          ///< unit, towards growing u
    bool keepsOrientation = true; ///< the texture is not mirrored
    bool hasGradient = false;     ///< dPdu is usable; otherwise the triangle joins any group
    bool isDegenerate = false;    ///< two corners in one place: no surface, takes its tangents from others
};

/// Mikkelsen 2008: vertices are merged if all inputs of the computation have equal bits. Returns a representative for
/// every input vertex.
std::vector<uint32_t> weldVertices(TangentInput const& input) {
    struct Key {
        float3 position, normal;
        float2 uv;
    };
    static_assert(sizeof(Key) == 32);
    const auto keyOf = [&](size_t i) {
        // adding 0 turns -0 into +0: they are the same position
        return Key{ input.positions[i] + 0.0f, input.normals[i] + 0.0f, input.uvs[i] + 0.0f };
    };
    const size_t count = input.positions.size();
    size_t slots = 16;
    while (slots < count * 2) slots *= 2;
    std::vector<uint32_t> table(slots, kNone); // open addressing
    std::vector<uint32_t> welded(count);
    for (size_t i = 0; i < count; ++i) {
        const Key key = keyOf(i);
        size_t slot = hashBytes(std::as_bytes(std::span(&key, 1))) & (slots - 1);
        while (table[slot] != kNone) {
            const Key other = keyOf(table[slot]);
            if (std::memcmp(&key, &other, sizeof key) == 0) break;
            slot = (slot + 1) & (slots - 1);
        }
        if (table[slot] == kNone) table[slot] = static_cast<uint32_t>(i);
        welded[i] = table[slot];
    }
    return welded;
}

/// Appendix A: the gradient of the texture coordinates over the triangle. v is negated: glTF's points down.
Triangle describeTriangle(TangentInput const& input, uint32_t const* corners) {
    Triangle triangle;
    const float3 p0 = input.positions[corners[0]], p1 = input.positions[corners[1]], p2 = input.positions[corners[2]];
    triangle.isDegenerate = p0 == p1 || p1 == p2 || p2 == p0;
    const float2 t0 = input.uvs[corners[0]], t1 = input.uvs[corners[1]], t2 = input.uvs[corners[2]];
    const float2 t21(t1.x - t0.x, t0.y - t1.y), t31(t2.x - t0.x, t0.y - t2.y);
    const float area = t21.x * t31.y - t21.y * t31.x; // twice the signed area in the texture
    if (!isNotZero(area)) return triangle;
    triangle.keepsOrientation = area > 0;
    const float3 d1 = p1 - p0, d2 = p2 - p0;
    const float3 du = t31.y * d1 - t21.y * d2, dv = t21.x * d2 - t31.x * d1;
    const float lengthU = std::sqrt(glm::dot(du, du)), lengthV = std::sqrt(glm::dot(dv, dv));
    const float magnitudeU = lengthU / std::abs(area), magnitudeV = lengthV / std::abs(area);
    triangle.hasGradient =
            isNotZero(magnitudeU) && isNotZero(magnitudeV) && std::isfinite(lengthU) && std::isfinite(lengthV);
    if (triangle.hasGradient) triangle.dPdu = du * ((area > 0 ? 1.0f : -1.0f) / lengthU);
    return triangle;
}

/// For each corner c: the corner of the neighbouring triangle at which the shared edge (c, next of c) starts there, or
/// kNone. An edge used in opposite directions pairs two triangles in the order of the corners; a third triangle gets no
/// partner.
std::vector<uint32_t> findNeighbors(std::vector<uint32_t> const& vertices, std::vector<Triangle> const& triangles) {
    struct Edge {
        uint32_t low, high, corner;
    };
    std::vector<Edge> edges;
    edges.reserve(vertices.size());
    for (uint32_t c = 0; c < vertices.size(); ++c) {
        if (triangles[c / kCorners].isDegenerate) continue;
        const uint32_t a = vertices[c], b = vertices[nextCorner(c)];
        edges.push_back({ std::min(a, b), std::max(a, b), c });
    }
    // With the corner as the last key the order is total: it must not depend on the standard library.
    std::sort(edges.begin(), edges.end(), [](Edge const& a, Edge const& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    std::vector<uint32_t> neighbors(vertices.size(), kNone), waiting; // edges of one run without a partner
    size_t oldest = 0;
    for (size_t i = 0; i < edges.size(); ++i) {
        const bool isNewRun = i == 0 || edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high;
        if (isNewRun) waiting.clear(), oldest = 0;
        const uint32_t corner = edges[i].corner;
        // all waiting edges have the same direction: opposite ones would have been paired
        if (oldest == waiting.size() || vertices[waiting[oldest]] == vertices[corner]) {
            waiting.push_back(corner);
            continue;
        }
        neighbors[corner] = waiting[oldest];
        neighbors[waiting[oldest++]] = corner;
    }
    return neighbors;
}

struct Groups {
    std::vector<uint32_t> ofCorner;             ///< kNone: only corners of degenerate triangles
    std::vector<uint32_t> corners, firstCorner; ///< corners of group g: [firstCorner[g], firstCorner[g + 1])
    std::vector<bool> keepsOrientation;
};

/// Adds all corners that can be reached from `seed` around its vertex within the same orientation.
void growGroup(uint32_t seed, uint32_t group, std::vector<uint32_t> const& neighbors, std::vector<Triangle>& triangles,
               std::vector<bool>& isAdopted, Groups& groups, std::vector<uint32_t>& open) {
    const bool orientation = triangles[seed / kCorners].keepsOrientation;
    open.assign(1, seed);
    while (!open.empty()) {
        const uint32_t corner = open.back();
        open.pop_back();
        const uint32_t face = corner / kCorners;
        if (groups.ofCorner[corner] != kNone) continue;
        // a triangle without a gradient takes the orientation of the first group that reaches it
        if (!triangles[face].hasGradient && !isAdopted[face]) triangles[face].keepsOrientation = orientation;
        if (triangles[face].keepsOrientation != orientation) continue;
        isAdopted[face] = true;
        groups.ofCorner[corner] = group;
        groups.corners.push_back(corner);
        // the edge that leaves the vertex here arrives at it in the neighbour, and vice versa
        if (const uint32_t n = neighbors[corner]; n != kNone) open.push_back(nextCorner(n));
        if (const uint32_t n = neighbors[previousCorner(corner)]; n != kNone) open.push_back(n);
    }
}

/// Groups start at triangles with a gradient; corners that those do not reach get groups of their own afterwards.
Groups buildGroups(std::vector<uint32_t> const& neighbors, std::vector<Triangle>& triangles) {
    Groups groups;
    groups.ofCorner.assign(neighbors.size(), kNone);
    groups.corners.reserve(neighbors.size());
    std::vector<bool> isAdopted(triangles.size(), false);
    std::vector<uint32_t> open;
    for (const bool withGradient : { true, false }) {
        for (uint32_t corner = 0; corner < neighbors.size(); ++corner) {
            Triangle const& triangle = triangles[corner / kCorners];
            if (triangle.isDegenerate || triangle.hasGradient != withGradient || groups.ofCorner[corner] != kNone)
                continue;
            groups.firstCorner.push_back(static_cast<uint32_t>(groups.corners.size()));
            groups.keepsOrientation.push_back(triangle.keepsOrientation);
            const auto group = static_cast<uint32_t>(groups.firstCorner.size() - 1);
            growGroup(corner, group, neighbors, triangles, isAdopted, groups, open);
        }
    }
    groups.firstCorner.push_back(static_cast<uint32_t>(groups.corners.size()));
    return groups;
}

float3 inPlane(float3 vector, float3 normal) {
    return normalizedOr(vector - normal * glm::dot(normal, vector), float3(0.0f));
}

/// The mean of the triangles' gradients in the plane of the normal, weighted by the corner angles in that plane.
float4 groupTangent(uint32_t group, TangentInput const& input, Groups const& groups,
                    std::vector<uint32_t> const& vertices, std::vector<Triangle> const& triangles) {
    const std::span<const uint32_t> corners(groups.corners.data() + groups.firstCorner[group],
                                            groups.firstCorner[group + 1] - groups.firstCorner[group]);
    const uint32_t vertex = vertices[corners.front()];
    const float3 normal = input.normals[vertex], position = input.positions[vertex];
    float3 sum(0.0f);
    for (const uint32_t corner : corners) {
        Triangle const& triangle = triangles[corner / kCorners];
        if (!triangle.hasGradient) continue;
        const float3 a = inPlane(input.positions[vertices[previousCorner(corner)]] - position, normal);
        const float3 b = inPlane(input.positions[vertices[nextCorner(corner)]] - position, normal);
        const float angle = elementary::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
        sum += angle * inPlane(triangle.dPdu, normal);
    }
    return float4(normalizedOr(sum, anyTangent(normal)), groups.keepsOrientation[group] ? 1.0f : -1.0f);
}

/// A corner of a degenerate triangle joins a group of the same merged vertex, if there is one.
void adoptDegenerateCorners(std::vector<uint32_t> const& vertices, Groups& groups) {
    std::vector<uint32_t> groupOfVertex(vertices.empty() ? 0 : *std::max_element(vertices.begin(), vertices.end()) + 1,
                                        kNone);
    // Backwards, so that the group of a vertex's first corner is what remains.
    for (size_t c = vertices.size(); c-- > 0;) {
        if (groups.ofCorner[c] != kNone) groupOfVertex[vertices[c]] = groups.ofCorner[c];
    }
    for (size_t c = 0; c < vertices.size(); ++c) {
        if (groups.ofCorner[c] == kNone) groups.ofCorner[c] = groupOfVertex[vertices[c]];
    }
}

/// All corners, grouped; corners without a group come last.
std::vector<uint32_t> cornersByGroup(Groups const& groups) {
    const size_t groupCount = groups.keepsOrientation.size();
    const auto bucketOf = [&](uint32_t group) { return group == kNone ? groupCount : group; };
    std::vector<uint32_t> next(groupCount + 2, 0); // the next free place of each bucket
    for (const uint32_t group : groups.ofCorner) ++next[bucketOf(group) + 1];
    for (size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    std::vector<uint32_t> ordered(groups.ofCorner.size());
    for (uint32_t c = 0; c < ordered.size(); ++c) ordered[next[bucketOf(groups.ofCorner[c])]++] = c;
    return ordered;
}

/// Step 5: the first group of an input vertex keeps its index, other groups get copies at the end.
TangentOutput splitVertices(TangentInput const& input, Groups const& groups, std::vector<float4> const& groupTangents) {
    TangentOutput output;
    const size_t count = input.positions.size();
    for (uint32_t i = 0; i < count; ++i) {
        output.sources.push_back(i);
        output.tangents.emplace_back(anyTangent(input.normals[i]), 1.0f); // for vertices that no triangle uses
    }
    output.indices.assign(input.indices.begin(), input.indices.end());
    std::vector<uint32_t> lastGroup(count, kNone), outputVertex(count); // per input vertex, in this group
    for (const uint32_t corner : cornersByGroup(groups)) {
        const uint32_t group = groups.ofCorner[corner], vertex = input.indices[corner];
        if (group == kNone) break; // the rest keeps its vertices
        if (lastGroup[vertex] != group) {
            const bool isFirst = lastGroup[vertex] == kNone;
            outputVertex[vertex] = isFirst ? vertex : static_cast<uint32_t>(output.sources.size());
            if (isFirst) {
                output.tangents[vertex] = groupTangents[group];
            } else {
                output.sources.push_back(vertex);
                output.tangents.push_back(groupTangents[group]);
            }
            lastGroup[vertex] = group;
        }
        output.indices[corner] = outputVertex[vertex];
    }
    return output;
}

} // namespace

TangentOutput generateTangents(TangentInput const& input) {
    const std::vector<uint32_t> welded = weldVertices(input);
    std::vector<uint32_t> vertices(input.indices.size());
    for (size_t c = 0; c < vertices.size(); ++c) vertices[c] = welded[input.indices[c]];
    std::vector<Triangle> triangles(vertices.size() / kCorners);
    for (size_t t = 0; t < triangles.size(); ++t) triangles[t] = describeTriangle(input, &vertices[t * kCorners]);

    const std::vector<uint32_t> neighbors = findNeighbors(vertices, triangles);
    Groups groups = buildGroups(neighbors, triangles);
    std::vector<float4> tangents(groups.keepsOrientation.size());
    for (uint32_t g = 0; g < tangents.size(); ++g) tangents[g] = groupTangent(g, input, groups, vertices, triangles);
    // After the tangents are known: a triangle without area contributes none, it only follows.
    adoptDegenerateCorners(vertices, groups);
    return splitVertices(input, groups, tangents);
}

} // namespace filament_core::assets
