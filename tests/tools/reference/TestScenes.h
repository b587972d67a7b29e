// SPDX-License-Identifier: Apache-2.0
/// Models built by code, skies from formulas, and statistics for tests of random estimates.
#pragma once

#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/geometry/TangentFrame.h"
#include "shaders/interface/ShaderInterface.h"
#include "tools/reference/Reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numbers>
#include <span>

namespace filament_core::reference {

inline constexpr double kPiExact = std::numbers::pi;

/// The exposure with factor 1: images show lux and radiance unchanged.
inline Exposure plainExposure() { return { .aperture = 1, .shutterSeconds = 1.2f, .iso = 100 }; }

struct TestVertex {
    float3 position{ 0.0f };
    float3 normal{ 0, 0, 1 };
    float3 tangent{ 1, 0, 0 };
    float2 uv{ 0.0f };
};

inline assets::PrimitiveData makePrimitive(std::span<const TestVertex> vertices, std::span<const uint32_t> indices) {
    struct Packed {
        float3 position;
        std::array<int16_t, 4> frame;
        float2 uv;
    };
    assets::PrimitiveData primitive;
    primitive.layout.attributes[0] = { shader::kAttributePosition, 0, backend::VertexFormat::Float3, 0 };
    primitive.layout.attributes[1] = { shader::kAttributeTangents, 0, backend::VertexFormat::Short4N, 12 };
    primitive.layout.attributes[2] = { shader::kAttributeUv0, 0, backend::VertexFormat::Float2, 20 };
    primitive.layout.buffers[0].stride = sizeof(Packed);
    primitive.layout.attributeCount = 3;
    primitive.layout.bufferCount = 1;
    primitive.vertexCount = static_cast<uint32_t>(vertices.size());
    primitive.indexCount = static_cast<uint32_t>(indices.size());
    primitive.indexFormat = backend::IndexFormat::UInt32;
    primitive.hasNormals = primitive.hasTangents = primitive.hasUv0 = true;
    primitive.material = 0;
    primitive.boundsMin = primitive.boundsMax = vertices[0].position;
    for (TestVertex const& vertex : vertices) {
        const Packed packed{ vertex.position, assets::encodeTangentFrame(vertex.normal, vertex.tangent, 1), vertex.uv };
        const auto bytes = std::as_bytes(std::span(&packed, 1));
        primitive.vertices.insert(primitive.vertices.end(), bytes.begin(), bytes.end());
        primitive.boundsMin = glm::min(primitive.boundsMin, vertex.position);
        primitive.boundsMax = glm::max(primitive.boundsMax, vertex.position);
    }
    const auto bytes = std::as_bytes(indices);
    primitive.indices.assign(bytes.begin(), bytes.end());
    return primitive;
}

inline std::shared_ptr<assets::ModelData> makeModel(assets::PrimitiveData primitive, assets::MaterialData material) {
    auto model = std::make_shared<assets::ModelData>();
    model->name = "test";
    model->materials.push_back(std::move(material));
    model->meshes.push_back({ "mesh", { std::move(primitive) } });
    model->nodes.push_back({ .name = "node", .mesh = 0 });
    return model;
}

/// A square of side 2 around the origin; its front and normal are +y, u grows with x, v with z.
inline assets::PrimitiveData floorPrimitive() {
    const TestVertex vertices[4] = { { { -1, 0, -1 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0 } },
                                     { { 1, 0, -1 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 0 } },
                                     { { 1, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1 } },
                                     { { -1, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 1 } } };
    const uint32_t indices[6] = { 0, 3, 2, 0, 2, 1 };
    return makePrimitive(vertices, indices);
}

/// A sphere of radius 1, seen from outside; `inwards`: from inside.
inline assets::PrimitiveData spherePrimitive(uint32_t rows = 64, bool inwards = false) {
    const uint32_t columns = 2 * rows;
    std::vector<TestVertex> vertices;
    std::vector<uint32_t> indices;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const double theta = kPiExact * row / rows, phi = 2 * kPiExact * column / columns;
            const double3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
            vertices.push_back({ float3(n), float3(inwards ? -n : n), float3(double3(std::cos(phi), 0, -std::sin(phi))),
                                 float2(double2(double(column) / columns, double(row) / rows)) });
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = row * (columns + 1) + column, below = a + columns + 1;
            for (const uint32_t index : { a, below, below + 1, a, below + 1, a + 1 }) indices.push_back(index);
            if (!inwards) continue;
            std::swap(indices[indices.size() - 1], indices[indices.size() - 2]);
            std::swap(indices[indices.size() - 4], indices[indices.size() - 5]);
        }
    }
    return makePrimitive(vertices, indices);
}

