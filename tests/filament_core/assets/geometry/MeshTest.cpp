// SPDX-License-Identifier: Apache-2.0
// Tangent frames, normals and edges of meshes: against the shader that decodes them, against shapes whose frames are
// known, and for hostile meshes.
#include "shaders/lib/LibCpp.h"

#include <filament_core/Mesh.h>
#include <filament_core/Primitives.h>

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace filament_core::test {
namespace {

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

Mesh madeMesh(Result<Mesh> made) {
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::move(*made) : Mesh{};
}

float3 randomDirection(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(float3(normal(random), normal(random), normal(random)));
}

/// Orthonormal, and with the handedness.
void expectFrame(TangentFrame const& frame, bool isMirrored, float tolerance = 1e-5f) {
    EXPECT_NEAR(glm::length(frame.normal), 1, tolerance);
    EXPECT_NEAR(glm::length(frame.tangent), 1, tolerance);
    EXPECT_NEAR(glm::dot(frame.normal, frame.tangent), 0, tolerance);
    const float3 bitangent = glm::cross(frame.normal, frame.tangent) * (isMirrored ? -1.0f : 1.0f);
    EXPECT_NEAR(glm::length(frame.bitangent - bitangent), 0, tolerance);
}

// The normal and the tangent survive within the 2 / 32767 by which |w| is kept from zero.
TEST(TangentsOf, AreTheGivenFrame) {
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const float3 normal = randomDirection(random), any = randomDirection(random);
        if (glm::length(glm::cross(normal, any)) < 0.01f) continue;
        const float3 tangent = glm::normalize(any - normal * glm::dot(normal, any));
        const bool isMirrored = i % 2 == 1;
        const float scale = std::pow(10.0f, static_cast<float>(i % 30 - 15));
        const TangentFrame frame = frameOf(tangentsOf(normal * scale, any / scale, isMirrored ? -1.0f : 1.0f));
        expectFrame(frame, isMirrored);
        EXPECT_NEAR(glm::length(frame.normal - normal), 0, 7e-5f);
        EXPECT_NEAR(glm::length(frame.tangent - tangent), 0, 7e-5f);
    }
}

TEST(TangentsOf, AnyNumbersAreAFrame) {
    const std::array special{
        0.0f, -0.0f, 1.0f, -1.0f, 1e-45f, 1e-30f, 3e38f, -3e38f, kEndless, -kEndless, kNotANumber
    };
    std::mt19937 random(2);
    const auto vector = [&] {
        return float3(special[random() % special.size()], special[random() % special.size()],
                      special[random() % special.size()]);
    };
    for (int i = 0; i < 50000; ++i) {
        const bool isMirrored = i % 2 == 1;
        expectFrame(frameOf(tangentsOf(vector(), vector(), isMirrored ? -1.0f : 1.0f)), isMirrored);
        expectFrame(frameOf(tangentsFromNormal(vector())), false);
    }
}

TEST(TangentsFromNormals, AreThoseOfEachNormal) {
    std::mt19937 random(3);
    std::vector<float3> normals{ { 0, 0, 1 }, { 0, 0, -1 }, { 0, 1, 0 }, { 1e-20f, 0, -1 } };
    for (int i = 0; i < 5000; ++i) normals.push_back(randomDirection(random));
    const std::vector<float4> tangents = tangentsFromNormals(normals);
    ASSERT_EQ(tangents.size(), normals.size());
    for (size_t i = 0; i < normals.size(); ++i) {
        EXPECT_EQ(tangents[i], tangentsFromNormal(normals[i]));
        EXPECT_NEAR(glm::length(frameOf(tangents[i]).normal - normals[i]), 0, 7e-5f);
    }
    EXPECT_TRUE(tangentsFromNormals({}).empty());
}

TEST(FrameOf, IsWhatTheShadersDecode) {
    std::mt19937 random(4);
    for (int i = 0; i < 5000; ++i) {
        const float4 q = tangentsOf(randomDirection(random), randomDirection(random), i % 2 ? -1.0f : 1.0f);
        const TangentFrame frame = frameOf(q);
        float3 normal, tangent, bitangent;
        shader::lib::tangentFrame(q, normal, tangent, bitangent);
        EXPECT_NEAR(glm::length(frame.normal - normal), 0, 1e-6f);
        EXPECT_NEAR(glm::length(frame.tangent - tangent), 0, 1e-6f);
        EXPECT_NEAR(glm::length(frame.bitangent - bitangent), 0, 1e-6f);
    }
}

TEST(PackTangents, KeepsTheFrameAndItsHandedness) {
    std::mt19937 random(5);
    for (int i = 0; i < 20000; ++i) {
        const float4 q = tangentsOf(randomDirection(random), randomDirection(random), i % 2 ? -1.0f : 1.0f);
        const std::array<int16_t, 4> packed = packTangents(q);
        float4 unpacked;
        for (int c = 0; c < 4; ++c) unpacked[c] = std::max(packed[static_cast<size_t>(c)] / 32767.0f, -1.0f);
        EXPECT_EQ(unpacked.w < 0, q.w < 0);
        EXPECT_NEAR(glm::length(frameOf(unpacked).normal - frameOf(q).normal), 0, 1e-4f) << "0.006 degrees";
    }
    EXPECT_EQ(packTangents(float4(2, -2, kNotANumber, 0.5f)), (std::array<int16_t, 4>{ 32767, -32767, 0, 16384 }));
}

TEST(ComputeNormals, OfASmoothShapeAreThoseOfTheShape) {
    Mesh ball = madeMesh(makeIcoSphere({ 2, 4 }));
    for (MeshVertex& vertex : ball.vertices) vertex.normal = float3(0);
    ASSERT_TRUE(computeNormals(ball));
    size_t compared = 0;
    for (MeshVertex const& vertex : ball.vertices) {
        float3 const& at = vertex.position; // the radius is 2, an edge 0.15
        const bool isAtSeam =
                (at.z < 0 && std::abs(at.x) < 0.3f) || std::abs(at.y) > 1.95f; // has a part of its triangles
        if (isAtSeam) continue;
        ++compared;
        EXPECT_NEAR(glm::length(vertex.normal - glm::normalize(vertex.position)), 0, 0.01f);
        EXPECT_NEAR(glm::length(vertex.normal), 1, 1e-6f);
    }
    EXPECT_GT(compared, ball.vertices.size() / 2);
}

// However a square is cut into triangles, its corner counts with a right angle.
TEST(ComputeNormals, WeighTrianglesByTheirAngleNotByTheirNumber) {
    Mesh corner;
    const float3 origin(0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), xy(1, 1, 0);
    for (const float3 p : { origin, x, y, z, xy }) corner.vertices.push_back({ .position = p, .normal = float3(0) });
    corner.indices = { 0, 1, 4, 0, 4, 2, 0, 2, 3, 0, 3, 1 }; // the square in z = 0 has two triangles, the others one
    ASSERT_TRUE(computeNormals(corner));
    EXPECT_NEAR(glm::length(corner.vertices[0].normal - float3(1 / std::sqrt(3.0f))), 0, 1e-6f);
}

TEST(ComputeNormals, LeaveVerticesWithoutAnAreaAlone) {
    Mesh mesh{ .vertices = std::vector<MeshVertex>(4, MeshVertex{ .normal = { 1, 0, 0 } }), .indices = { 0, 1, 2 } };
    ASSERT_TRUE(computeNormals(mesh));
    for (MeshVertex const& vertex : mesh.vertices) EXPECT_EQ(vertex.normal, float3(1, 0, 0));
}

TEST(ComputeTangents, OfPrimitivesMatchTheTangentsOfTheirGenerators) {
    for (Mesh const& mesh :
         { madeMesh(makePlane({ 2, 3, 4, 5 })), madeMesh(makeBox({ .segments = uint3(3) })),
           madeMesh(makeUvSphere({ 1, 64, 32 })), madeMesh(makeTorus({ .slices = 64, .stacks = 48 })),
           madeMesh(makeCylinder({ .slices = 64 })) }) {
        Mesh computed = mesh;
        for (MeshVertex& vertex : computed.vertices) vertex.tangents = float4(0);
        ASSERT_TRUE(computeTangents(computed));
        ASSERT_EQ(computed.vertices.size(), mesh.vertices.size()) << "nothing is mirrored, nothing is split";
        EXPECT_EQ(computed.indices, mesh.indices);
        for (size_t i = 0; i < mesh.vertices.size(); ++i) {
            const TangentFrame found = frameOf(computed.vertices[i].tangents),
                               known = frameOf(mesh.vertices[i].tangents);
            expectFrame(found, false);
            EXPECT_GT(glm::dot(found.tangent, known.tangent), 0.99f);
            EXPECT_GT(glm::dot(found.bitangent, known.bitangent), 0.99f);
        }
    }
}

TEST(ComputeTangents, SplitVerticesWhereMirroredTexturesMeet) {
    Mesh mesh = madeMesh(makePlane({ 2, 2, 2, 1 }));
    for (MeshVertex& vertex : mesh.vertices) vertex.uv.x = std::abs(vertex.position.x); // mirrored at x = 0
    ASSERT_TRUE(computeTangents(mesh));
    EXPECT_EQ(mesh.vertices.size(), 6u + 2);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        float middle = 0;
        for (size_t c = 0; c < 3; ++c) middle += mesh.vertices[mesh.indices[i + c]].position.x;
        for (size_t c = 0; c < 3; ++c) {
            const TangentFrame frame = frameOf(mesh.vertices[mesh.indices[i + c]].tangents);
            expectFrame(frame, middle < 0);
            EXPECT_NEAR(glm::length(frame.tangent - float3(middle < 0 ? -1 : 1, 0, 0)), 0, 7e-5f);
            EXPECT_NEAR(glm::length(frame.bitangent - float3(0, 0, -1)), 0, 7e-5f) << "upwards in the picture";
        }
    }
}

