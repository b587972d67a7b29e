// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/page/ReportCamera.h"

#include "tools/bake/IrradianceProbes.h"
#include "tools/reference/TracedScene.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::bake {
namespace {

constexpr double kInside = 0.85; // of the way from the middle to a corner
constexpr size_t kRays = 16;     // of each place

struct Bounds {
    double3 low{ std::numeric_limits<double>::infinity() }, high{ -std::numeric_limits<double>::infinity() };
    double3 middle() const { return (low + high) * 0.5; }
    double3 half() const { return (high - low) * 0.5; }
};

/// Corners and sides of the box from inside, and all around it from where its sphere fills the image.
std::vector<double3> candidates(Bounds const& bounds, double fovDegrees, double aspect) {
    const double narrow = std::min(1.0, aspect); // of the two fields of view
    const double angle = std::atan(std::tan(glm::radians(fovDegrees) * 0.5) * narrow);
    const double distance = glm::length(bounds.half()) / std::sin(angle);
    std::vector<double3> eyes;
    for (const double x : { -1.0, 0.0, 1.0 }) {
        for (const double z : { -1.0, 0.0, 1.0 }) {
            if (x == 0 && z == 0) continue;
            for (const double y : { 0.1, 0.6 })
                eyes.push_back(bounds.middle() + bounds.half() * double3(x, y, z) * kInside);
            eyes.push_back(bounds.middle() + glm::normalize(double3(x, 0.4, z)) * distance);
        }
    }
    return eyes;
}

double weightSeen(reference::TracedScene const& scene, Camera const& camera, double aspect,
                  std::span<const WeightedPoint> points) {
    const double3 eye = camera.position(), right(camera.worldFromView[0]), up(camera.worldFromView[1]),
                  back(camera.worldFromView[2]);
    const double height = std::tan(glm::radians(double(camera.lens.verticalFovDegrees)) * 0.5);
    double sum = 0;
    for (WeightedPoint const& point : points) {
        const double3 way = point.position - eye;
        const double depth = -glm::dot(way, back);
        const bool isInImage = depth > double(camera.lens.nearMeters) && std::abs(glm::dot(way, up)) < depth * height &&
                               std::abs(glm::dot(way, right)) < depth * height * aspect;
        if (isInImage && glm::dot(way, point.normal) < 0 && !isBlocked(scene, eye, point.position)) sum += point.weight;
    }
    return sum;
}

} // namespace

Camera reportCamera(ReportOptions const& options, Exposure const& exposure, reference::TracedScene const& scene,
                    std::span<const WeightedPoint> points) {
    const double aspect = double(options.size.x) / double(options.size.y);
    const Lens lens{ .verticalFovDegrees = options.fovDegrees };
    Bounds bounds;
    for (WeightedPoint const& point : points)
        bounds.low = glm::min(bounds.low, point.position), bounds.high = glm::max(bounds.high, point.position);
    if (points.empty()) bounds = { double3(-1.0), double3(1.0) };
    const double3 at = options.at.value_or(bounds.middle());
    if (options.eye) return Camera::lookAt(*options.eye, at, lens, exposure);
    Camera best;
    double most = -1;
    for (double3 const& eye : candidates(bounds, double(options.fovDegrees), aspect)) {
        if (glm::length(at - eye) < 1e-9) continue;
        const Camera camera = Camera::lookAt(eye, at, lens, exposure);
        const double seen = weightSeen(scene, camera, aspect, points);
        if (seen > most) most = seen, best = camera;
    }
    return best;
}

std::vector<WeightedPoint> pointsAround(reference::TracedScene const& scene, std::span<const double3> places) {
    std::vector<WeightedPoint> points;
    for (double3 const& place : places) {
        for (size_t i = 0; i < kRays; ++i) { // a spiral from pole to pole
            const double z = 1 - (2 * double(i) + 1) / double(kRays), turn = 2.399963229728653 * double(i);
            const double radius = std::sqrt(1 - z * z);
            const double3 direction(radius * std::cos(turn), radius * std::sin(turn), z);
            const auto hit = scene.nearest({ .origin = place - scene.origin(), .direction = direction });
            if (!hit) continue;
            // Just before the surface, which then hides itself from nobody.
            points.push_back({ place + direction * (hit->distance * 0.999), -direction, 1 });
        }
    }
    return points;
}

} // namespace filament_core::bake
