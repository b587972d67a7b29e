// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialMeshes.h"

#include "filament_core/assets/geometry/TangentFrame.h"

#include <filament_core/Lines.h>
#include <filament_core/Points.h>

#include <cmath>

namespace filament_core::tools {
namespace {

/// A point of a parametric surface; normal and tangent need not be unit.
struct SurfacePoint {
    float3 position, normal, tangent;
};

constexpr float kLeastW = 1e-5f;

float4 hueOf(float2 uv) {
    const auto wave = [&](float phase) { return 0.5f + 0.45f * std::cos(2 * kPi * (uv.x + phase) + 3 * uv.y); };
    return { wave(0), wave(0.33f), wave(0.67f), 0.25f + 0.75f * uv.y };
}

MaterialVertex vertexOf(SurfacePoint const& point, float2 uv) {
    MaterialVertex vertex{ .position = point.position,
                           .tangents = assets::tangentFrameQuaternion(point.normal, point.tangent, 1, kLeastW),
                           .color = hueOf(uv),
                           .uv0 = uv,
                           .uv1 = 2.0f * float2(uv.y, -uv.x),
                           .custom = {} };
    vertex.custom[0] = float4(uv, glm::length(point.position), 1);
    for (size_t i = 1; i < vertex.custom.size(); ++i) vertex.custom[i] = float4(static_cast<float>(i));
    return vertex;
}

/// columns x rows cells over [0, 1]^2. Seen from outside, u runs to the right and v up; triangles are
/// counter-clockwise.
template <class Point>
void addGrid(MaterialMesh& mesh, uint32_t columns, uint32_t rows, Point const& point) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            const float2 uv(static_cast<float>(column) / static_cast<float>(columns),
                            static_cast<float>(row) / static_cast<float>(rows));
            mesh.vertices.push_back(vertexOf(point(uv.x, uv.y), uv));
        }
    }
    const auto at = [&](uint32_t column, uint32_t row) {
        return static_cast<uint16_t>(first + row * (columns + 1) + column);
    };
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            const uint16_t a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                           d = at(column, row + 1);
            mesh.indices.insert(mesh.indices.end(), { a, b, c, a, c, d });
        }
    }
}

SurfacePoint spherePoint(float u, float v) {
    const float phi = 2 * kPi * u, theta = kPi * (1 - v);
    const float3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
    return { n, n, { std::cos(phi), 0, -std::sin(phi) } };
}

SurfacePoint torusPoint(float u, float v) {
    constexpr float kRadius = 0.66f, kTube = 0.33f;
    const float around = 2 * kPi * u, tube = 2 * kPi * v;
    const float3 out(std::cos(around), std::sin(around), 0);
    const float3 n = out * std::cos(tube) + float3(0, 0, std::sin(tube));
    return { out * kRadius + n * kTube, n, { -std::sin(around), std::cos(around), 0 } };
}

SurfacePoint planePoint(float u, float v) { return { { 2 * u - 1, 2 * v - 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } }; }

/// A sheet rolled up around y, so that both sides are visible.
SurfacePoint scrollPoint(float u, float v) {
    const float angle = 2 * kPi * (1.35f * u - 0.15f), radius = 0.35f + 0.55f * u;
    const float3 out(std::sin(angle), 0, std::cos(angle)), along(std::cos(angle), 0, -std::sin(angle));
    const float3 tangent = along * (radius * 2 * kPi * 1.35f) + out * 0.55f;
    return { out * radius + float3(0, 1.6f * v - 0.8f, 0), glm::cross(tangent, float3(0, 1, 0)), tangent };
}

void addBox(MaterialMesh& mesh, float half) {
    const float3 sides[] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    for (float3 const n : sides) {
        const float3 up = std::abs(n.y) > 0.5f ? float3(0, 0, -n.y) : float3(0, 1, 0);
        const float3 right = glm::cross(up, n);
        addGrid(mesh, 2, 2, [&](float u, float v) {
            return SurfacePoint{ (n + right * (2 * u - 1) + up * (2 * v - 1)) * half, n, right };
        });
    }
}