TEST(ComputeTangents, RepairNormalsThatAreNone) {
    Mesh mesh = madeMesh(makePlane({}));
    mesh.vertices[0].normal = float3(0), mesh.vertices[1].normal = float3(kNotANumber);
    mesh.vertices[2].normal = float3(0, 7, 0);
    ASSERT_TRUE(computeTangents(mesh));
    EXPECT_EQ(mesh.vertices[0].normal, float3(0, 0, 1));
    EXPECT_EQ(mesh.vertices[1].normal, float3(0, 0, 1));
    EXPECT_EQ(mesh.vertices[2].normal, float3(0, 1, 0));
    for (MeshVertex const& vertex : mesh.vertices) expectFrame(frameOf(vertex.tangents), false);
}

/// Triangles between random vertices: many without an area, many that share edges with others of any direction.
Mesh randomMesh(std::mt19937& random) {
    Mesh mesh;
    const size_t count = 1 + random() % 12;
    const auto small = [&] { return static_cast<float>(random() % 3) - 1; };
    for (size_t i = 0; i < count; ++i)
        mesh.vertices.push_back({ .position = { small(), small(), small() },
                                  .normal = { small(), small(), small() },
                                  .uv = { small(), small() } });
    for (auto i = 3 * (random() % 10); i > 0; --i) mesh.indices.push_back(static_cast<uint32_t>(random() % count));
    return mesh;
}

