// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/OccluderMesh.h"

#include "base/Assert.h"
#include "filament_core/scene/VertexPositions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

namespace filament_core {
namespace {

constexpr uint32_t kMostTriangles = 4096; // so that 16 bits number their corners

struct SizedTriangle {
    double area = 0;
    uint32_t first = 0; ///< of the indices
};

double areaOf(float3 a, float3 b, float3 c) {
    const double area = glm::length(glm::cross(double3(b) - double3(a), double3(c) - double3(a))) / 2;
    return std::isfinite(area) ? area : 0;
}

/// The `most` largest first.
std::vector<SizedTriangle> trianglesBySize(std::span<const float3> positions, std::span<const uint32_t> indices,
                                           uint32_t most) {
    std::vector<SizedTriangle> sized;
    sized.reserve(indices.size() / 3);
    for (uint32_t i = 0; i + 3 <= indices.size(); i += 3) {
        const double area = areaOf(positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]);
        if (area > 0) sized.push_back({ area, i });
    }
    std::ranges::partial_sort(sized, sized.begin() + static_cast<ptrdiff_t>(std::min<size_t>(sized.size(), most)),
                              [](SizedTriangle const& a, SizedTriangle const& b) {
                                  // Equal areas in the order of the mesh, so that every standard library keeps the same
                                  // triangles.
                                  return a.area != b.area ? a.area > b.area : a.first < b.first;
                              });
    return sized;
}

/// Corners of equal position are one: neighbours with different normals meet there without a gap.
class Corners {
public:
    explicit Corners(std::vector<float3>& positions) : mPositions(positions) {}

    uint16_t numberOf(float3 at) {
        const std::array<uint32_t, 3> bits{ std::bit_cast<uint32_t>(at.x + 0.0f), std::bit_cast<uint32_t>(at.y + 0.0f),
                                            std::bit_cast<uint32_t>(at.z + 0.0f) }; // -0 is 0
        const auto [known, isNew] = mNumbers.try_emplace(bits, static_cast<uint16_t>(mPositions.size()));
        if (isNew) mPositions.push_back(at);
        return known->second;
    }

private:
    std::vector<float3>& mPositions;
    std::map<std::array<uint32_t, 3>, uint16_t> mNumbers;
};

/// Two triangles are neighbours if they alone have an edge, in opposite directions.
void connect(std::vector<OccluderMesh::Triangle>& triangles) {
    struct Edge {
        uint32_t users = 0, triangle = 0, side = 0;
    };
    std::map<std::pair<uint16_t, uint16_t>, Edge> edges;
    const auto edgeOf = [&](uint32_t triangle, uint32_t side) {
        auto const& corners = triangles[triangle].corners;
        return std::pair(corners[side], corners[(side + 1) % 3]);
    };
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        for (uint32_t side = 0; side < 3; ++side) {
            Edge& edge = edges[edgeOf(i, side)];
            edge = { edge.users + 1, i, side };
        }
    }
    for (auto const& [corners, edge] : edges) {
        const auto other = edges.find({ corners.second, corners.first });
        const bool isShared = edge.users == 1 && other != edges.end() && other->second.users == 1;
        if (isShared) triangles[edge.triangle].neighbors[edge.side] = static_cast<uint16_t>(other->second.triangle);
    }
}

} // namespace

Occluder scene::occluderOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices,
                           backend::IndexFormat format, std::span<const std::byte> indices) {
    constexpr size_t kMostIndices = 3 * 65536;
    const bool isSmall = format == backend::IndexFormat::UInt16;
    if (indices.size() / (isSmall ? 2 : 4) > kMostIndices) return {};
    const std::vector<float3> positions = positionsOf(layout, vertices);
    if (positions.empty()) return {};
    return makeOccluder(positions, indicesOf(format, indices));
}

Occluder makeOccluder(std::span<const float3> positions, std::span<const uint32_t> indices, uint32_t maxTriangles) {
    FILAMENT_ASSERT(maxTriangles <= kMostTriangles, "an occluder has at most 4096 triangles");
    std::vector<SizedTriangle> sized = trianglesBySize(positions, indices, maxTriangles);
    double all = 0, kept = 0;
    for (SizedTriangle const& triangle : sized) all += triangle.area;
    if (sized.size() > maxTriangles) sized.resize(maxTriangles);
    for (SizedTriangle const& triangle : sized) kept += triangle.area;
    if (sized.empty() || kept < all / 2) return {};

    auto mesh = std::make_shared<OccluderMesh>();
    Corners corners(mesh->positions);
    for (SizedTriangle const& triangle : sized) {
        OccluderMesh::Triangle& added = mesh->triangles.emplace_back();
        added.neighbors.fill(OccluderMesh::kNone);
        for (uint32_t i = 0; i < 3; ++i) added.corners[i] = corners.numberOf(positions[indices[triangle.first + i]]);
    }
    connect(mesh->triangles);
    return mesh;
}

} // namespace filament_core
