// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Shapes.h"

#include "base/Assert.h"

#include <algorithm>
#include <cmath>

namespace filament_core::showcase {
namespace {

constexpr float kTwoPi = 2 * kPi;

void addVertex(Shape& shape, float3 position, float3 normal, float2 uv) {
    shape.positions.push_back(position);
    shape.normals.push_back(normal);
    shape.uvs.push_back(uv);
}

/// Joins a grid of (columns + 1) x (rows + 1) vertices that begins at `first`, row by row. Seen from outside, columns
/// run to the right and rows downwards. Triangles without area (at poles) are omitted.
void addGridTriangles(Shape& shape, uint32_t first, uint32_t columns, uint32_t rows) {
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        const float3 *p = shape.positions.data(), &pa = p[a], &pb = p[b], &pc = p[c];
        if (pa == pb || pb == pc || pc == pa) return;
        shape.indices.insert(shape.indices.end(), { a, b, c });
    };
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t topLeft = first + row * (columns + 1) + column;
            const uint32_t bottomLeft = topLeft + columns + 1;
            add(topLeft, bottomLeft, bottomLeft + 1);
            add(topLeft, bottomLeft + 1, topLeft + 1);
        }
    }
    FILAMENT_ASSERT(shape.positions.size() <= 65536, "a shape has at most 65536 vertices");
}

/// cos and sin that close circles exactly: the last step has the values of the first.
float2 circle(uint32_t step, uint32_t steps) {
    const float angle = kTwoPi * static_cast<float>(step % steps) / static_cast<float>(steps);
    return { std::cos(angle), std::sin(angle) };
}

float fraction(uint32_t step, uint32_t steps) { return static_cast<float>(step) / static_cast<float>(steps); }

/// Saturated hue in [0, 1) as a linear colour.
float4 hueColor(float hue) {
    const auto channel = [&](float offset) {
        const float wave = 0.5f + 0.5f * std::cos(kTwoPi * (hue + offset));
        return 0.02f + 0.9f * wave * wave;
    };
    return { channel(0.0f), channel(2.0f / 3), channel(1.0f / 3), 1.0f };
}

/// Coordinates of the grid lines across one side of a rounded box as (position on the inner box, tangent of the angle
/// beyond it): equal angles on the rounding, one long cell in between.
std::vector<float2> roundedSide(float inner, uint32_t steps) {
    std::vector<float2> lines;
    for (uint32_t i = 0; i <= steps; ++i) {
        lines.push_back({ -inner, -std::tan(kPi / 4 * (1 - fraction(i, steps))) });
    }
    for (uint32_t i = 0; i <= steps; ++i) lines.push_back({ inner, std::tan(kPi / 4 * fraction(i, steps)) });
    return lines;
}

} // namespace

Shape sphere(float radius, uint32_t segments, float2 uvRepeats) {
    const uint32_t rings = segments / 2;
    Shape shape;
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        const float polar = kPi * fraction(ring, rings);
        // exactly on the axis at the poles, so that triangles without area are recognised
        const float across = ring == 0 || ring == rings ? 0.0f : std::sin(polar);
        for (uint32_t segment = 0; segment <= segments; ++segment) {
            const float2 around = circle(segment, segments);
            const float3 normal{ around.y * across, std::cos(polar), around.x * across };
            addVertex(shape, normal * radius, normal,
                      float2{ fraction(segment, segments), fraction(ring, rings) } * uvRepeats);
        }
    }
    addGridTriangles(shape, 0, segments, rings);
    return shape;
}

Shape roundedBox(float3 halfSize, float radius, uint32_t steps, float uvPerUnit) {
    struct Side {
        float3 right, down, out;
    };
    constexpr Side kSides[] = {
        { { 0, 0, -1 }, { 0, -1, 0 }, { 1, 0, 0 } }, { { 0, 0, 1 }, { 0, -1, 0 }, { -1, 0, 0 } },
        { { 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },   { { 1, 0, 0 }, { 0, 0, -1 }, { 0, -1, 0 } },
        { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 } },  { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } },
    };
    const float3 inner = halfSize - radius;
    const auto along = [&](float3 axis) { return std::abs(dot(axis, inner)); };
    Shape shape;
    for (Side const& side : kSides) {
        const uint32_t first = static_cast<uint32_t>(shape.positions.size());
        const std::vector<float2> columns = roundedSide(along(side.right), steps);
        const std::vector<float2> rows = roundedSide(along(side.down), steps);
        for (float2 row : rows) {
            for (float2 column : columns) {
                const float3 normal = normalize(side.right * column.y + side.down * row.y + side.out);
                const float3 center = side.right * column.x + side.down * row.x + side.out * along(side.out);
                const float2 onSide{ column.x + column.y * radius, row.x + row.y * radius };
                addVertex(shape, center + normal * radius, normal, onSide * uvPerUnit + 0.5f);
            }
        }
        addGridTriangles(shape, first, static_cast<uint32_t>(columns.size()) - 1,
                         static_cast<uint32_t>(rows.size()) - 1);
    }
    return shape;
}