TEST(RandomMeshes, GetFramesAndEachEdgeOnce) {
    std::mt19937 random(6);
    for (int i = 0; i < 3000; ++i) {
        Mesh mesh = randomMesh(random);
        std::set<std::array<float, 6>> edges;
        for (size_t at = 0; at < mesh.indices.size(); ++at) {
            float3 a = mesh.vertices[mesh.indices[at]].position;
            float3 b = mesh.vertices[mesh.indices[at % 3 == 2 ? at - 2 : at + 1]].position;
            if (std::array{ b.x, b.y, b.z } < std::array{ a.x, a.y, a.z }) std::swap(a, b);
            if (a != b) edges.insert({ a.x, a.y, a.z, b.x, b.y, b.z });
        }
        const Result<LineQuads> lines = makeWireframe(mesh);
        ASSERT_TRUE(lines);
        EXPECT_EQ(lines->indices.size(), 6 * edges.size());
        ASSERT_TRUE(computeNormals(mesh));
        const size_t triangles = mesh.indices.size();
        ASSERT_TRUE(computeTangents(mesh));
        EXPECT_EQ(mesh.indices.size(), triangles);
        for (MeshVertex const& vertex : mesh.vertices) expectFrame(frameOf(vertex.tangents), vertex.tangents.w < 0);
    }
}

