// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace filament_core::bake {
namespace {

constexpr double kReach = 1;      // texels
constexpr double kNoArea = 1e-12; // texels: of triangles that no pixel shows

/// Barycentric weights of the second and third corner of the point of a triangle that is nearest to `p`. Ericson 2005,
/// "Real-Time Collision Detection", section 5.1.5, in a plane.
struct Nearest {
    double u = 0, v = 0, distance = std::numeric_limits<double>::infinity();
};

void takeEdge(std::array<double2, 3> const& corners, size_t i, double2 p, Nearest& nearest) {
    const double2 from = corners[i], edge = corners[(i + 1) % 3] - from;
    const double squared = glm::dot(edge, edge);
    const double t = squared > 0 ? std::clamp(glm::dot(p - from, edge) / squared, 0.0, 1.0) : 0;
    const double distance = glm::distance(p, from + edge * t);
    if (distance >= nearest.distance) return;
    std::array<double, 3> weights{};
    weights[i] = 1 - t, weights[(i + 1) % 3] = t;
    nearest = { weights[1], weights[2], distance };
}

Nearest nearestIn(std::array<double2, 3> const& corners, double2 p) {
    const double area = doubleArea(corners[0], corners[1], corners[2]);
    if (area > 0) {
        const double u = doubleArea(corners[0], p, corners[2]) / area;
        const double v = doubleArea(corners[0], corners[1], p) / area;
        if (u >= 0 && v >= 0 && u + v <= 1) return { u, v, 0 };
    }
    Nearest nearest;
    for (size_t i = 0; i < 3; ++i) takeEdge(corners, i, p, nearest);
    return nearest;
}

struct Entry {
    uint32_t triangle = 0;
    Nearest nearest{};
};

/// The texels of one chart, in the rows and columns of its box.
void addChart(Atlas const& atlas, uint32_t index, std::vector<AtlasTexel>& texels) {
    AtlasChart const& chart = atlas.charts[index];
    std::vector<Entry> entries(size_t(chart.size.x) * chart.size.y);
    const double2 origin(chart.place);
    for (size_t i = 0; i < chart.chart.triangles.size(); ++i) {
        std::array<double2, 3> corners;
        for (size_t k = 0; k < 3; ++k) corners[k] = chart.corner(i * 3 + k, atlas.texelsPerMeter) - origin;
        if (doubleArea(corners[0], corners[1], corners[2]) <= kNoArea) continue;
        const double2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]) - kReach;
        const double2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]) + kReach;
        const auto clamped = [](double value, uint32_t size) {
            return static_cast<uint32_t>(std::clamp(value, 0.0, double(size) - 1));
        };
        for (uint32_t y = clamped(low.y, chart.size.y); y <= clamped(high.y, chart.size.y); ++y) {
            for (uint32_t x = clamped(low.x, chart.size.x); x <= clamped(high.x, chart.size.x); ++x) {
                const Nearest nearest = nearestIn(corners, double2(x, y) + 0.5);
                Entry& entry = entries[size_t(y) * chart.size.x + x];
                if (nearest.distance < entry.nearest.distance) entry = { chart.chart.triangles[i], nearest };
            }
        }
    }
    for (uint32_t y = 0; y < chart.size.y; ++y) {
        for (uint32_t x = 0; x < chart.size.x; ++x) {
            Entry const& entry = entries[size_t(y) * chart.size.x + x];
            if (entry.nearest.distance > kReach) continue;
            texels.push_back({ chart.place.x + x, chart.place.y + y, index, entry.triangle, entry.nearest.u,
                               entry.nearest.v, entry.nearest.distance });
            keepInside(texels.back());
        }
    }
}

} // namespace

std::vector<AtlasTexel> findTexels(Atlas const& atlas) {
    std::vector<AtlasTexel> texels;
    for (uint32_t i = 0; i < atlas.charts.size(); ++i) addChart(atlas, i, texels);
    std::ranges::sort(texels,
                      [](AtlasTexel const& a, AtlasTexel const& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    return texels;
}

void keepInside(AtlasTexel& texel) {
    const std::array weights{ std::max(1 - texel.u - texel.v, kInset), std::max(texel.u, kInset),
                              std::max(texel.v, kInset) };
    const double sum = weights[0] + weights[1] + weights[2];
    texel.u = weights[1] / sum, texel.v = weights[2] / sum;
}

SurfacePoint pointOf(BakeSurface const& surface, AtlasTexel const& texel) {
    const uint32_t* const corners = &surface.indices[size_t(texel.triangle) * 3];
    const double3 a = surface.positions[corners[0]], b = surface.positions[corners[1]],
                  c = surface.positions[corners[2]];
    const double w = 1 - texel.u - texel.v;
    SurfacePoint point{ .position = a * w + b * texel.u + c * texel.v };
    point.longestEdge = std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) });
    const double3 face = glm::cross(b - a, c - a);
    if (const double length = glm::length(face); length > 0) point.faceNormal = face / length;
    point.normal = point.faceNormal;
    if (surface.normals.empty()) return point;
    const double3 smooth = surface.normals[corners[0]] * w + surface.normals[corners[1]] * texel.u +
                           surface.normals[corners[2]] * texel.v;
    const double length = glm::length(smooth);
    if (length > 1e-6 && glm::dot(smooth, point.faceNormal) > 0) point.normal = smooth / length;
    return point;
}

} // namespace filament_core::bake
