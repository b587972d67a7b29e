// SPDX-License-Identifier: Apache-2.0
#include "base/math/Math.h"

#include <filament/Camera.h>

#include <cmath>

namespace filament {

float Exposure::ev100() const { return std::log2(aperture * aperture / shutterSeconds * 100.0f / iso); }

float Exposure::factor() const {
    // 1.2 = 78 / (100 * 0.65): saturation-based sensitivity and a lens that passes 65 %.
    return 1.0f / (1.2f * std::exp2(ev100()));
}

float Exposure::luminance(float ev100) { return std::exp2(ev100 - 3.0f); }

float Exposure::illuminance(float ev100) { return 2.5f * std::exp2(ev100); }

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

float4x4 Camera::clipFromView(float aspect) const {
    // Reversed depth with the far plane at infinity: z_clip = near, w_clip = -z_view. Row 0 of the image is at
    // y_ndc = -1 on both APIs, so +Y of the view maps to -y.
    const float focal = 1.0f / std::tan(glm::radians(lens.verticalFovDegrees) * 0.5f);
    float4x4 clip(0.0f);
    clip[0][0] = focal / aspect;
    clip[1][1] = -focal;
    clip[2][3] = -1.0f;
    clip[3][2] = lens.nearMeters;
    return clip;
}

} // namespace filament
