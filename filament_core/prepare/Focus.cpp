// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/Focus.h"

#include "base/math/Elementary.h"
#include "filament_core/prepare/ReduceRanges.h"

#include <algorithm>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr double kSensorMeters = 0.024;

} // namespace

Focus focusOf(Camera const& camera, DepthOfField const& depthOfField, uint32_t height) {
    if (camera.lens.isOrthographic()) return {}; // no point of it lies before the others: nothing is out of focus
    const double halfFov = glm::radians(static_cast<double>(camera.lens.verticalFovDegrees)) / 2;
    const double focal = kSensorMeters / (2 * elementary::tan(halfFov));
    const double focus = std::max(static_cast<double>(depthOfField.focusMeters), 1.01 * focal);
    const double aperture = focal / static_cast<double>(camera.exposure.aperture); // diameter
    const double atInfinity = aperture * focal / (focus - focal) / kSensorMeters / 2;
    const double pixels = atInfinity * height * static_cast<double>(depthOfField.blurScale);
    return { .radius = static_cast<float>(pixels),
             .radiusTimesFocus = static_cast<float>(pixels * focus),
             .mostPixels = depthOfField.maxRadius * static_cast<float>(height) };
}

double blurRadius(Focus const& focus, double distance) {
    const double radius = static_cast<double>(focus.radius) - static_cast<double>(focus.radiusTimesFocus) / distance;
    const auto most = static_cast<double>(focus.mostPixels);
    return std::clamp(radius, -most, most);
}

VisibleDistances visibleDistances(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                                  ViewPacket const& view, ViewSpace const& space) {
    constexpr double kNearest = 1e-6;
    scene::BoundsColumns const& bounds = scene.renderables.bounds;
    const double3 forward(space.forward);
    return reduceRanges<VisibleDistances>(
            jobs, arena, view.objects.size(),
            [&](VisibleDistances& part, size_t i) {
                const uint32_t at = view.objects.order[i].renderable;
                const double depth = glm::dot(bounds.centerAt(at) - space.cameraWorld, forward);
                const double reach = glm::dot(glm::abs(forward), double3(bounds.halfExtentAt(at)));
                const bool isKnown = std::isfinite(depth + reach);
                part.nearest = std::min(part.nearest, isKnown ? std::max(depth - reach, kNearest) : kNearest);
                part.farthest = std::max(part.farthest, isKnown ? std::max(depth + reach, kNearest) : HUGE_VAL);
            },
            [](VisibleDistances& whole, VisibleDistances const& part) {
                whole.nearest = std::min(whole.nearest, part.nearest);
                whole.farthest = std::max(whole.farthest, part.farthest);
            });
}

} // namespace filament_core::prepare