// Euler: a closed mesh of T triangles has 3 T / 2 edges.
TEST(Wireframes, OfClosedMeshesHaveThreeHalvesOfTheirTriangles) {
    for (Mesh mesh :
         { madeMesh(makeBox({ .segments = uint3(2) })), madeMesh(makeUvSphere({})), madeMesh(makeTorus({})) }) {
        for (MeshVertex& vertex : mesh.vertices) vertex.color = float4(vertex.position, 1);
        const Result<LineQuads> lines = makeWireframe(mesh);
        ASSERT_TRUE(lines);
        EXPECT_EQ(lines->vertices.size(), 4 * (mesh.indices.size() / 3 * 3 / 2));
        for (LineVertex const& vertex : lines->vertices) EXPECT_EQ(vertex.color, float4(vertex.position, 1));
    }
}

TEST(HostileMeshes, AreErrorsThatNameThePlace) {
    const auto messages = [](Mesh const& mesh) {
        Mesh forNormals = mesh, forTangents = mesh;
        const Result<void> normals = computeNormals(forNormals), tangents = computeTangents(forTangents);
        const Result<LineQuads> lines = makeWireframe(mesh);
        return std::vector{ normals ? "" : normals.error().message, tangents ? "" : tangents.error().message,
                            lines ? "" : lines.error().message };
    };
    const auto expected = [](std::string const& rule) {
        return std::vector<std::string>{ "computeNormals: " + rule, "computeTangents: " + rule,
                                         "makeWireframe: " + rule };
    };
    const Mesh plane = madeMesh(makePlane({}));
    Mesh odd = plane;
    odd.indices.pop_back();
    EXPECT_EQ(messages(odd), expected("5 indices; triangles have three each"));
    Mesh beyond = plane;
    beyond.indices[4] = 4;
    EXPECT_EQ(messages(beyond), expected("triangle 1 refers to vertex 4 of 4"));
    for (const float bad : { kNotANumber, kEndless, -kEndless }) {
        Mesh broken = plane;
        broken.vertices[2].position.y = bad;
        EXPECT_EQ(messages(broken), expected("the position of vertex 2 is not finite"));
        Mesh unmapped = plane;
        unmapped.vertices[3].uv.y = bad;
        const Result<void> tangents = computeTangents(unmapped);
        ASSERT_FALSE(tangents);
        EXPECT_EQ(tangents.error().message, "computeTangents: the uv of vertex 3 is not finite");
    }
    EXPECT_EQ(messages(Mesh{}), (std::vector<std::string>{ "", "", "" }));
}

TEST(MeshBuffers, DescribeTheVertices) {
    const Mesh mesh = madeMesh(makeBox({ .size = { 1, 2, 3 } }));
    const VertexBufferDesc vertices = mesh.vertexBuffer();
    EXPECT_EQ(vertices.vertexCount, 24u);
    EXPECT_EQ(vertices.stride, 64u);
    EXPECT_EQ(vertices.data.size(), 24u * 64);
    EXPECT_EQ(vertices.attributes.size(), 4u);
    const IndexBufferDesc indices = mesh.indexBuffer();
    EXPECT_EQ(indices.indexCount, 36u);
    EXPECT_EQ(indices.data.size(), 36u * 4);
    EXPECT_EQ(mesh.bounds().min, double3(-0.5, -1, -1.5));
    EXPECT_EQ(mesh.bounds().max, double3(0.5, 1, 1.5));
    EXPECT_TRUE(Mesh{}.bounds().empty());
}

} // namespace
} // namespace filament_core::test
