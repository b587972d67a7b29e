// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"

#include <filament_core/Lines.h>

#include <cstddef>

namespace filament_core {
namespace {

struct LinePoint {
    float3 position;
    float4 color;
};

/// Seen from any side, the first triangle is (left of the begin, right of the end, right of the begin). "Left" is
/// towards the other end, so the sides of the two ends have opposite signs.
void addSegment(LineQuads& quads, LinePoint const& begin, LinePoint const& end) {
    const auto first = static_cast<uint32_t>(quads.vertices.size());
    const auto add = [&](LinePoint const& at, LinePoint const& other, float side) {
        quads.vertices.push_back({ at.position, at.color, float4(other.position, side) });
    };
    add(begin, end, 1);
    add(begin, end, -1);
    add(end, begin, 1);
    add(end, begin, -1);
    for (const uint32_t corner : { 0u, 2u, 1u, 0u, 3u, 2u }) quads.indices.push_back(first + corner);
}

} // namespace

LineQuads makeLineQuads(std::span<const float3> points, PrimitiveType primitive, std::span<const float4> colors) {
    FILAMENT_ASSERT(primitive == PrimitiveType::Lines || primitive == PrimitiveType::LineStrip,
                    "makeLineQuads takes Lines or LineStrip");
    FILAMENT_ASSERT(colors.empty() || colors.size() == points.size(), "makeLineQuads takes a colour for each point");
    const size_t step = primitive == PrimitiveType::Lines ? 2 : 1;
    const auto pointAt = [&](size_t i) { return LinePoint{ points[i], colors.empty() ? float4(1) : colors[i] }; };
    LineQuads quads;
    quads.vertices.reserve(points.size() / step * 4);
    quads.indices.reserve(points.size() / step * 6);
    for (size_t i = 0; i + 1 < points.size(); i += step) addSegment(quads, pointAt(i), pointAt(i + 1));
    return quads;
}

VertexBufferDesc LineQuads::vertexBuffer() const {
    return { .vertexCount = static_cast<uint32_t>(vertices.size()),
             .stride = sizeof(LineVertex),
             .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(LineVertex, position) },
                             { Attribute::Color, VertexFormat::Float4, offsetof(LineVertex, color) },
                             { Attribute::Custom0, VertexFormat::Float4, offsetof(LineVertex, otherEnd) } },
             .data = std::as_bytes(std::span(vertices)),
             .name = "lines" };
}

IndexBufferDesc LineQuads::indexBuffer() const {
    return { .indexCount = static_cast<uint32_t>(indices.size()),
             .format = IndexFormat::UInt32,
             .data = std::as_bytes(std::span(indices)),
             .name = "lines" };
}

} // namespace filament_core
