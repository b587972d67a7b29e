// SPDX-License-Identifier: Apache-2.0
/// Generated places of handles: in front of generated cameras, with any axes.
#pragma once

#include "tests/tools/view/camera/RandomCameras.h"
#include "tools/view/gizmo/GizmoDrag.h"

#include <glm/ext/matrix_transform.hpp>

namespace filament_core::view {

inline constexpr int kRounds = 1500; ///< of each property

inline double3 randomDirection(Draw& draw) {
    for (;;) {
        const double3 point = draw.point(1);
        if (glm::length(point) > 0.1 && glm::length(point) < 1) return glm::normalize(point);
    }
}

inline double3x3 randomTurn(Draw& draw) {
    return double3x3(glm::rotate(double4x4(1.0), draw.number(-3, 3), randomDirection(draw)));
}

/// A place with axes of its own, and without a mirror.
inline double4x4 randomPlace(Draw& draw) {
    double4x4 place = glm::translate(double4x4(1.0), draw.point(5)) * double4x4(randomTurn(draw));
    place = glm::scale(place, double3(draw.logarithmic(0.2, 5), draw.logarithmic(0.2, 5), draw.logarithmic(0.2, 5)));
    return place;
}

struct RandomGizmo {
    PictureView view{};
    GizmoFrame frame{};

    explicit RandomGizmo(Draw& draw) {
        view.camera = draw.rolled();
        view.size = { static_cast<uint32_t>(draw.number(300, 1920)), static_cast<uint32_t>(draw.number(300, 1080)) };
        const double distance = draw.logarithmic(0.2, 50);
        frame.originWorld = pointAt(view.camera, draw.picture() * 0.9, distance, view.aspect());
        frame.axes = randomTurn(draw);
    }
    double length() const { return handleMeters(frame, view); }
    double cosineOfView(double3 axis) const { return std::abs(glm::dot(axis, towardsEye(view, frame.originWorld))); }
    /// A drag from one point of the world to another; none if the eye does not see both.
    std::optional<std::pair<GizmoDrag, double2>> drag(GizmoMode mode, GizmoPart part, double3 from, double3 to) const {
        const auto a = pixelOf(view, from), b = pixelOf(view, to);
        const double least = 0.1 * depthOf(view, frame.originWorld);
        if (!a || !b || depthOf(view, from) < least || depthOf(view, to) < least) return std::nullopt;
        return std::pair{ GizmoDrag{ mode, part, frame, view, *a }, *b };
    }
};

inline double largest(double4x4 const& a, double4x4 const& b) {
    double most = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

} // namespace filament_core::view