/// A cube from -1 to 1 whose faces look inwards.
inline assets::PrimitiveData roomPrimitive() {
    std::vector<TestVertex> vertices;
    std::vector<uint32_t> indices;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : { -1.0f, 1.0f }) {
            float3 normal(0.0f), u(0.0f), v(0.0f);
            normal[axis] = -side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            const auto first = static_cast<uint32_t>(vertices.size());
            for (const float2 corner : { float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, 1) }) {
                vertices.push_back({ -normal + u * corner.x + v * corner.y, normal, u, corner });
            }
            for (const uint32_t i : { 0u, 1u, 2u, 0u, 2u, 3u }) indices.push_back(first + (side < 0 ? i : (4 - i) % 4));
        }
    }
    return makePrimitive(vertices, indices);
}

inline assets::MaterialData lambert(float albedo) {
    assets::MaterialData material;
    material.baseColorFactor = float4(albedo, albedo, albedo, 1);
    material.metallicFactor = 0;
    material.roughnessFactor = 1;
    return material;
}

inline assets::MaterialData metal(float roughness, float3 color = float3(1.0f)) {
    assets::MaterialData material;
    material.baseColorFactor = float4(color, 1);
    material.metallicFactor = 1;
    material.roughnessFactor = roughness;
    return material;
}

/// An image whose pixel in direction d is sky(d).
inline std::shared_ptr<assets::HdrImage> makeSky(uint32_t height, std::function<float3(double3)> const& sky) {
    auto image = std::make_shared<assets::HdrImage>();
    image->width = 2 * height;
    image->height = height;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < image->width; ++x) {
            const float2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(image->width),
                            (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
            image->pixels.push_back(sky(double3(assets::directionFromEquirect(uv))));
        }
    }
    return image;
}

inline ReferenceEnvironment uniformSky(float radiance = 1) {
    return { .image = makeSky(8, [=](double3) { return float3(radiance); }), .illuminance = Lux{ 1 } };
}

/// Looks from `eye` at `at` through a narrow lens, so that a small image covers almost a single direction.
inline ReferenceView viewFrom(double3 eye, double3 at, uint2 size = { 8, 8 }, float fovDegrees = 1) {
    return { .camera = Camera::lookAt(eye, at, { .verticalFovDegrees = fovDegrees }, plainExposure()), .size = size };
}

/// Mean of an image and the standard error of that mean: pixels are independent.
struct Estimate {
    double3 mean{ 0.0 }, error{ 0.0 };
};

inline Estimate estimateOf(ReferenceImage const& image) {
    Estimate estimate;
    for (float3 const& color : image.color) estimate.mean += double3(color);
    for (float3 const& error : image.standardError) estimate.error += double3(error) * double3(error);
    const auto count = static_cast<double>(image.color.size());
    return { estimate.mean / count, glm::sqrt(estimate.error) / count };
}

inline ReferenceImage rendered(ReferenceScene const& scene, ReferenceView const& view,
                               ReferenceSettings const& settings, int workers = 1) {
    jobs::JobSystem jobs({ .workers = workers });
    Result<ReferenceImage> image = render(scene, view, settings, jobs);
    EXPECT_TRUE(image.ok()) << image.error().message;
    if (!image) return {};
    EXPECT_EQ(image->statistics.lostSamples, 0u);
    return std::move(*image);
}

inline Estimate estimated(ReferenceScene const& scene, ReferenceView const& view, ReferenceSettings const& settings) {
    return estimateOf(rendered(scene, view, settings));
}

/// Within four standard errors, plus an allowance for rounding and tessellation.
inline void expectAgrees(double mean, double error, double expected, double slack, const char* what) {
    EXPECT_LE(std::abs(mean - expected), 4 * error + slack)
            << what << ": " << mean << " +- " << error << ", expected " << expected;
}

inline void expectAgrees(Estimate const& estimate, double3 expected, double slack) {
    expectAgrees(estimate.mean.x, estimate.error.x, expected.x, slack, "red");
    expectAgrees(estimate.mean.y, estimate.error.y, expected.y, slack, "green");
    expectAgrees(estimate.mean.z, estimate.error.z, expected.z, slack, "blue");
}

} // namespace filament_core::reference
