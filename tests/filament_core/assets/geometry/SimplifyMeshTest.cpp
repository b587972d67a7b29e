// SPDX-License-Identifier: Apache-2.0
// Levels of detail: the error that each claims, against a search over all triangles; borders, seams, deformation, and
// meshes that have no coarser level.
#include "filament_core/assets/geometry/SimplifyMesh.h"

#include <filament_core/Primitives.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>

namespace filament_core::assets::test {
namespace {

struct Surface {
    std::vector<float3> positions{};
    std::vector<uint32_t> indices{};

    MeshToSimplify input() const { return { .positions = positions, .indices = indices }; }
};

Surface surfaceOf(Mesh const& mesh) {
    Surface surface{ .indices = mesh.indices };
    for (MeshVertex const& vertex : mesh.vertices) surface.positions.push_back(vertex.position);
    return surface;
}

/// `side` x `side` squares over [0, 1] x [0, 1].
Surface grid(uint32_t side, std::function<float(float2)> const& height) {
    Surface surface;
    for (uint32_t y = 0; y <= side; ++y) {
        for (uint32_t x = 0; x <= side; ++x) {
            const float2 at = float2(x, y) / static_cast<float>(side);
            surface.positions.emplace_back(at, height(at));
        }
    }
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x, b = a + 1, c = a + side + 1, d = c + 1;
            surface.indices.insert(surface.indices.end(), { a, b, d, a, d, c });
        }
    }
    return surface;
}

float bumps(float2 at) { return 0.03f * std::sin(9 * at.x) * std::cos(7 * at.y); }

double toSegment(double3 const& point, double3 const& a, double3 const& b) {
    const double3 along = b - a;
    const double length = glm::dot(along, along);
    const double share = length > 0 ? std::clamp(glm::dot(point - a, along) / length, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + along * share);
}

/// By the plane where the foot is inside, otherwise by the sides.
double toTriangle(double3 const& point, double3 const& a, double3 const& b, double3 const& c) {
    const double sides = std::min({ toSegment(point, a, b), toSegment(point, b, c), toSegment(point, c, a) });
    const double3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    if (!(area > 0)) return sides;
    const double height = glm::dot(point - a, normal) / area;
    const double3 foot = point - normal * (height / area);
    const bool isInside = glm::dot(glm::cross(b - a, foot - a), normal) >= 0 &&
                          glm::dot(glm::cross(c - b, foot - b), normal) >= 0 &&
                          glm::dot(glm::cross(a - c, foot - c), normal) >= 0;
    return isInside ? std::min(std::abs(height), sides) : sides;
}

/// The largest distance of a vertex from the nearest triangle, with `moved` positions.
double largestDistance(std::vector<float3> const& moved, std::vector<uint32_t> const& triangles) {
    double largest = 0;
    for (float3 const& at : moved) {
        double least = std::numeric_limits<double>::max();
        for (size_t i = 0; i < triangles.size(); i += 3)
            least = std::min(least, toTriangle(double3(at), double3(moved[triangles[i]]),
                                               double3(moved[triangles[i + 1]]), double3(moved[triangles[i + 2]])));
        largest = std::max(largest, least);
    }
    return largest;
}

void expectErrors(Surface const& surface, std::vector<SimplifiedLevel> const& levels, size_t atLeast) {
    ASSERT_GE(levels.size(), atLeast);
    size_t last = surface.indices.size();
    float error = 0;
    for (SimplifiedLevel const& level : levels) {
        EXPECT_LE(level.indices.size() * 4, last * 3);
        EXPECT_EQ(level.indices.size() % 3, 0u);
        EXPECT_GE(level.error, error);
        EXPECT_LE(largestDistance(surface.positions, level.indices), static_cast<double>(level.error) + 1e-7);
        last = level.indices.size();
        error = level.error;
    }
}

using Edge = std::array<std::array<float, 3>, 2>;

