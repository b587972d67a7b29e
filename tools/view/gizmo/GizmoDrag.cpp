// SPDX-License-Identifier: Apache-2.0
#include "tools/view/gizmo/GizmoDrag.h"

#include "toolkit/program/RoundStep.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr double kLeastStepPixels = 8;
constexpr double kEdgeOn =
        0.2; // cosine between the view and the axis of a ring: below, it is dragged along its tangent
constexpr double kPixelsPerDoubling = 100;
constexpr double kLeastArm = 0.05; // of the handles' length: scale is relative to where it was grabbed

double3 translationOf(GizmoDrag const& drag, double2 to, GizmoSteps const& steps) {
    const PictureRay before = rayThrough(drag.view, drag.from), after = rayThrough(drag.view, to);
    double3 const& origin = drag.frame.originWorld;
    double3x3 const& axes = drag.frame.axes;
    if (isAxis(drag.part)) {
        const double3 axis = axes[axisOf(drag.part)];
        return axis * snapped(alongLine(after, origin, axis) - alongLine(before, origin, axis), steps.meters);
    }
    const bool isScreen = drag.part == GizmoPart::Screen;
    const double3x3 frame = isScreen ? double3x3(drag.view.camera.worldFromView) : axes;
    const int normal = isScreen ? 2 : axisOf(drag.part);
    const double3 moved = onPlane(after, origin, frame[normal]) - onPlane(before, origin, frame[normal]);
    double3 result(0);
    for (int i = 0; i < 3; ++i)
        if (i != normal) result += frame[i] * snapped(glm::dot(moved, frame[i]), steps.meters);
    return result;
}

/// Seen from its edge, a ring is a line: along it.
double angleAlongTangent(GizmoDrag const& drag, double2 to, double3 axis) {
    double3 const& origin = drag.frame.originWorld;
    const double radius = handleMeters(drag.frame, drag.view);
    const double3 eye = towardsEye(drag.view, origin);
    const double3 tangent = glm::normalize(glm::cross(axis, eye));
    const double3 front = origin + glm::cross(tangent, axis) * radius;
    const double moved = alongLine(rayThrough(drag.view, to), front, tangent) -
                         alongLine(rayThrough(drag.view, drag.from), front, tangent);
    return moved / radius;
}

double angleInPlane(GizmoDrag const& drag, double2 to, double3 axis) {
    double3 const& origin = drag.frame.originWorld;
    const double3 a = onPlane(rayThrough(drag.view, drag.from), origin, axis) - origin;
    const double3 b = onPlane(rayThrough(drag.view, to), origin, axis) - origin;
    return std::atan2(glm::dot(axis, glm::cross(a, b)), glm::dot(a, b));
}

double4x4 rotationOf(GizmoDrag const& drag, double2 to, GizmoSteps const& steps) {
    double3 const& origin = drag.frame.originWorld;
    const double3 eye = towardsEye(drag.view, origin);
    const double3 axis = isAxis(drag.part) ? drag.frame.axes[axisOf(drag.part)] : eye;
    const bool isEdgeOn = std::abs(glm::dot(axis, eye)) < kEdgeOn;
    const double angle = isEdgeOn ? angleAlongTangent(drag, to, axis) : angleInPlane(drag, to, axis);
    return rotationAbout(origin, axis, snapped(angle, steps.radians));
}

/// How far a ray is from the origin of the frame, along one or two axes.
double armOf(GizmoDrag const& drag, double2 pixel) {
    const PictureRay ray = rayThrough(drag.view, pixel);
    double3 const& origin = drag.frame.originWorld;
    const int axis = axisOf(drag.part);
    if (isAxis(drag.part)) return alongLine(ray, origin, drag.frame.axes[axis]);
    const double3 diagonal = glm::normalize(drag.frame.axes[(axis + 1) % 3] + drag.frame.axes[(axis + 2) % 3]);
    return glm::dot(onPlane(ray, origin, drag.frame.axes[axis]) - origin, diagonal);
}

double factorOf(GizmoDrag const& drag, double2 to) {
    if (drag.part == GizmoPart::Screen) {
        const double2 moved = to - drag.from;
        return std::exp2((moved.x - moved.y) / kPixelsPerDoubling);
    }
    return armOf(drag, to) / std::max(armOf(drag, drag.from), kLeastArm * handleMeters(drag.frame, drag.view));
}

bool isMovable(GizmoPart part) { return isAxis(part) || isPlane(part) || part == GizmoPart::Screen; }
bool isRing(GizmoPart part) { return isAxis(part) || part == GizmoPart::Screen; }

} // namespace

GizmoSteps stepsOf(GizmoFrame const& frame, PictureView const& view) {
    const double least = kLeastStepPixels * metersPerPixel(view, frame.originWorld);
    return { .meters = roundStep(least), .radians = glm::radians(15.0), .scale = 0.1 };
}

double snapped(double value, double step) { return step > 0 ? std::round(value / step) * step : value; }

double4x4 worldChange(GizmoDrag const& drag, double2 to, GizmoSteps const& steps) {
    if (drag.mode == GizmoMode::Move && isMovable(drag.part))
        return glm::translate(double4x4(1.0), translationOf(drag, to, steps));
    if (drag.mode == GizmoMode::Rotate && isRing(drag.part)) return rotationOf(drag, to, steps);
    return double4x4(1.0);
}

double3 scaleChange(GizmoDrag const& drag, double2 to, GizmoSteps const& steps) {
    if (drag.mode != GizmoMode::Scale || !isMovable(drag.part)) return double3(1);
    const double factor =
            std::clamp(snapped(factorOf(drag, to), steps.scale), std::max(kLeastScale, steps.scale), kMostScale);
    double3 scale(factor);
    for (int i = 0; i < 3; ++i) {
        const bool isKept =
                (isAxis(drag.part) && i != axisOf(drag.part)) || (isPlane(drag.part) && i == axisOf(drag.part));
        if (isKept) scale[i] = 1;
    }
    return scale;
}

std::optional<double4x4> draggedNode(GizmoDrag const& drag, double2 to, GizmoSteps const& steps,
                                     double4x4 const& worldFromParent, double4x4 const& parentFromNode) {
    if (drag.mode == GizmoMode::Scale)
        return glm::scale(parentFromNode, scaleChange(drag, to, steps)); // along its own axes, whatever their angles
    if (!(std::abs(glm::determinant(double3x3(worldFromParent))) > 0)) return std::nullopt;
    double4x4 result = glm::inverse(worldFromParent) * worldChange(drag, to, steps) * worldFromParent * parentFromNode;
    for (int i = 0; i < 4; ++i) result[i].w = i == 3 ? 1 : 0; // exactly
    return result;
}

double4x4 rotationAbout(double3 pointWorld, double3 axis, double radians) {
    double4x4 result = glm::rotate(glm::translate(double4x4(1.0), pointWorld), radians, axis);
    result = glm::translate(result, -pointWorld);
    return result;
}

double3x3 shortestRotation(double3 from, double3 to) {
    const double cosine = glm::dot(from, to);
    if (cosine < -1 + 1e-12) { // any axis across
        const double3 helper = std::abs(from.x) < 0.7 ? double3(1, 0, 0) : double3(0, 1, 0);
        const double3 axis = glm::normalize(glm::cross(from, helper));
        return double3x3(glm::rotate(double4x4(1.0), glm::radians(180.0), axis));
    }
    // The half-way quaternion, normalised.
    const double3 axis = glm::cross(from, to);
    return glm::mat3_cast(glm::normalize(glm::dquat(1 + cosine, axis.x, axis.y, axis.z)));
}

} // namespace filament_core::view
