// SPDX-License-Identifier: Apache-2.0
// makeIcoSphere(): an icosahedron, divided. Kept apart from the other shapes because its texture has a seam that no
// edge follows.
#include "base/Result.h"
#include "base/math/Elementary.h"

#include <filament_core/Primitives.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace filament_core {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr uint32_t kMostSubdivisions = 8; ///< 1.3 million triangles

struct Sphere {
    std::vector<double3> points; ///< of length 1
    std::vector<uint3> triangles;
};

/// Corners: the north pole, five at latitude atan(1/2), five at -atan(1/2) half way between them, the south pole.
Sphere icosahedron() {
    Sphere sphere;
    const double y = 1 / std::sqrt(5.0), radius = 2 / std::sqrt(5.0);
    sphere.points.push_back({ 0, 1, 0 });
    for (uint32_t i = 0; i < 10; ++i) {
        const bool isUpper = i < 5;
        const double angle = kTurn * ((i % 5) / 5.0 + (isUpper ? 0 : 0.1));
        sphere.points.push_back({ radius * elementary::sin(angle), isUpper ? y : -y, radius * elementary::cos(angle) });
    }
    sphere.points.push_back({ 0, -1, 0 });
    for (uint32_t i = 0; i < 5; ++i) {
        const uint32_t next = (i + 1) % 5, upper = 1 + i, upperNext = 1 + next, lower = 6 + i, lowerNext = 6 + next;
        sphere.triangles.insert(sphere.triangles.end(), { { 0, upper, upperNext },
                                                          { upper, lower, upperNext },
                                                          { upperNext, lower, lowerNext },
                                                          { lower, 11, lowerNext } });
    }
    return sphere;
}

Sphere divided(Sphere const& whole) {
    Sphere parts{ .points = whole.points, .triangles = {} };
    parts.triangles.reserve(whole.triangles.size() * 4);
    std::unordered_map<uint64_t, uint32_t> middles;
    middles.reserve(whole.triangles.size() * 3 / 2);
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [known, isNew] =
                middles.try_emplace(uint64_t{ std::min(a, b) } << 32 | std::max(a, b), uint32_t(parts.points.size()));
        if (isNew) parts.points.push_back(glm::normalize(whole.points[a] + whole.points[b]));
        return known->second;
    };
    for (const uint3 t : whole.triangles) {
        const uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
        parts.triangles.insert(parts.triangles.end(),
                               { { t.x, ab, ca }, { ab, t.y, bc }, { ca, bc, t.z }, { ab, bc, ca } });
    }
    return parts;
}

bool isPole(double3 point) { return point.x == 0 && point.z == 0; }

double turnsAt(double3 point) { return 0.5 + elementary::atan2(point.x, point.z) / kTurn; }

MeshVertex vertexAt(double3 point, double u, float radius) {
    const double angle = kTurn * (u - 0.5);
    const double v = 1 - elementary::acos(std::clamp(point.y, -1.0, 1.0)) / std::numbers::pi;
    return { .position = float3(point * double(radius)),
             .normal = float3(point),
             .tangents = tangentsOf(float3(point), float3(double3(elementary::cos(angle), 0, -elementary::sin(angle)))),
             .uv = float2(double2(u, v)) };
}

/// u of the corners of a triangle: continuous across the seam; a pole takes the mean of the others.
std::array<double, 3> turnsOf(Sphere const& sphere, uint3 triangle) {
    std::array<double, 3> u{};
    double least = 1, most = 0;
    for (int c = 0; c < 3; ++c) {
        double3 const& point = sphere.points[triangle[c]];
        if (isPole(point)) continue;
        u[size_t(c)] = turnsAt(point);
        least = std::min(least, u[size_t(c)]), most = std::max(most, u[size_t(c)]);
    }
    const bool crossesSeam = most - least > 0.5;
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        if (isPole(sphere.points[triangle[c]])) continue;
        if (crossesSeam && u[size_t(c)] < 0.5) u[size_t(c)] += 1;
        sum += u[size_t(c)];
    }
    for (int c = 0; c < 3; ++c) {
        if (isPole(sphere.points[triangle[c]])) u[size_t(c)] = sum / 2;
    }
    return u;
}

Mesh textured(Sphere const& sphere, float radius) {
    Mesh mesh;
    mesh.vertices.reserve(sphere.points.size() + sphere.points.size() / 8);
    mesh.indices.reserve(sphere.triangles.size() * 3);
    std::unordered_map<uint64_t, uint32_t> known; // point, and whether it lies beyond the seam
    for (const uint3 triangle : sphere.triangles) {
        const std::array<double, 3> u = turnsOf(sphere, triangle);
        for (int c = 0; c < 3; ++c) {
            double3 const& point = sphere.points[triangle[c]];
            const auto next = static_cast<uint32_t>(mesh.vertices.size());
            uint32_t index = next;
            if (!isPole(point))
                index = known.try_emplace(uint64_t{ triangle[c] } * 2 + (u[size_t(c)] >= 1), next).first->second;
            if (index == next) mesh.vertices.push_back(vertexAt(point, u[size_t(c)], radius));
            mesh.indices.push_back(index);
        }
    }
    return mesh;
}

} // namespace

Result<Mesh> makeIcoSphere(IcoSphereShape const& shape) {
    if (!(shape.radius >= 1e-15f && shape.radius <= 1e15f))
        return fail(ErrorCode::InvalidArgument, "makeIcoSphere: radius is {}, and must be in [1e-15, 1e+15]",
                    shape.radius);
    if (shape.subdivisions > kMostSubdivisions)
        return fail(ErrorCode::InvalidArgument, "makeIcoSphere: subdivisions is {}, and must be in [0, {}]",
                    shape.subdivisions, kMostSubdivisions);
    Sphere sphere = icosahedron();
    for (uint32_t i = 0; i < shape.subdivisions; ++i) sphere = divided(sphere);
    return textured(sphere, shape.radius);
}

} // namespace filament_core
