// SPDX-License-Identifier: Apache-2.0
#include "base/Assert.h"
#include "base/math/Elementary.h"
#include "base/math/Math.h"

#include <filament_core/Camera.h>

#include <cmath>

namespace filament_core {

float Exposure::ev100() const { return elementary::log2(aperture * aperture / shutterSeconds * 100.0f / iso); }

float Exposure::factor() const {
    // 1.2 = 78 / (100 * 0.65): saturation-based sensitivity and a lens that passes 65 %.
    return 1.0f / (1.2f * elementary::exp2(ev100()));
}

float Exposure::luminance(float ev100) { return elementary::exp2(ev100 - 3.0f); }

float Exposure::illuminance(float ev100) { return 2.5f * elementary::exp2(ev100); }

Camera Camera::lookAt(double3 eye, double3 at, Lens lens, Exposure exposure, double3 up) {
    double3 back = eye - at;
    const double distance = glm::length(back);
    back = distance > 0 ? back / distance : double3(0, 0, 1);
    double3 right = glm::cross(up, back);
    if (glm::dot(right, right) < 1e-12 * glm::dot(up, up)) {
        const double3 other = std::abs(back.y) < 0.9 ? double3(0, 1, 0) : double3(0, 0, -1);
        right = glm::cross(other, back);
    }
    right = glm::normalize(right);
    const double3 trueUp = glm::cross(back, right);
    Camera camera;
    camera.worldFromView = double4x4(double4(right, 0), double4(trueUp, 0), double4(back, 0), double4(eye, 1));
    camera.lens = lens;
    camera.exposure = exposure;
    return camera;
}

Lens Lens::orthographic(float left, float right, float bottom, float top, float nearMeters, float farMeters) {
    FILAMENT_ASSERT(right > left && top > bottom, "the box of a lens has left < right and bottom < top");
    const float width = right - left, height = top - bottom;
    return { .nearMeters = nearMeters,
             .orthographicHeight = height,
             .farMeters = farMeters,
             .shift = { (left + right) / (2 * width), (bottom + top) / (2 * height) },
             .aspect = width / height };
}

Lens Lens::offCenter(float left, float right, float bottom, float top, float nearMeters) {
    Lens lens = orthographic(left, right, bottom, top, nearMeters);
    lens.verticalFovDegrees = glm::degrees(2 * elementary::atan((top - bottom) / 2));
    lens.orthographicHeight = 0;
    return lens;
}

Lens Lens::fromFocalLength(float millimeters, float sensorHeightMillimeters, float nearMeters) {
    FILAMENT_ASSERT(millimeters > 0 && sensorHeightMillimeters > 0, "a lens has a focal length > 0 and a sensor > 0");
    return { .verticalFovDegrees = glm::degrees(2 * elementary::atan(sensorHeightMillimeters / (2 * millimeters))),
             .nearMeters = nearMeters };
}

namespace {

void checkLens(Lens const& lens) {
    const bool isLens = lens.isOrthographic()
                                ? lens.nearMeters >= 0 && lens.farMeters > lens.nearMeters
                                : lens.nearMeters > 0 && lens.verticalFovDegrees > 0 && lens.verticalFovDegrees < 180;
    FILAMENT_ASSERT(isLens, "a lens has a near plane > 0 and a field of view in (0, 180), or is parallel with "
                            "0 <= nearMeters < farMeters");
    FILAMENT_ASSERT(std::isfinite(lens.shift.x) && std::isfinite(lens.shift.y) && lens.aspect >= 0 &&
                            std::isfinite(lens.aspect),
                    "the shift and the aspect of a lens are finite, and the aspect is not negative");
}

} // namespace

float4x4 Camera::clipFromView(float aspect) const {
    checkLens(lens);
    // Reversed depth. Perspective, with the far plane at infinity: z_clip = near, w_clip = -z_view. Parallel: z_clip
    // from 1 to 0, w_clip = 1. Row 0 of the image is at y_ndc = -1 on both APIs, so +Y of the view maps to -y. The
    // shift moves by whole images, which are 2 wide: over w, so in the column of what w is made of.
    const float shown = lens.aspect > 0 ? lens.aspect : aspect;
    const float focal = lens.isOrthographic() ? 2.0f / lens.orthographicHeight
                                              : 1.0f / elementary::tan(glm::radians(lens.verticalFovDegrees) * 0.5f);
    float4x4 clip(0.0f);
    clip[0][0] = focal / shown;
    clip[1][1] = -focal;
    if (lens.isOrthographic()) {
        const float depth = lens.farMeters - lens.nearMeters;
        clip[2][2] = 1.0f / depth;
        clip[3] = float4(0 - 2 * lens.shift.x, 2 * lens.shift.y, lens.farMeters / depth, 1); // 0 -: no -0
    } else {
        clip[2] = float4(2 * lens.shift.x, 0 - 2 * lens.shift.y, 0, -1);
        clip[3][2] = lens.nearMeters;
    }
    return clip;
}

double3 Camera::viewFromPicture(double2 clip, double distanceMeters, double aspect) const {
    const double shown = lens.aspect > 0 ? static_cast<double>(lens.aspect) : aspect;
    const double half =
            lens.isOrthographic()
                    ? static_cast<double>(lens.orthographicHeight) / 2
                    : elementary::tan(glm::radians(static_cast<double>(lens.verticalFovDegrees)) / 2) * distanceMeters;
    const double2 at = double2(clip.x, -clip.y) + 2.0 * double2(lens.shift);
    return { at.x * half * shown, at.y * half, -distanceMeters };
}

} // namespace filament_core
