// SPDX-License-Identifier: Apache-2.0
/// GizmoHandles: the handles around a node or a light, as lines and areas of pixels: what is drawn is what can be
/// grabbed.
///   Size     the same on the screen wherever the object is: GizmoFrame::pixels, with every lens.
///   Left out handles that cannot be dragged as they are seen: arrows along the view, planes seen from their edge, and
///            all of them if the object is not in front of the eye.
///   Thread   any; pure functions.   Fails: never.
#pragma once

#include "tools/view/gizmo/PictureRays.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace filament_core::view {

enum class GizmoMode : uint8_t { Off, Move, Rotate, Scale };
enum class GizmoAxes : uint8_t { Local, World };
std::string_view toString(GizmoMode mode); ///< "off", "move", "rotate", "scale"
std::string_view toString(GizmoAxes axes); ///< "own axes", "axes of the world"

enum class GizmoPart : uint8_t {
    None, ///< drawn, but nothing to grab
    AxisX,
    AxisY,
    AxisZ,
    PlaneX, ///< across x: y and z
    PlaneY,
    PlaneZ,
    Screen, ///< across the view; in GizmoMode::Scale all axes alike
    Direction,
    Range,
    OuterCone,
    InnerCone,
};
std::string_view toString(GizmoPart part); ///< "x", "y and z", "direction"
bool isAxis(GizmoPart part);
bool isPlane(GizmoPart part);
int axisOf(GizmoPart part); ///< 0, 1 or 2: of an axis or a plane

inline constexpr double kHandlePixels = 90; ///< at scale 1
inline constexpr double kGrabPixels = 7;    ///< from a line

/// Where the handles are.
struct GizmoFrame {
    double3 originWorld{ 0 };
    double3x3 axes{ 1.0 };         ///< of length 1, at right angles, right-handed
    double pixels = kHandlePixels; ///< from the origin to the end of an arrow
};

/// The axes of a matrix without scale, shear and mirroring; those of the world for one without volume.
double3x3 axesOf(double4x4 const& worldFromNode);
double handleMeters(GizmoFrame const& frame, PictureView const& view); ///< `pixels` at the depth of the origin

struct Handle {
    GizmoPart part = GizmoPart::None;
    std::vector<std::array<double2, 2>> lines{};
    std::vector<double2> area{}; ///< convex; empty: none
};

/// What is grabbed first comes first.
std::vector<Handle> handlesOf(GizmoMode mode, GizmoFrame const& frame, PictureView const& view);
/// The nearest one: inside of an area, or at most kGrabPixels * `scale` beside it or a line. None: nothing is there.
GizmoPart partAt(std::vector<Handle> const& handles, double2 pixel, double scale = 1);

// ---- for other handles

/// The line in front of the eye. Empty: all of it is behind.
void addLine(Handle& handle, PictureView const& view, double3 fromWorld, double3 toWorld);
void addCircle(Handle& handle, PictureView const& view, double3 centerWorld, double3 x,
               double3 y); ///< radii as vectors
/// A square of so many pixels, if the point is in front of the eye.
void addDot(Handle& handle, PictureView const& view, double3 atWorld, double pixels);

} // namespace filament_core::view
