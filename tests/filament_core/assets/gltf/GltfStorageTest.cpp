// SPDX-License-Identifier: Apache-2.0
// Vertices in fewer bits: decoded values are as close to the stored ones as the format allows.
#include "base/math/Half.h"
#include "filament_core/assets/gltf/GltfGeometry.h"
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace filament_core::assets {
namespace {

namespace lib = shader::lib;
using backend::VertexFormat;

float3 randomUnit(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(float3(normal(random), normal(random), normal(random)));
}

/// A cloud 4 m long around (100, 2, -30), with a frame at each point.
GltfGeometry cloud() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    GltfGeometry geometry;
    geometry.wasIndexed = true;
    for (uint32_t i = 0; i < 300; ++i) {
        geometry.positions.push_back(float3(100, 2, -30) +
                                     float3(2, 0.5f, 1) * float3(unit(random), unit(random), unit(random)));
        const float3 n = randomUnit(random), other = randomUnit(random);
        geometry.normals.push_back(n);
        geometry.tangents.push_back(float4(glm::normalize(glm::cross(n, other)), i % 2 ? -1.0f : 1.0f));
        geometry.indices.push_back(i);
    }
    return geometry;
}

backend::VertexAttribute const& attribute(PrimitiveData const& primitive, uint8_t location) {
    for (uint32_t i = 0; i < primitive.layout.attributeCount; ++i) {
        if (primitive.layout.attributes[i].location == location) return primitive.layout.attributes[i];
    }
    ADD_FAILURE() << "no attribute " << int{ location };
    return primitive.layout.attributes[0];
}

/// What the shader reads.
float4 read(PrimitiveData const& primitive, size_t vertex, uint8_t location) {
    backend::VertexAttribute const& at = attribute(primitive, location);
    const std::byte* const bytes = &primitive.vertices[vertex * primitive.layout.buffers[0].stride + at.offset];
    float4 value(0, 0, 0, 1);
    uint16_t words[4];
    int8_t small[4];
    std::memcpy(small, bytes, sizeof(small));
    if (at.format != VertexFormat::Byte4N) std::memcpy(words, bytes, sizeof(words));
    for (int c = 0; c < 4; ++c) {
        if (at.format == VertexFormat::Half4) value[c] = floatFromHalf(words[c]);
        if (at.format == VertexFormat::UShort4N) value[c] = static_cast<float>(words[c]) / 65535.0f;
        if (at.format == VertexFormat::Short4N)
            value[c] = std::max(static_cast<float>(static_cast<int16_t>(words[c])) / 32767.0f, -1.0f);
        if (at.format == VertexFormat::Byte4N) value[c] = std::max(static_cast<float>(small[c]) / 127.0f, -1.0f);
    }
    if (at.format == VertexFormat::Float3) std::memcpy(&value[0], bytes, 12);
    if (at.format == VertexFormat::Float4) std::memcpy(&value[0], bytes, 16);
    return value;
}

TEST(GltfStorage, Unorm16PositionsAreWithinHalfAStepOfTheBoundingCube) {
    const GltfGeometry geometry = cloud();
    const PrimitiveData packed = packGeometry(geometry, { .positions = PositionStorage::Unorm16 });
    EXPECT_EQ(attribute(packed, 0).format, VertexFormat::UShort4N);
    EXPECT_NEAR(packed.positionScale, 4, 0.05f) << "the longest side";
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        const float3 decoded = packed.positionOffset + packed.positionScale * float3(read(packed, i, 0));
        // Half a step, plus the rounding of floats around 100.
        EXPECT_LT(glm::distance(decoded, geometry.positions[i]), packed.positionScale / 65535 + 2e-5f) << i;
    }
    EXPECT_EQ(packed.boundsMin, float3(0));
    EXPECT_LE(std::max({ packed.boundsMax.x, packed.boundsMax.y, packed.boundsMax.z }), 1.0f);
}

TEST(GltfStorage, HalfPositionsKeepElevenBitsAndThoseBeyondTheirRangeStayFloats) {
    GltfGeometry geometry = cloud();
    const PrimitiveData packed = packGeometry(geometry, { .positions = PositionStorage::Half });
    EXPECT_EQ(attribute(packed, 0).format, VertexFormat::Half4);
    EXPECT_EQ(packed.positionScale, 1.0f);
    for (size_t i = 0; i < geometry.positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float position = geometry.positions[i][c];
            EXPECT_NEAR(read(packed, i, 0)[c], position, std::abs(position) * 0x1p-11f + 1e-6f);
        }
    }
    geometry.positions[5].y = 70'000;
    EXPECT_EQ(attribute(packGeometry(geometry, { .positions = PositionStorage::Half }), 0).format,
              VertexFormat::Float3);
}

TEST(GltfStorage, PointsAtOnePlaceHaveAScaleThatCanBeDividedBy) {
    GltfGeometry geometry;
    geometry.wasIndexed = true;
    geometry.positions.assign(3, float3(5, 6, 7));
    geometry.indices = { 0, 1, 2 };
    const PrimitiveData packed = packGeometry(geometry, { .positions = PositionStorage::Unorm16 });
    EXPECT_EQ(packed.positionScale, 1.0f);
    EXPECT_EQ(packed.positionOffset + float3(read(packed, 1, 0)), float3(5, 6, 7));
}

TEST(GltfStorage, TangentFramesTurnByNoMoreThanTheirStepAndKeepTheirHandedness) {
    const GltfGeometry geometry = cloud();
    const std::tuple<TangentStorage, VertexFormat, float> storages[] = {
        { TangentStorage::Snorm16, VertexFormat::Short4N, 0.006f },
        { TangentStorage::Snorm8, VertexFormat::Byte4N, 1.5f },
        { TangentStorage::Float, VertexFormat::Float4, 0.004f }, // w is kept off 0 by 1/32767
    };
    for (auto const& [storage, format, degrees] : storages) {
        SCOPED_TRACE(toString(storage));
        const PrimitiveData packed = packGeometry(geometry, { .tangents = storage });
        EXPECT_EQ(attribute(packed, 1).format, format);
        float worst = 0;
        for (size_t i = 0; i < geometry.normals.size(); ++i) {
            float3 n, t, b;
            lib::tangentFrame(read(packed, i, 1), n, t, b);
            const auto apart = [](float3 x, float3 y) {
                return glm::degrees(std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)));
            };
            worst = std::max({ worst, apart(n, geometry.normals[i]), apart(t, float3(geometry.tangents[i])) });
            const float3 expected =
                    glm::cross(geometry.normals[i], float3(geometry.tangents[i])) * geometry.tangents[i].w;
            EXPECT_GT(glm::dot(b, expected), 0.9f) << i;
        }
        EXPECT_LT(worst, degrees);
        EXPECT_EQ(worst > 0.1f, storage == TangentStorage::Snorm8) << "8 bits, and only they, turn it that far";
    }
}

} // namespace
} // namespace filament_core::assets
