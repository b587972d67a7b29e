// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/Tangents.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <numeric>

namespace filament_core::assets::test {
namespace {

struct Mesh {
    std::vector<float3> positions, normals;
    std::vector<float2> uvs;
    std::vector<uint32_t> indices;

    void add(float3 position, float3 normal, float2 uv) {
        positions.push_back(position);
        normals.push_back(normal);
        uvs.push_back(uv);
    }
    TangentOutput tangents() const { return generateTangents({ positions, normals, uvs, indices }); }
};

/// Two triangles in the xy plane; texture coordinates are u = a . p, v = b . p.
Mesh square(float2 a, float2 b) {
    Mesh mesh;
    for (const float2 p : { float2(0, 0), float2(1, 0), float2(1, 1), float2(0, 1) }) {
        mesh.add(float3(p, 0), float3(0, 0, 1), float2(glm::dot(a, p), glm::dot(b, p)));
    }
    mesh.indices = { 0, 1, 2, 0, 2, 3 };
    return mesh;
}

void expectNear(float4 actual, float4 expected, float tolerance = 1e-5f) {
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "component " << i;
}

TEST(Tangents, PointAlongGrowingU) {
    // v grows downwards in glTF: with u to the right and v down, nothing is mirrored
    for (float4 const& tangent : square(float2(1, 0), float2(0, -1)).tangents().tangents)
        expectNear(tangent, float4(1, 0, 0, 1));
    for (float4 const& tangent : square(float2(0, 5), float2(5, 0)).tangents().tangents)
        expectNear(tangent, float4(0, 1, 0, 1));
}

TEST(Tangents, MirroredTexturesAreLeftHanded) {
    for (float4 const& tangent : square(float2(1, 0), float2(0, 1)).tangents().tangents)
        expectNear(tangent, float4(1, 0, 0, -1));
    for (float4 const& tangent : square(float2(-1, 0), float2(0, -1)).tangents().tangents)
        expectNear(tangent, float4(-1, 0, 0, -1));
}

TEST(Tangents, BitangentsPointToWhereVFalls) {
    // a sheared mapping: t and b are not perpendicular, but cross(n, t) * w must lie on b's side
    const Mesh mesh = square(float2(1, 0.5f), float2(0.2f, -1));
    const TangentOutput output = mesh.tangents();
    const float3 bitangent = glm::cross(float3(0, 0, 1), float3(output.tangents[0])) * output.tangents[0].w;
    EXPECT_LT(glm::dot(float2(0.2f, -1), float2(bitangent)), 0); // v falls along it
}

TEST(Tangents, SmoothMeshesKeepTheirVertices) {
    const TangentOutput output = square(float2(1, 0), float2(0, -1)).tangents();
    EXPECT_THAT(output.sources, testing::ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(output.indices, testing::ElementsAre(0, 1, 2, 0, 2, 3));
}

/// A strip of two squares that share the edge x = 1, the texture mirrored about it.
Mesh mirroredStrip() {
    Mesh mesh;
    for (const float x : { 0.0f, 1.0f, 2.0f }) {
        for (const float y : { 0.0f, 1.0f }) mesh.add(float3(x, y, 0), float3(0, 0, 1), float2(x < 2 ? x : 0, -y));
    }
    mesh.indices = { 0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3 };
    return mesh;
}

TEST(Tangents, VerticesOnAMirrorSeamAreSplit) {
    const TangentOutput output = mirroredStrip().tangents();
    ASSERT_EQ(output.sources.size(), 8u); // both vertices of the seam twice
    for (size_t c = 0; c < output.indices.size(); ++c) {
        const float4 expected = c < 6 ? float4(1, 0, 0, 1) : float4(-1, 0, 0, -1);
        expectNear(output.tangents[output.indices[c]], expected);
    }
    EXPECT_THAT(std::span(output.sources).subspan(6), testing::UnorderedElementsAre(2u, 3u));
}

TEST(Tangents, TheMeanIsWeightedByTheAngleOfTheCorner) {
    // Around the origin: two triangles of 45 degrees with dP/du = (1, 0), one of 90 degrees with dP/du = (2, 2). Their
    // number and sizes do not matter: 90 degrees of one against 90 of the other.
    Mesh mesh;
    const float3 n(0, 0, 1);
    mesh.add(float3(0, 0, 0), n, float2(0, 0));
    mesh.add(float3(10, 0, 0), n, float2(10, 0));
    mesh.add(float3(1, 1, 0), n, float2(1, -1));
    mesh.add(float3(0, 3, 0), n, float2(0, -3));
    mesh.add(float3(-2, 0, 0), n, float2(-1, -2)); // -1 * (2, 2) + 2 * (0, 1) = (-2, 0)
    mesh.indices = { 0, 1, 2, 0, 2, 3, 0, 3, 4 };
    const float s = std::sqrt(0.5f);
    const float2 sum = float2(1, 0) + float2(s, s);
    expectNear(mesh.tangents().tangents[0], float4(sum / std::sqrt(glm::dot(sum, sum)), 0, 1));
}

TEST(Tangents, EqualVerticesWithoutSharedIndicesAreOne) {
    Mesh mesh;
    const Mesh shared = mirroredStrip();
    for (const uint32_t index : shared.indices)
        mesh.add(shared.positions[index], shared.normals[index], shared.uvs[index]);
    mesh.indices.resize(shared.indices.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    const TangentOutput indexed = shared.tangents(), unindexed = mesh.tangents();
    EXPECT_EQ(unindexed.sources.size(), 12u);
    for (size_t c = 0; c < 12; ++c) {
        EXPECT_EQ(unindexed.tangents[unindexed.indices[c]], indexed.tangents[indexed.indices[c]]); // bit for bit
    }
}

TEST(Tangents, FansThatTouchInOnePointHaveTangentsOfTheirOwn) {
    Mesh mesh; // two triangles that meet in the origin only, with textures turned by 90 degrees
    const float3 n(0, 0, 1);
    mesh.add(float3(0, 0, 0), n, float2(0, 0));
    mesh.add(float3(1, 0, 0), n, float2(1, 0));
    mesh.add(float3(0, 1, 0), n, float2(0, -1));
    mesh.add(float3(-1, 0, 0), n, float2(0, -1));
    mesh.add(float3(0, -1, 0), n, float2(-1, 0));
    mesh.indices = { 0, 1, 2, 0, 3, 4 };
    const TangentOutput output = mesh.tangents();
    EXPECT_EQ(output.sources.size(), 6u);
    expectNear(output.tangents[output.indices[0]], float4(1, 0, 0, 1));
    expectNear(output.tangents[output.indices[3]], float4(0, 1, 0, 1));
}

TEST(Tangents, TrianglesWithoutATextureGradientFollowTheirNeighbours) {
    Mesh mesh = square(float2(1, 0), float2(0, -1));
    mesh.add(float3(2, 0.5f, 0), float3(0, 0, 1), mesh.uvs[1]); // shares the edge 1-2 and has no area in the texture
    mesh.indices.insert(mesh.indices.end(), { 1, 4, 2 });
    const TangentOutput output = mesh.tangents();
    EXPECT_EQ(output.sources.size(), 5u);
    expectNear(output.tangents[1], float4(1, 0, 0, 1));
}

TEST(Tangents, DegenerateInputGivesUnitTangentsPerpendicularToTheNormal) {
    Mesh mesh = square(float2(0, 0), float2(0, 0)); // no gradient anywhere
    mesh.indices.insert(mesh.indices.end(), { 0, 0, 1, 2, 2, 2 });
    mesh.add(float3(1e30f, 0, 0), float3(0, 1, 0), float2(1e30f, 1e-30f)); // overflows when squared
    mesh.add(float3(0, 0, 0), float3(0, 1, 0), float2(0, 0));
    mesh.add(float3(0, 1e30f, 0), float3(0, 1, 0), float2(0, -1e30f));
    mesh.indices.insert(mesh.indices.end(), { 4, 5, 6 });
    const TangentOutput output = mesh.tangents();
    for (size_t i = 0; i < output.tangents.size(); ++i) {
        const float3 tangent(output.tangents[i]), normal = mesh.normals[output.sources[i]];
        EXPECT_NEAR(glm::dot(tangent, tangent), 1, 1e-5f);
        EXPECT_NEAR(glm::dot(tangent, normal), 0, 1e-5f);
        EXPECT_EQ(std::abs(output.tangents[i].w), 1.0f);
    }
}

TEST(Tangents, ManyCopiesOfOneTriangleStayLinear) {
    Mesh mesh = square(float2(1, 0), float2(0, -1));
    constexpr size_t kCopies = 200'000; // pairs of edges by search would be 10^10 steps
    mesh.indices.clear();
    for (size_t i = 0; i < kCopies; ++i) mesh.indices.insert(mesh.indices.end(), { 0, 1, 2 });
    const auto start = std::chrono::steady_clock::now();
    expectNear(mesh.tangents().tangents[0], float4(1, 0, 0, 1));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

} // namespace
} // namespace filament_core::assets::test
