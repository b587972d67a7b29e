// SPDX-License-Identifier: Apache-2.0
/// quadFile: a .glb with one quad of 2 x 2 metres in the plane z = 0, which looks at +z.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"

#include <gtest/gtest.h>

#include <vector>

namespace filament_core::test {

/// `uvs`: from the upper left, counter-clockwise.
inline std::vector<std::byte> quadFile(std::vector<assets::GlbImage> images, assets::MaterialData const& material,
                                       std::vector<float2> uvs, float3 normal = { 0, 0, 1 }) {
    assets::GlbScene scene{ .images = std::move(images) };
    scene.materials.push_back(material);
    scene.meshes.push_back({ .name = "quad",
                             .primitives = { { .positions = { { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 } },
                                               .normals = std::vector<float3>(4, glm::normalize(normal)),
                                               .uvs = std::move(uvs),
                                               .indices = { 0, 1, 2, 0, 2, 3 },
                                               .material = 0 } } });
    scene.nodes.push_back({ .name = "quad", .mesh = 0 });
    const Result<std::vector<std::byte>> glb = assets::writeGlb(scene);
    EXPECT_TRUE(glb) << glb.error().message;
    return *glb;
}

} // namespace filament_core::test
