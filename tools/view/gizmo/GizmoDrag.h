// SPDX-License-Identifier: Apache-2.0
/// GizmoDrag: what a drag of a handle makes of an object. A drag is what was grabbed, from where and where the pointer
/// is now: neither the way between the two nor time matters.
///   Move, rotate   what was grabbed stays under the pointer, on its line, plane or ring.
///   Scale          grows with the distance from the origin, in [kLeastScale, kMostScale].
///   Snap           whole steps (GizmoSteps) from where the drag began; of a light's direction, cones and range: whole
///                  steps of the value itself.
///   Thread         any; pure functions.   Fails: never, for finite arguments.
#pragma once

#include "tools/view/gizmo/GizmoHandles.h"

namespace filament_core::view {

inline constexpr double kLeastScale = 0.01, kMostScale = 100;

/// As a drag began.
struct GizmoDrag {
    GizmoMode mode = GizmoMode::Off;
    GizmoPart part = GizmoPart::None;
    GizmoFrame frame{};
    PictureView view{};
    double2 from{ 0 }; ///< pixel
};

struct GizmoSteps {
    double meters = 0, radians = 0, scale = 0; ///< 0: none
};
/// 1, 2 or 5 times a power of ten metres that are at least 8 pixels at the handles; 15 degrees; a tenth.
GizmoSteps stepsOf(GizmoFrame const& frame, PictureView const& view);
double snapped(double value, double step); ///< `step` 0: as it is

/// What happens in the world: a translation, or a rotation about the origin of the frame. One for parts that
/// do neither, such as planes, which have no rotation.
double4x4 worldChange(GizmoDrag const& drag, double2 to, GizmoSteps const& steps = {});
/// Of GizmoMode::Scale, for each axis of the frame.
double3 scaleChange(GizmoDrag const& drag, double2 to, GizmoSteps const& steps = {});

/// The local transform of a node after the drag; none if its parent has no volume.
std::optional<double4x4> draggedNode(GizmoDrag const& drag, double2 to, GizmoSteps const& steps,
                                     double4x4 const& worldFromParent, double4x4 const& parentFromNode);

/// About a point.
double4x4 rotationAbout(double3 pointWorld, double3 axis, double radians);
/// The shortest rotation from one direction of length 1 to another one.
double3x3 shortestRotation(double3 from, double3 to);

} // namespace filament_core::view
