// SPDX-License-Identifier: Apache-2.0
#include "base/Result.h"
#include "base/math/Elementary.h"
#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/geometry/Tangents.h"

#include <filament_core/Mesh.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace filament_core {
namespace {

constexpr float kTangentScale = 32767;

bool isFinite(float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<void> checkMesh(Mesh const& mesh, std::string_view function) {
    if (mesh.indices.size() % 3 != 0)
        return fail(ErrorCode::InvalidArgument, "{}: {} indices; triangles have three each", function,
                    mesh.indices.size());
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (!isFinite(mesh.vertices[i].position))
            return fail(ErrorCode::InvalidArgument, "{}: the position of vertex {} is not finite", function, i);
    }
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        if (mesh.indices[i] >= mesh.vertices.size())
            return fail(ErrorCode::InvalidArgument, "{}: triangle {} refers to vertex {} of {}", function, i / 3,
                        mesh.indices[i], mesh.vertices.size());
    }
    return {};
}

/// Of the corner at `a`, in radians; 0 if it has no sides.
double cornerAngle(double3 a, double3 b, double3 c) {
    const double3 ab = b - a, ac = c - a;
    return elementary::atan2(glm::length(glm::cross(ab, ac)), glm::dot(ab, ac));
}

/// The same number for positions of equal bits; -0 is 0.
class Places {
public:
    uint32_t numberOf(float3 position) {
        const float3 p = position + 0.0f;
        const Key key{ std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z) };
        return mNumbers.try_emplace(key, static_cast<uint32_t>(mNumbers.size())).first->second;
    }

private:
    using Key = std::array<uint32_t, 3>;
    struct Hash {
        size_t operator()(Key const& key) const {
            uint64_t hash = key[0];
            for (const uint32_t word : { key[1], key[2] }) hash = (hash ^ (hash >> 29)) * 0x9E3779B97F4A7C15u + word;
            return hash ^ (hash >> 32);
        }
    };
    std::unordered_map<Key, uint32_t, Hash> mNumbers;
};

} // namespace

VertexBufferDesc Mesh::vertexBuffer() const {
    return { .vertexCount = static_cast<uint32_t>(vertices.size()),
             .stride = sizeof(MeshVertex),
             .attributes = { { Attribute::Position, VertexFormat::Float3, offsetof(MeshVertex, position) },
                             { Attribute::Tangents, VertexFormat::Float4, offsetof(MeshVertex, tangents) },
                             { Attribute::Color, VertexFormat::Float4, offsetof(MeshVertex, color) },
                             { Attribute::Uv0, VertexFormat::Float2, offsetof(MeshVertex, uv) } },
             .data = std::as_bytes(std::span(vertices)),
             .name = "mesh" };
}

IndexBufferDesc Mesh::indexBuffer() const {
    return { .indexCount = static_cast<uint32_t>(indices.size()),
             .format = IndexFormat::UInt32,
             .data = std::as_bytes(std::span(indices)),
             .name = "mesh" };
}

Box Mesh::bounds() const {
    Box bounds;
    for (MeshVertex const& vertex : vertices) bounds.add({ double3(vertex.position), double3(vertex.position) });
    return bounds;
}

Occluder Mesh::occluder() const {
    std::vector<float3> positions;
    positions.reserve(vertices.size());
    for (MeshVertex const& vertex : vertices) positions.push_back(vertex.position);
    return makeOccluder(positions, indices);
}

Result<void> computeNormals(Mesh& mesh) {
    if (Result<void> checked = checkMesh(mesh, "computeNormals"); !checked) return checked;
    std::vector<double3> sums(mesh.vertices.size(), double3(0));
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto at = [&](size_t corner) { return mesh.indices[t + corner % 3]; };
        const auto place = [&](size_t corner) { return double3(mesh.vertices[at(corner)].position); };
        const double3 area = glm::cross(place(1) - place(0), place(2) - place(0));
        const double twice = glm::length(area);
        // A triangle without area has no direction; the form of the test also skips NaN.
        if (!(twice > 0)) continue;
        for (size_t c = 0; c < 3; ++c) sums[at(c)] += area / twice * cornerAngle(place(c), place(c + 1), place(c + 2));
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        if (const double length = glm::length(sums[i]); length > 0) mesh.vertices[i].normal = float3(sums[i] / length);
    }
    return {};
}

