// SPDX-License-Identifier: Apache-2.0
// Levels of detail of primitives as the loader packs them: where their indices are, and what joints and weights do.
#include "filament_core/assets/gltf/DetailLevels.h"

#include "shaders/interface/ShaderInterface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

namespace filament_core::assets::test {
namespace {

using backend::VertexFormat;

struct PackedVertex {
    float3 position;
    std::array<uint8_t, 4> joints{};
    float4 weights{ 1, 0, 0, 0 };
};

constexpr uint32_t kSide = 20;

/// A hilly grid; `weightOf`: of the second bone, by x.
PrimitiveData hillyGrid(float (*weightOf)(float)) {
    PrimitiveData grid;
    const auto attribute = [&](uint8_t location, VertexFormat format, size_t offset) {
        grid.layout.attributes[grid.layout.attributeCount++] = { .location = location,
                                                                 .format = format,
                                                                 .offset = static_cast<uint16_t>(offset) };
    };
    attribute(shader::kAttributePosition, VertexFormat::Float3, offsetof(PackedVertex, position));
    attribute(shader::kAttributeJoints, VertexFormat::UByte4, offsetof(PackedVertex, joints));
    attribute(shader::kAttributeWeights, VertexFormat::Float4, offsetof(PackedVertex, weights));
    grid.layout.buffers[0].stride = sizeof(PackedVertex);
    grid.isSkinned = true;
    std::vector<PackedVertex> vertices;
    std::vector<uint16_t> indices;
    for (uint32_t y = 0; y <= kSide; ++y) {
        for (uint32_t x = 0; x <= kSide; ++x) {
            const float2 at = float2(x, y) / static_cast<float>(kSide);
            const float second = weightOf(at.x);
            vertices.push_back({ float3(at, 0.02f * std::sin(9 * at.x) * std::cos(8 * at.y)),
                                 { 0, 1, 0, 0 },
                                 { 1 - second, second, 0, 0 } });
            if (x == kSide || y == kSide) continue;
            const auto a = static_cast<uint16_t>(y * (kSide + 1) + x), c = static_cast<uint16_t>(a + kSide + 1);
            for (const int index : { a + 0, a + 1, c + 1, a + 0, c + 1, c + 0 })
                indices.push_back(static_cast<uint16_t>(index));
        }
    }
    const auto bytes = [](auto const& values) {
        const auto all = std::as_bytes(std::span(values));
        return std::vector<std::byte>(all.begin(), all.end());
    };
    grid.vertices = bytes(vertices);
    grid.indices = bytes(indices);
    grid.vertexCount = static_cast<uint32_t>(vertices.size());
    grid.indexCount = static_cast<uint32_t>(indices.size());
    return grid;
}

TEST(DetailLevels, FollowTheIndicesOfThePrimitive) {
    PrimitiveData grid = hillyGrid([](float) { return 0.0f; });
    const std::vector<std::byte> before = grid.indices;
    const std::vector<DetailLevel> levels = addDetailLevels(grid);
    ASSERT_GE(levels.size(), 2u);
    EXPECT_EQ(grid.indexCount, 6 * kSide * kSide);
    EXPECT_EQ(std::memcmp(grid.indices.data(), before.data(), before.size()), 0);
    uint32_t first = grid.indexCount;
    for (DetailLevel const& level : levels) {
        EXPECT_EQ(level.firstIndex, first);
        first += level.indexCount;
    }
    ASSERT_EQ(grid.indices.size(), first * sizeof(uint16_t));
    std::vector<uint16_t> all(first);
    std::memcpy(all.data(), grid.indices.data(), grid.indices.size());
    for (const uint16_t index : all) EXPECT_LT(index, grid.vertexCount);
}

TEST(DetailLevels, WeightsThatChangeRaiseTheError) {
    PrimitiveData rigid = hillyGrid([](float) { return 0.0f; }),
                  bent = hillyGrid([](float x) { return 0.5f + 0.25f * std::sin(8 * x); });
    const std::vector<DetailLevel> ofRigid = addDetailLevels(rigid), ofBent = addDetailLevels(bent);
    ASSERT_FALSE(ofRigid.empty());
    ASSERT_FALSE(ofBent.empty());
    // The same triangles. A vertex between two that are a square away differs from their mean by 0.25 * 8^2 / 20^2 / 2
    // of the bones' boxes, whose diagonal is 1.4 m.
    EXPECT_EQ(ofBent[0].indexCount, ofRigid[0].indexCount);
    EXPECT_GT(ofBent[0].error, ofRigid[0].error + 0.01f);
}

TEST(DetailLevels, OtherPrimitivesHaveNone) {
    PrimitiveData lines = hillyGrid([](float) { return 0.0f; });
    lines.topology = backend::PrimitiveType::Lines;
    EXPECT_TRUE(addDetailLevels(lines).empty());
    PrimitiveData empty;
    EXPECT_TRUE(addDetailLevels(empty).empty());
}

} // namespace
} // namespace filament_core::assets::test
