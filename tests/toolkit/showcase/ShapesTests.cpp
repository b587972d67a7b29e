// SPDX-License-Identifier: Apache-2.0
#include "toolkit/showcase/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace filament_core::showcase {
namespace {

constexpr float kPiF = std::numbers::pi_v<float>;

Shape vase() {
    const float2 points[] = { { 0, 0 }, { 0.4f, 0 }, { 0.6f, 0.5f }, { 0.3f, 1 }, { 0.0f, 1.1f } };
    return lathe(smoothProfile(points, 12), 48);
}

struct NamedShape {
    const char* name;
    Shape shape;
};

std::vector<NamedShape> closedShapes() {
    return { { "sphere", sphere(0.7f, 48) },
             { "box", roundedBox({ 1, 0.5f, 0.25f }, 0.1f, 4) },
             { "torus", torus(1, 0.25f, 64, 24) },
             { "knot", torusKnot(2, 3, 1, 0.12f, 300, 16) },
             { "vase", vase() } };
}

/// Divergence theorem: a sixth of the triple product of every triangle. Positive when triangles face outwards.
double volume(Shape const& shape) {
    double sum = 0;
    for (size_t i = 0; i < shape.indices.size(); i += 3) {
        const double3 a(shape.positions[shape.indices[i]]), b(shape.positions[shape.indices[i + 1]]),
                c(shape.positions[shape.indices[i + 2]]);
        sum += dot(a, cross(b, c)) / 6;
    }
    return sum;
}

TEST(Shapes, ArraysHaveOneLengthAndIndicesStayInside) {
    for (auto const& [name, shape] : closedShapes()) {
        EXPECT_EQ(shape.normals.size(), shape.positions.size()) << name;
        EXPECT_EQ(shape.uvs.size(), shape.positions.size()) << name;
        EXPECT_TRUE(shape.colors.empty() || shape.colors.size() == shape.positions.size()) << name;
        EXPECT_GT(shape.triangleCount(), 100u) << name;
        for (const uint32_t index : shape.indices) ASSERT_LT(index, shape.positions.size()) << name;
    }
}

TEST(Shapes, NormalsAreUnitAndOnTheSideThatTrianglesFace) {
    for (auto const& [name, shape] : closedShapes()) {
        for (size_t i = 0; i < shape.indices.size(); i += 3) {
            const uint32_t* corner = &shape.indices[i];
            const float3 a = shape.positions[corner[0]], b = shape.positions[corner[1]], c = shape.positions[corner[2]];
            const float3 face = normalize(cross(b - a, c - a));
            for (int k = 0; k < 3; ++k) {
                const float3 normal = shape.normals[corner[k]];
                ASSERT_NEAR(length(normal), 1.0f, 1e-5f) << name;
                ASSERT_GT(dot(normal, face), 0.5f) << name << ", triangle " << i / 3;
            }
        }
    }
}

TEST(Shapes, SurfacesAreClosed) {
    for (auto const& [name, shape] : closedShapes()) {
        // Every directed edge between positions (seams share them bit for bit) has its opposite.
        const auto key = [&positions = shape.positions](uint32_t index) {
            const float3 p = positions[index] + 0.0f; // -0 becomes +0
            return std::tuple(p.x, p.y, p.z);
        };
        using Point = std::tuple<float, float, float>;
        std::map<std::pair<Point, Point>, int> edges;
        for (size_t i = 0; i < shape.indices.size(); i += 3) {
            for (size_t k = 0; k < 3; ++k) {
                const Point from = key(shape.indices[i + k]), to = key(shape.indices[i + (k + 1) % 3]);
                ++edges[{ from, to }];
                --edges[{ to, from }];
            }
        }
        size_t open = 0;
        for (auto const& [edge, count] : edges) open += count != 0;
        EXPECT_EQ(open, 0u) << name;
    }
}

TEST(Shapes, VolumesAreThoseOfTheFormulas) {
    const float r = 0.7f;
    EXPECT_NEAR(volume(sphere(r, 96)), 4.0 / 3 * kPiF * r * r * r, 0.01);
    EXPECT_NEAR(volume(torus(1, 0.25f, 128, 48)), 2 * kPiF * kPiF * 0.25 * 0.25, 0.01);
    // Steiner: box, slabs on its sides, quarter cylinders on its edges, eighths of a sphere on its corners.
    const double a = 1.8, b = 0.8, c = 0.3, radius = 0.1;
    const double steiner = a * b * c + 2 * radius * (a * b + b * c + c * a) + kPiF * radius * radius * (a + b + c) +
                           4.0 / 3 * kPiF * radius * radius * radius;
    EXPECT_NEAR(volume(roundedBox({ 1, 0.5f, 0.25f }, 0.1f, 16)), steiner, 0.001);
}

TEST(Shapes, ASmoothProfilePassesThroughItsPoints) {
    const float2 points[] = { { 1, 0 }, { 2, 1 }, { 0.5f, 3 } };
    const std::vector<float2> profile = smoothProfile(points, 8);
    ASSERT_EQ(profile.size(), 17u);
    EXPECT_EQ(profile[0], points[0]);
    EXPECT_EQ(profile[8], points[1]);
    EXPECT_EQ(profile[16], points[2]);
}

} // namespace
} // namespace filament_core::showcase