Result<void> computeTangents(Mesh& mesh) {
    if (Result<void> checked = checkMesh(mesh, "computeTangents"); !checked) return checked;
    std::vector<float3> positions, normals;
    std::vector<float2> uvs;
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        MeshVertex& vertex = mesh.vertices[i];
        if (!std::isfinite(vertex.uv.x) || !std::isfinite(vertex.uv.y))
            return fail(ErrorCode::InvalidArgument, "computeTangents: the uv of vertex {} is not finite", i);
        vertex.normal = assets::normalizedOr(vertex.normal, float3(0, 0, 1));
        positions.push_back(vertex.position);
        normals.push_back(vertex.normal);
        uvs.emplace_back(vertex.uv.x, -vertex.uv.y); // generateTangents() counts v downwards
    }
    assets::TangentOutput found = assets::generateTangents({ positions, normals, uvs, mesh.indices });
    for (size_t i = mesh.vertices.size(); i < found.sources.size(); ++i) {
        const MeshVertex split = mesh.vertices[found.sources[i]];
        mesh.vertices.push_back(split);
    }
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
        const float4 tangent = found.tangents[i];
        mesh.vertices[i].tangents = tangentsOf(mesh.vertices[i].normal, float3(tangent), tangent.w);
    }
    mesh.indices = std::move(found.indices);
    return {};
}

float4 tangentsOf(float3 normal, float3 tangent, float handedness) {
    return assets::tangentFrameQuaternion(normal, tangent, handedness, 1 / kTangentScale);
}

float4 tangentsFromNormal(float3 normal) {
    const float3 unit = assets::normalizedOr(normal, float3(0, 0, 1));
    return tangentsOf(unit, assets::anyTangent(unit));
}

std::vector<float4> tangentsFromNormals(std::span<const float3> normals) {
    std::vector<float4> tangents;
    tangents.reserve(normals.size());
    for (float3 const& normal : normals) tangents.push_back(tangentsFromNormal(normal));
    return tangents;
}

TangentFrame frameOf(float4 tangents) {
    const float4 q = tangents; // shaders/lib/tangent.glsl
    const float3 normal(2 * (q.x * q.z + q.y * q.w), 2 * (q.y * q.z - q.x * q.w), 1 - 2 * (q.x * q.x + q.y * q.y));
    const float3 tangent(1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.z * q.w), 2 * (q.x * q.z - q.y * q.w));
    return { .tangent = tangent,
             .bitangent = glm::cross(normal, tangent) * (q.w < 0 ? -1.0f : 1.0f),
             .normal = normal };
}

std::array<int16_t, 4> packTangents(float4 tangents) {
    std::array<int16_t, 4> packed{};
    for (int i = 0; i < 4; ++i) {
        const float code = glm::clamp(tangents[i] * kTangentScale, -kTangentScale, kTangentScale);
        packed[static_cast<size_t>(i)] = std::isfinite(code) ? static_cast<int16_t>(std::lround(code)) : int16_t{ 0 };
    }
    return packed;
}

Result<LineQuads> makeWireframe(Mesh const& mesh) {
    if (Result<void> checked = checkMesh(mesh, "makeWireframe"); !checked) return checked.error();
    Places places;
    std::vector<uint32_t> numbers;
    numbers.reserve(mesh.vertices.size());
    for (MeshVertex const& vertex : mesh.vertices) numbers.push_back(places.numberOf(vertex.position));
    std::unordered_set<uint64_t> known;
    std::vector<float3> points;
    std::vector<float4> colors;
    for (size_t i = 0; i < mesh.indices.size(); ++i) {
        const uint32_t from = mesh.indices[i], to = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
        const auto [low, high] = std::minmax(numbers[from], numbers[to]);
        if (low == high || !known.insert(uint64_t{ low } << 32 | high).second) continue;
        for (const uint32_t end : { from, to }) {
            points.push_back(mesh.vertices[end].position);
            colors.push_back(mesh.vertices[end].color);
        }
    }
    return makeLineQuads(points, PrimitiveType::Lines, colors);
}

} // namespace filament_core