Shape torus(float radius, float tubeRadius, uint32_t segments, uint32_t sides) {
    std::vector<float2> profile;
    for (uint32_t side = 0; side <= sides; ++side) {
        const float2 around = circle(side, sides);
        profile.push_back({ radius + tubeRadius * around.x, -tubeRadius * around.y });
    }
    Shape shape;
    for (uint32_t side = 0; side <= sides; ++side) {
        const float2 outward = { circle(side, sides).x, -circle(side, sides).y };
        for (uint32_t segment = 0; segment <= segments; ++segment) {
            const float2 around = circle(segment, segments);
            addVertex(shape, { profile[side].x * around.y, profile[side].y, profile[side].x * around.x },
                      { outward.x * around.y, outward.y, outward.x * around.x },
                      { fraction(segment, segments), fraction(side, sides) });
        }
    }
    addGridTriangles(shape, 0, segments, sides);
    return shape;
}

Shape torusKnot(uint32_t p, uint32_t q, float radius, float tubeRadius, uint32_t segments, uint32_t sides) {
    // A curve on a torus of radii 2 and 1, which reaches 3 from the axis.
    const auto curve = [&](float t) {
        const float ring = 2 + std::cos(static_cast<float>(q) * t), turn = static_cast<float>(p) * t;
        return float3{ ring * std::cos(turn), ring * std::sin(turn), std::sin(static_cast<float>(q) * t) } *
               (radius / 3);
    };
    constexpr float kStep = 1e-2f; // of the central difference; the curve turns by q * kStep at most
    Shape shape;
    for (uint32_t segment = 0; segment <= segments; ++segment) {
        const float t = kTwoPi * fraction(segment % segments, segments);
        const float3 center = curve(t);
        const float3 tangent = normalize(curve(t + kStep) - curve(t - kStep));
        const float3 binormal = normalize(cross(tangent, center));
        const float3 normal = cross(binormal, tangent);
        for (uint32_t side = 0; side <= sides; ++side) {
            const float2 around = circle(side, sides);
            const float3 outward = normal * around.x - binormal * around.y;
            addVertex(shape, center + outward * tubeRadius, outward,
                      { fraction(side, sides), fraction(segment, segments) * 16.0f });
            shape.colors.push_back(hueColor(fraction(segment, segments)));
        }
    }
    addGridTriangles(shape, 0, sides, segments);
    return shape;
}

Shape lathe(std::span<const float2> profile, uint32_t segments, float2 uvRepeats) {
    FILAMENT_ASSERT(profile.size() >= 2, "a profile has at least two points");
    const size_t last = profile.size() - 1;
    Shape shape;
    for (size_t i = 0; i <= last; ++i) {
        const float2 along = profile[std::min(i + 1, last)] - profile[i == 0 ? 0 : i - 1];
        const float2 outward = normalize(float2{ along.y, -along.x });
        for (uint32_t segment = 0; segment <= segments; ++segment) {
            const float2 around = circle(segment, segments);
            addVertex(shape, { profile[i].x * around.y, profile[i].y, profile[i].x * around.x },
                      { outward.x * around.y, outward.y, outward.x * around.x },
                      float2{ fraction(segment, segments), 1 - static_cast<float>(i) / static_cast<float>(last) } *
                              uvRepeats);
        }
    }
    addGridTriangles(shape, 0, segments, static_cast<uint32_t>(last));
    // Profiles run upwards, grids downwards, so the triangles are reversed.
    for (size_t i = 0; i < shape.indices.size(); i += 3) std::swap(shape.indices[i + 1], shape.indices[i + 2]);
    return shape;
}

std::vector<float2> smoothProfile(std::span<const float2> points, uint32_t steps) {
    FILAMENT_ASSERT(points.size() >= 2, "a profile has at least two points");
    const auto at = [&](size_t i, int offset) {
        const auto index = static_cast<std::ptrdiff_t>(i) + offset;
        return points[static_cast<size_t>(
                std::clamp<std::ptrdiff_t>(index, 0, static_cast<std::ptrdiff_t>(points.size()) - 1))];
    };
    std::vector<float2> profile;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        const float2 a = at(i, -1), b = at(i, 0), c = at(i, 1), d = at(i, 2);
        for (uint32_t step = 0; step < steps; ++step) {
            const float t = fraction(step, steps);
            const float2 point = 0.5f * (2.0f * b + (c - a) * t + (2.0f * a - 5.0f * b + 4.0f * c - d) * (t * t) +
                                         (3.0f * (b - c) + d - a) * (t * t * t));
            profile.push_back({ std::max(point.x, 0.0f), point.y });
        }
    }
    profile.push_back(points.back());
    return profile;
}

} // namespace filament_core::showcase
