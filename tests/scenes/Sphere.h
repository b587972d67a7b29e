// SPDX-License-Identifier: Apache-2.0
/// A unit sphere for tests and benches: positions, tangent frames, indices.
#pragma once

#include <filament_core/filament_core.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace filament_core::scenes {

struct SphereVertex {
    float3 position;
    float4 tangents; ///< quaternion that turns +z into the normal and +x into the direction of growing longitude
};

struct SphereMesh {
    std::vector<SphereVertex> vertices;
    std::vector<uint16_t> indices;
};

/// The quaternion of an orthonormal frame with columns t, b, n. Shepperd 1978, w >= 0 branch first.
inline float4 quaternionFromFrame(float3 t, float3 b, float3 n) {
    const float trace = t.x + b.y + n.z;
    if (trace > 0) {
        const float s = 2 * std::sqrt(trace + 1);
        return { (b.z - n.y) / s, (n.x - t.z) / s, (t.y - b.x) / s, s / 4 };
    }
    if (t.x > b.y && t.x > n.z) {
        const float s = 2 * std::sqrt(1 + t.x - b.y - n.z);
        return { s / 4, (b.x + t.y) / s, (n.x + t.z) / s, (b.z - n.y) / s };
    }
    if (b.y > n.z) {
        const float s = 2 * std::sqrt(1 + b.y - t.x - n.z);
        return { (b.x + t.y) / s, s / 4, (n.y + b.z) / s, (n.x - t.z) / s };
    }
    const float s = 2 * std::sqrt(1 + n.z - t.x - b.y);
    return { (n.x + t.z) / s, (n.y + b.z) / s, s / 4, (t.y - b.x) / s };
}

inline SphereMesh makeSphere(uint32_t rows = 48, uint32_t columns = 96) {
    SphereMesh mesh;
    constexpr float pi = std::numbers::pi_v<float>;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const float theta = pi * static_cast<float>(row) / static_cast<float>(rows);
            const float phi = 2 * pi * static_cast<float>(column) / static_cast<float>(columns);
            const float3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            const float3 t(std::cos(phi), 0, -std::sin(phi));
            const float3 b(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x);
            float4 q = quaternionFromFrame(t, b, n);
            if (q.w < 0) q = -q;
            if (q.w < 1e-5f) q.w = 1e-5f; // the sign of w is the handedness: never zero
            mesh.vertices.push_back({ n, q });
        }
    }
    const uint32_t stride = columns + 1;
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const auto a = static_cast<uint16_t>(row * stride + column);
            const auto below = static_cast<uint16_t>(a + stride);
            const uint16_t next = static_cast<uint16_t>(a + 1), belowNext = static_cast<uint16_t>(below + 1);
            mesh.indices.insert(mesh.indices.end(), { a, below, belowNext, a, belowNext, next });
        }
    }
    return mesh;
}

/// The buffers of a sphere, which live as long as it.
class Sphere {
public:
    Sphere(Engine& engine, SphereMesh const& mesh)
            : mVertices(engine.own(engine.create(VertexBufferDesc{
                      .vertexCount = static_cast<uint32_t>(mesh.vertices.size()),
                      .stride = sizeof(SphereVertex),
                      .attributes = { { Attribute::Position, VertexFormat::Float3, 0 },
                                      { Attribute::Tangents, VertexFormat::Float4, offsetof(SphereVertex, tangents) } },
                      .data = std::as_bytes(std::span(mesh.vertices)),
                      .name = "sphere" }))),
              mIndices(engine.own(
                      engine.create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(mesh.indices.size()),
                                                     .data = std::as_bytes(std::span(mesh.indices)),
                                                     .name = "sphere" }))) {}

    RenderableDesc renderable(MaterialInstance material, double4x4 const& worldFromObject = double4x4(1)) const {
        return { .vertices = mVertices,
                 .indices = mIndices,
                 .material = material,
                 .bounds = Box{ double3(-1), double3(1) },
                 .worldFromObject = worldFromObject };
    }

private:
    Owned<VertexBuffer> mVertices;
    Owned<IndexBuffer> mIndices;
};

} // namespace filament_core::scenes
