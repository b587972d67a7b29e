// SPDX-License-Identifier: Apache-2.0
/// LightHandles: handles of lights beside those that move and turn anything: direction, range and cones of spots.
///   Space    a light of the document is in the world; one of a model's file is in the space of its node, whose axes
///            count as Scene counts them: directions turn with it, metres stay metres.
///   Where    a sun has no place: its handles are where the caller says.
///   Limits   cones keep SpotLight's order, inner < outer <= 90 degrees; a range stays above 0. A light without a range
///            has no handle for one.
///   Thread   any; pure functions.   Fails: never, for lights that check() accepts.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/gizmo/GizmoDrag.h"

namespace filament_core::view {

struct GizmoLight {
    LightDesc light = PointLight{};
    double4x4 worldFromLight{ 1.0 };
    bool hasProfile = false;     ///< a point light without one shines alike in every direction
    double3 elsewhereWorld{ 0 }; ///< where the handles of a sun are
};

/// The frame of its handles: -z is its direction, as cameras look, or the axis of a tube.
GizmoFrame frameOf(GizmoLight const& light, GizmoAxes axes);

/// Direction, range and cones, and the lines that show them: to be grabbed before handlesOf().
std::vector<Handle> lightHandles(GizmoLight const& light, GizmoFrame const& frame, PictureView const& view);

/// The light after a drag of any of its handles. Parts that it does not have leave it alone.
LightDesc draggedLight(GizmoDrag const& drag, double2 to, GizmoSteps const& steps, GizmoLight const& light);

} // namespace filament_core::view
