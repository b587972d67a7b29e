// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/UvDensity.h"

#include "shaders/interface/ShaderInterface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace filament_core::scene {
namespace {

struct UvVertex {
    float3 position;
    float2 uv;
};

UvDensity densityOf(std::vector<UvVertex> const& vertices, std::vector<uint16_t> const& indices,
                    backend::PrimitiveType topology = backend::PrimitiveType::Triangles) {
    GeometryLayout layout{ .topology = topology };
    layout.vertices.attributes[0] = { shader::kAttributePosition, 0, backend::VertexFormat::Float3, 0 };
    layout.vertices.attributes[1] = { shader::kAttributeUv0, 0, backend::VertexFormat::Float2, 12 };
    layout.vertices.attributeCount = 2;
    layout.vertices.buffers[0].stride = sizeof(UvVertex);
    layout.vertices.bufferCount = 1;
    return uvDensityOf(layout, std::as_bytes(std::span(vertices)), backend::IndexFormat::UInt16,
                       std::as_bytes(std::span(indices)));
}

/// Areas of 6 m^2, with 3 / 2 of the texture's area, and of 1 / 2 m^2, with 1 / 2 of it.
const std::vector<UvVertex> kTriangles{
    { { 0, 0, 1 }, { 0, 0 } }, { { 3, 0, 1 }, { 3, 0 } }, { { 0, 4, 1 }, { 0, 1 } },
    { { 0, 0, 0 }, { 0, 0 } }, { { 0, 1, 0 }, { 1, 0 } }, { { 0, 0, 1 }, { 0, 1 } }
};

TEST(UvDensity, IsThatOfTheTriangleWithTheLeast) {
    EXPECT_FLOAT_EQ(densityOf(kTriangles, { 0, 1, 2, 3, 4, 5 })[0], 0.5f);
    EXPECT_FLOAT_EQ(densityOf(kTriangles, { 3, 4, 5 })[0], 1.0f);
    EXPECT_FLOAT_EQ(densityOf(kTriangles, { 2, 1, 0 })[0], 0.5f) << "the other way round";
}

TEST(UvDensity, DoesNotCountTrianglesThatAreNotDrawn) {
    EXPECT_FLOAT_EQ(densityOf(kTriangles, { 3, 4, 5, 0, 1, 1 })[0], 1.0f);
}

TEST(UvDensity, IsZeroWhereNothingBoundsTheLevel) {
    std::vector<UvVertex> line = kTriangles;
    line[2].uv = { 6, 0 };
    EXPECT_EQ(densityOf(line, { 3, 4, 5, 0, 1, 2 })[0], 0) << "a triangle shows a line of the texture";
    line[2].uv = { NAN, 0 };
    EXPECT_EQ(densityOf(line, { 0, 1, 2 })[0], 0);
    EXPECT_EQ(densityOf(kTriangles, { 0, 1, 7 })[0], 0) << "an index out of range";
    EXPECT_EQ(densityOf(kTriangles, { 0, 1, 2 }, backend::PrimitiveType::Points)[0], 0);
    EXPECT_EQ(densityOf(kTriangles, { 0, 1, 2 })[1], 0) << "a set that the mesh does not have";
}

} // namespace
} // namespace filament_core::scene