/// A star in the plane of the image, in which directions differ, and a helix towards the viewer, in which depth does.
LineQuads starAndHelix() {
    std::vector<float3> star, helix;
    constexpr int kRays = 24, kSteps = 48;
    for (int i = 0; i < kRays; ++i) {
        const float angle = 2 * kPi * (static_cast<float>(i) + 0.37f) / kRays;
        const float3 direction(std::cos(angle), std::sin(angle), 0);
        star.insert(star.end(), { direction * 0.15f, direction * 0.6f });
    }
    for (int i = 0; i <= kSteps; ++i) {
        const float t = static_cast<float>(i) / kSteps, angle = 4 * kPi * t;
        helix.emplace_back(0.85f * std::cos(angle), 0.85f * std::sin(angle), 2 * t - 1);
    }
    LineQuads quads = makeLineQuads(star, PrimitiveType::Lines);
    const LineQuads strip = makeLineQuads(helix, PrimitiveType::LineStrip);
    const auto first = static_cast<uint32_t>(quads.vertices.size());
    quads.vertices.insert(quads.vertices.end(), strip.vertices.begin(), strip.vertices.end());
    for (const uint32_t index : strip.indices) quads.indices.push_back(first + index);
    return quads;
}

void addLines(MaterialMesh& mesh, LineQuads const& quads) {
    for (LineVertex const& corner : quads.vertices) {
        const float2 uv = 0.5f + 0.5f * float2(corner.position);
        mesh.vertices.push_back(vertexOf({ corner.position, { 0, 0, 1 }, { 1, 0, 0 } }, uv));
        mesh.vertices.back().custom[0] = corner.otherEnd;
    }
    for (const uint32_t index : quads.indices) mesh.indices.push_back(static_cast<uint16_t>(index));
}

/// A spiral that comes from afar, so that each turn is larger than the one before.
void addPoints(MaterialMesh& mesh) {
    constexpr int kPoints = 240;
    std::vector<double3> points;
    for (int i = 0; i < kPoints; ++i) {
        const double t = (i + 0.5) / kPoints, angle = 2 * kPi * 7 * t, radius = 0.2 + 0.75 * t;
        points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 2 * t - 1);
    }
    for (PointQuads const& quads : makePointQuads(points)) {
        for (PointVertex const& corner : quads.vertices) {
            const float3 place = float3(quads.center) + corner.position;
            mesh.vertices.push_back(vertexOf({ place, { 0, 0, 1 }, { 1, 0, 0 } }, 0.5f + 0.5f * float2(place)));
        }
        const auto* indices = reinterpret_cast<const uint16_t*>(pointIndexBuffer().data.data());
        mesh.indices.assign(indices, indices + quads.indexCount());
    }
}

} // namespace

std::optional<MaterialMesh> makeMaterialMesh(std::string_view name) {
    MaterialMesh mesh;
    if (name == "sphere") {
        addGrid(mesh, 64, 32, spherePoint);
    } else if (name == "torus") {
        addGrid(mesh, 64, 32, torusPoint);
    } else if (name == "plane") {
        addGrid(mesh, 4, 4, planePoint);
    } else if (name == "scroll") {
        addGrid(mesh, 64, 4, scrollPoint);
    } else if (name == "box") {
        addBox(mesh, 0.7f);
    } else if (name == "lines") {
        addLines(mesh, starAndHelix());
    } else if (name == "points") {
        addPoints(mesh);
    } else if (name == "screen") { // row 0 is the top row: y grows downwards
        addGrid(mesh, 1, 1, [](float u, float v) {
            return SurfacePoint{ { 1.2f * u - 0.6f, 0.6f - 1.2f * v, 0.5f }, { 0, 0, 1 }, { 1, 0, 0 } };
        });
    } else if (name == "billboard") {
        addGrid(mesh, 1, 1, [](float u, float v) {
            return SurfacePoint{ { 1.2f * u - 0.6f, 1.2f * v - 0.6f, -3 }, { 0, 0, 1 }, { 1, 0, 0 } };
        });
    } else {
        return std::nullopt;
    }
    return mesh;
}

} // namespace filament_core::tools
