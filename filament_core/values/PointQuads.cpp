// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"
#include "base/math/Half.h"

#include <filament_core/Points.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace filament_core {
namespace {

bool isFinitePoint(double3 point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }

Box boxOf(std::span<const double3> positions, std::span<const uint32_t> points) {
    Box box;
    for (const uint32_t point : points) box.add({ positions[point], positions[point] });
    return box;
}

/// Cuts the longest side, so that only the last of all groups may be smaller than the others. Equal coordinates are
/// told apart by their numbers: the groups do not depend on the standard library.
class PointGroups {
public:
    explicit PointGroups(std::span<const double3> positions) : mPositions(positions) {
        for (uint32_t i = 0; i < positions.size(); ++i)
            if (isFinitePoint(positions[i])) mOrder.push_back(i);
    }

    template <class Emit>
    void divide(Emit&& emit) {
        if (!mOrder.empty()) divide(std::span(mOrder), emit);
    }

private:
    template <class Emit>
    void divide(std::span<uint32_t> points, Emit& emit) {
        if (points.size() <= kMaxPointsOfQuads) {
            std::ranges::sort(points);
            return emit(points);
        }
        const Box box = boxOf(mPositions, points);
        const double3 size = box.max - box.min;
        const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        const size_t groups = (points.size() + kMaxPointsOfQuads - 1) / kMaxPointsOfQuads;
        const size_t first = groups / 2 * kMaxPointsOfQuads;
        std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                         [&](uint32_t a, uint32_t b) {
                             const double x = mPositions[a][axis], y = mPositions[b][axis];
                             return x < y || (x == y && a < b);
                         });
        divide(points.first(first), emit);
        divide(points.subspan(first), emit);
    }

    std::span<const double3> mPositions;
    std::vector<uint32_t> mOrder;
};

} // namespace

std::vector<PointQuads> makePointQuads(std::span<const double3> positions, std::span<const float4> colors) {
    FILAMENT_ASSERT(colors.empty() || colors.size() == positions.size(),
                    "makePointQuads takes a colour for each point");
    FILAMENT_ASSERT(positions.size() < ~0u, "makePointQuads takes fewer than 2^32 - 1 points");
    std::vector<PointQuads> quads;
    PointGroups(positions).divide([&](std::span<const uint32_t> points) {
        const Box box = boxOf(positions, points);
        PointQuads& group = quads.emplace_back(PointQuads{ .center = box.min + (box.max - box.min) * 0.5 });
        group.bounds = { box.min - group.center, box.max - group.center };
        group.vertices.reserve(points.size() * 4);
        for (const uint32_t point : points) {
            PointVertex vertex{ .position = float3(positions[point] - group.center) };
            const float4 color = colors.empty() ? float4(1) : colors[point];
            for (int i = 0; i < 4; ++i) vertex.color[static_cast<size_t>(i)] = halfFromFloat(color[i]);
            group.vertices.insert(group.vertices.end(), 4, vertex);
        }
    });
    return quads;
}

VertexBufferDesc PointQuads::vertexBuffer() const {
    return { .vertexCount = static_cast<uint32_t>(vertices.size()),
             .stride = sizeof(PointVertex),
             .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(PointVertex, position) },
                             { Attribute::Color, VertexFormat::Half4, offsetof(PointVertex, color) } },
             .data = std::as_bytes(std::span(vertices)),
             .name = "points" };
}

IndexBufferDesc pointIndexBuffer() {
    static const std::vector<uint16_t> kIndices = [] {
        std::vector<uint16_t> indices;
        indices.reserve(kMaxPointsOfQuads * size_t{ 6 });
        for (uint32_t point = 0; point < kMaxPointsOfQuads; ++point)
            for (const uint32_t corner : { 0u, 1u, 2u, 0u, 2u, 3u })
                indices.push_back(static_cast<uint16_t>(point * 4 + corner));
        return indices;
    }();
    return { .indexCount = static_cast<uint32_t>(kIndices.size()),
             .format = IndexFormat::UInt16,
             .data = std::as_bytes(std::span(kIndices)),
             .name = "points" };
}

} // namespace filament_core
