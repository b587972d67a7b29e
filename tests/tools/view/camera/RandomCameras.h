// SPDX-License-Identifier: Apache-2.0
/// Generated cameras: every direction but the poles, both kinds of lens, shifted or not.
#pragma once

#include "tools/view/camera/CameraControl.h"

#include <glm/ext/matrix_transform.hpp>

#include <random>

namespace filament_core::view {

class Draw {
public:
    explicit Draw(unsigned seed) : mRandom(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(mRandom); }
    double logarithmic(double low, double high) { return std::exp(number(std::log(low), std::log(high))); }
    double3 point(double size) { return { number(-size, size), number(-size, size), number(-size, size) }; }
    double2 picture() { return { number(-1, 1), number(-1, 1) }; }
    double aspect() { return logarithmic(0.2, 5); }
    bool coin() { return number(0, 1) < 0.5; }
    Lens lens() {
        Lens lens{ .verticalFovDegrees = static_cast<float>(number(5, 120)),
                   .nearMeters = static_cast<float>(logarithmic(1e-3, 0.1)) };
        if (coin()) lens.shift = { static_cast<float>(number(-0.4, 0.4)), static_cast<float>(number(-0.4, 0.4)) };
        if (coin()) lens.orthographicHeight = static_cast<float>(logarithmic(0.01, 100));
        return lens;
    }
    /// Without a roll.
    Camera camera() {
        const double heading = number(-3.1, 3.1), elevation = number(-1.5, 1.5);
        Camera camera{ .worldFromView = glm::translate(double4x4(1.0), point(20)), .lens = lens() };
        camera.worldFromView = glm::rotate(camera.worldFromView, heading, double3(0, 1, 0));
        camera.worldFromView = glm::rotate(camera.worldFromView, elevation, double3(1, 0, 0));
        camera.exposure = { .aperture = static_cast<float>(logarithmic(1, 16)), .iso = 200 };
        return camera;
    }
    Camera rolled() {
        Camera camera = this->camera();
        camera.worldFromView = glm::rotate(camera.worldFromView, number(-1.5, 1.5), double3(0, 0, 1));
        return camera;
    }

private:
    std::mt19937 mRandom;
};

/// The clip coordinates of a point; in front of the camera.
inline double2 pictureOf(Camera const& camera, double3 pointWorld, double aspect) {
    const double3 view(glm::inverse(camera.worldFromView) * double4(pointWorld, 1));
    const double3 low = camera.viewFromPicture({ -1, 1 }, -view.z, aspect);
    const double3 high = camera.viewFromPicture({ 1, -1 }, -view.z, aspect);
    return { (view.x - low.x) / (high.x - low.x) * 2 - 1, 1 - (view.y - low.y) / (high.y - low.y) * 2 };
}

/// How far two cameras are apart: the largest difference of their matrices.
inline double apart(Camera const& a, Camera const& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a.worldFromView[c][r] - b.worldFromView[c][r]));
    }
    return most;
}

inline double turnError(Camera const& camera) {
    const glm::dmat3 turn(camera.worldFromView), off = glm::transpose(turn) * turn - glm::dmat3(1.0);
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(off[c][r]));
    }
    return most;
}

} // namespace filament_core::view
