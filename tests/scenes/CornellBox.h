// SPDX-License-Identifier: Apache-2.0
/// cornellBox: the box of Goral, Torrance, Greenberg and Battaile 1984, "Modeling the Interaction of Light between
/// Diffuse Surfaces": red and green sides, a lamp below the ceiling, two blocks, open towards +z.
///   Space   x from -1 to 1, y from 0 to 2, z from -1 to 1, metres.
///   Out     one mesh and node for each of its colours; the blocks are one mesh that two nodes share.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"

#include <array>
#include <cmath>

namespace filament_core::tests {

namespace cornell {

inline void addQuad(assets::GlbPrimitive& primitive, std::array<float3, 4> const& corners) {
    const auto first = static_cast<uint32_t>(primitive.positions.size());
    const float3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (float3 const& corner : corners) primitive.positions.push_back(corner), primitive.normals.push_back(normal);
    for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) primitive.indices.push_back(first + i);
}

/// Of half a metre a side and 1 m high, without a bottom.
inline assets::GlbPrimitive block(uint32_t material) {
    assets::GlbPrimitive primitive{ .material = material };
    const std::array<float3, 4> foot{ float3(-0.3f, 0, 0.3f), float3(0.3f, 0, 0.3f), float3(0.3f, 0, -0.3f),
                                      float3(-0.3f, 0, -0.3f) };
    const float3 up(0, 1, 0);
    for (size_t i = 0; i < 4; ++i) {
        const float3 a = foot[i], b = foot[(i + 1) % 4];
        addQuad(primitive, { a, b, b + up, a + up });
    }
    addQuad(primitive, { foot[0] + up, foot[1] + up, foot[2] + up, foot[3] + up });
    return primitive;
}

inline double4x4 placed(double3 at, double height, double radians) {
    double4x4 transform(1.0);
    const double c = std::cos(radians), s = std::sin(radians);
    transform[0] = { c, 0, -s, 0 };
    transform[1] = { 0, height, 0, 0 };
    transform[2] = { s, 0, c, 0 };
    transform[3] = double4(at, 1);
    return transform;
}

} // namespace cornell

/// `lamp`: emission of the lamp, on the scale of glTF's emissiveFactor; 0: there is none.
inline assets::GlbScene cornellBox(float lamp = 8) {
    using cornell::addQuad;
    assets::GlbScene scene{ .name = "cornell" };
    const auto paint = [&](const char* name, float3 color) {
        assets::MaterialData material{ .name = name };
        material.baseColorFactor = float4(color, 1);
        material.metallicFactor = 0;
        material.roughnessFactor = 1;
        scene.materials.push_back(material);
        return static_cast<uint32_t>(scene.materials.size() - 1);
    };
    const uint32_t white = paint("white", float3(0.73f)), red = paint("red", { 0.63f, 0.06f, 0.05f }),
                   green = paint("green", { 0.14f, 0.45f, 0.09f }), lit = paint("lamp", float3(0.0f));
    scene.materials[lit].emissiveFactor = { 1, 0.85f, 0.6f };
    scene.materials[lit].emissiveStrength = lamp;

    assets::GlbPrimitive shell{ .material = white }, left{ .material = red }, right{ .material = green },
            lampShade{ .material = lit };
    addQuad(shell, { float3(-1, 0, 1), float3(1, 0, 1), float3(1, 0, -1), float3(-1, 0, -1) });
    addQuad(shell, { float3(-1, 2, -1), float3(1, 2, -1), float3(1, 2, 1), float3(-1, 2, 1) });
    addQuad(shell, { float3(-1, 0, -1), float3(1, 0, -1), float3(1, 2, -1), float3(-1, 2, -1) });
    addQuad(left, { float3(-1, 0, 1), float3(-1, 0, -1), float3(-1, 2, -1), float3(-1, 2, 1) });
    addQuad(right, { float3(1, 0, -1), float3(1, 0, 1), float3(1, 2, 1), float3(1, 2, -1) });
    addQuad(lampShade, { float3(-0.3f, 1.99f, -0.3f), float3(0.3f, 1.99f, -0.3f), float3(0.3f, 1.99f, 0.3f),
                         float3(-0.3f, 1.99f, 0.3f) });
    scene.meshes = {
        { "shell", { shell } }, { "left", { left } }, { "right", { right } }, { "block", { cornell::block(white) } }
    };
    scene.nodes = { { .name = "shell", .mesh = 0 },
                    { .name = "left", .mesh = 1 },
                    { .name = "right", .mesh = 2 },
                    { .name = "tall", .parentFromNode = cornell::placed({ -0.35, 0, -0.3 }, 1.2, 0.3), .mesh = 3 },
                    { .name = "low", .parentFromNode = cornell::placed({ 0.35, 0, 0.3 }, 0.6, -0.3), .mesh = 3 } };
    if (lamp <= 0) return scene;
    scene.meshes.push_back({ "lamp", { lampShade } });
    scene.nodes.push_back({ .name = "lamp", .mesh = 4 });
    return scene;
}

} // namespace filament_core::tests