/// By the positions of their ends: edges that one triangle alone has, in their direction.
std::set<Edge> openEdges(std::vector<float3> const& positions, std::vector<uint32_t> const& indices) {
    std::map<Edge, int> uses;
    const auto corner = [&](uint32_t index) {
        return std::array{ positions[index].x, positions[index].y, positions[index].z };
    };
    for (size_t i = 0; i < indices.size(); i += 3) {
        for (size_t side = 0; side < 3; ++side) {
            const auto a = corner(indices[i + side]), b = corner(indices[i + (side + 1) % 3]);
            ++uses[{ a, b }];
            --uses[{ b, a }];
        }
    }
    std::set<Edge> open;
    for (auto const& [edge, count] : uses)
        if (count > 0) open.insert(edge);
    return open;
}

TEST(SimplifyMesh, EveryVertexIsWithinTheErrorOfEachLevel) {
    const Surface sphere = surfaceOf(makeIcoSphere({ .radius = 1, .subdivisions = 4 }).value());
    const Surface hills = grid(40, bumps);
    const Surface torus = surfaceOf(makeTorus({}).value());
    expectErrors(sphere, simplifyMesh(sphere.input()), 4);
    expectErrors(hills, simplifyMesh(hills.input()), 3);
    expectErrors(torus, simplifyMesh(torus.input()), 2);
}

TEST(SimplifyMesh, ALevelOfASphereIsAsFarAsItsTrianglesAreFlat) {
    const Surface sphere = surfaceOf(makeIcoSphere({ .radius = 2, .subdivisions = 5 }).value());
    // A regular triangle of side s sinks 2 - sqrt(4 - s^2 / 3) below its sphere; n triangles have the sphere's area.
    for (SimplifiedLevel const& level : simplifyMesh(sphere.input())) {
        const double triangles = static_cast<double>(level.indices.size()) / 3;
        const double squaredSide = 16 * 3.14159 / triangles * 4 / std::sqrt(3.0);
        const double sunk = 2 - std::sqrt(4 - squaredSide / 3);
        EXPECT_GT(static_cast<double>(level.error), sunk * 0.5);
        EXPECT_LT(static_cast<double>(level.error), sunk * 8);
    }
}

TEST(SimplifyMesh, OpenBordersStayAsTheyAre) {
    const Surface hills = grid(24, bumps);
    const std::set<Edge> border = openEdges(hills.positions, hills.indices);
    EXPECT_EQ(border.size(), 4u * 24);
    for (SimplifiedLevel const& level : simplifyMesh(hills.input()))
        EXPECT_EQ(openEdges(hills.positions, level.indices), border);
}

TEST(SimplifyMesh, SeamsOfAttributesStayClosed) {
    const Mesh mesh =
            makeUvSphere({ .slices = 48, .stacks = 24 }).value(); // its texture coordinates begin and end on a meridian
    const Surface sphere = surfaceOf(mesh);
    ASSERT_TRUE(openEdges(sphere.positions, sphere.indices).empty());
    const auto levels = simplifyMesh(sphere.input());
    ASSERT_FALSE(levels.empty());
    for (SimplifiedLevel const& level : levels) EXPECT_TRUE(openEdges(sphere.positions, level.indices).empty());
}

TEST(SimplifyMesh, TrianglesWithoutIndicesAreWelded) {
    const Surface hills = grid(20, bumps);
    Surface soup;
    for (const uint32_t index : hills.indices) {
        soup.indices.push_back(static_cast<uint32_t>(soup.positions.size()));
        soup.positions.push_back(hills.positions[index]);
    }
    MeshToSimplify input = soup.input();
    EXPECT_TRUE(simplifyMesh(input).empty()); // every edge is a border
    input.vertices = std::as_bytes(std::span(soup.positions));
    input.stride = sizeof(float3);
    expectErrors(soup, simplifyMesh(input), 2);
}

TEST(SimplifyMesh, TheErrorHoldsForAnyWeightOfAMorphTarget) {
    const Surface flat = grid(24, [](float2) { return 0.0f; });
    std::vector<float3> bump, shift;
    for (float3 const& at : flat.positions) {
        bump.emplace_back(0, 0, bumps(float2(at)));
        shift.emplace_back(0.02f * std::sin(8 * at.y), 0, 0);
    }
    const std::array<std::span<const float3>, 2> targets{ bump, shift };
    MeshToSimplify input = flat.input();
    input.displacements = targets;
    const auto levels = simplifyMesh(input);
    ASSERT_GE(levels.size(), 2u);
    EXPECT_GT(levels[0].error, 1e-4f); // at rest the grid is flat
    for (const float2 weights : { float2(0), float2(1), float2(-1, 1), float2(0.5f, -1) }) {
        std::vector<float3> moved = flat.positions;
        for (size_t i = 0; i < moved.size(); ++i) moved[i] += bump[i] * weights.x + shift[i] * weights.y;
        for (SimplifiedLevel const& level : levels)
            EXPECT_LE(largestDistance(moved, level.indices), static_cast<double>(level.error) + 1e-7);
    }
}

TEST(SimplifyMesh, TheErrorHoldsWhereAJointBends) {
    const Surface flat = grid(24, [](float2) { return 0.0f; });
    std::vector<Influence> influences;
    for (float3 const& at : flat.positions) {
        const float second = std::clamp(at.x * 4 - 1.5f, 0.0f, 1.0f);
        influences.insert(influences.end(), { { 0, 1 - second }, { 1, second } });
    }
    MeshToSimplify input = flat.input();
    input.influences = influences;
    const auto levels = simplifyMesh(input);
    ASSERT_FALSE(levels.empty());
    for (const float angle : { 0.5f, 1.5f, -1.0f }) { // about the line x = 0.5
        std::vector<float3> moved = flat.positions;
        for (size_t i = 0; i < moved.size(); ++i) {
            const float3 at = moved[i];
            const float3 turned(0.5f + std::cos(angle) * (at.x - 0.5f), at.y, std::sin(angle) * (at.x - 0.5f));
            moved[i] = at * influences[2 * i].weight + turned * influences[2 * i + 1].weight;
        }
        for (SimplifiedLevel const& level : levels)
            EXPECT_LE(largestDistance(moved, level.indices), static_cast<double>(level.error) + 1e-7);
    }
}

TEST(SimplifyMesh, SomeMeshesHaveNoLevel) {
    const float kNotANumber = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(simplifyMesh({}).empty());
    EXPECT_TRUE(simplifyMesh(grid(4, bumps).input()).empty()); // few triangles
    Surface point = grid(16, bumps);
    std::ranges::fill(point.positions, float3(3));
    EXPECT_TRUE(simplifyMesh(point.input()).empty());
    Surface broken = grid(16, bumps);
    broken.positions[40].y = kNotANumber;
    EXPECT_TRUE(simplifyMesh(broken.input()).empty());
    Surface huge = grid(16, bumps);
    for (float3& at : huge.positions) at = (at - 0.5f) * 3e38f * 2.0f;
    EXPECT_TRUE(simplifyMesh(huge.input()).empty());
    Surface disconnected; // every edge is a border
    for (uint32_t i = 0; i < 300; ++i) {
        disconnected.positions.push_back(float3(static_cast<float>(i), static_cast<float>(i % 3), 0));
        disconnected.indices.push_back(i);
    }
    EXPECT_TRUE(simplifyMesh(disconnected.input()).empty());
}

TEST(SimplifyMesh, HostileTrianglesKeepTheRules) {
    std::mt19937 random(7);
    for (int round = 0; round < 30; ++round) {
        Surface surface;
        const auto vertices = static_cast<uint32_t>(20 + random() % 200);
        for (uint32_t i = 0; i < vertices; ++i) // many in one place, many on one line
            surface.positions.push_back(float3(static_cast<float>(random() % 4), static_cast<float>(random() % 3), 0));
        for (int i = 0; i < 900; ++i) surface.indices.push_back(static_cast<uint32_t>(random() % vertices));
        for (SimplifiedLevel const& level : simplifyMesh(surface.input())) {
            for (const uint32_t index : level.indices) EXPECT_LT(index, vertices);
        }
    }
}

TEST(SimplifyMesh, EqualMeshesHaveEqualLevels) {
    const Surface hills = grid(30, bumps);
    const auto one = simplifyMesh(hills.input()), two = simplifyMesh(hills.input());
    ASSERT_EQ(one.size(), two.size());
    for (size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].indices, two[i].indices);
        EXPECT_EQ(one[i].error, two[i].error);
    }
}

} // namespace
} // namespace filament_core::assets::test
