// SPDX-License-Identifier: Apache-2.0
/// CameraControl: how hands move a camera. Pure functions from camera to camera: no inertia, no state, and what happens
/// does not depend on how often they are called: two steps give what one of both lengths gives, to rounding.
///   Picture   places are clip coordinates as in Camera::viewFromPicture(): (-1, -1) is the upper left corner, and
///             `aspect` is width / height of the view. pictureFromPixel() converts.
///   Distance  along the view, in metres, > 0: of what the hand holds. Ask Renderer::pick(), or take distanceTo().
///   Up        of the world, +Y. Only orbited(), flown(), turned(), framedAlong() and withPlaceOf() change the
///             direction of the view.
///   Lens      perspective and parallel, shifted or not. Exposure stays.
///   Thread    any.   Fails: never, for finite arguments.
#pragma once

#include <filament_core/Box.h>
#include <filament_core/Camera.h>

namespace filament_core::view {

/// The pole is not reached: a view keeps its up. Radians from it.
inline constexpr double kPoleMargin = 1e-3;

double2 pictureFromPixel(double2 pixel, uint2 size); ///< pixel (0, 0) begins at the upper left corner
/// Along the view; at least `leastMeters`.
double distanceTo(Camera const& camera, double3 pointWorld, double leastMeters = 1e-3);
double3 pointAt(Camera const& camera, double2 picture, double distanceMeters, double aspect); ///< in the world

/// Turns around `targetWorld`, which keeps its place in the image: by `yawRadians` about the up of the world
/// (positive: to the right around it) and by `pitchRadians` (positive: upwards), up to the poles. A roll is kept if the
/// camera has one.
Camera orbited(Camera const& camera, double3 targetWorld, double yawRadians, double pitchRadians);
/// Moves across the view: what was at `from` is at `to`.
Camera panned(Camera const& camera, double2 from, double2 to, double distanceMeters, double aspect);
/// What is at `picture` stays there, and looks 1 / `factor` times as large, factor > 0. A perspective camera moves, a
/// parallel one shows less.
Camera zoomed(Camera const& camera, double2 picture, double factor, double distanceMeters, double aspect);

/// Keys that are held. Each is in [-1, 1]; opposite keys cancel out.
struct FlyKeys {
    double right = 0, up = 0, forward = 0; ///< of the camera's own axes
    double turnRight = 0, turnUp = 0;
};
struct FlySpeed {
    double metersPerSecond = 1;
    double turnRadiansPerSecond = 1.5;
};
/// Along a helix if it turns and moves: exactly, not in steps.
Camera flown(Camera const& camera, FlyKeys const& keys, FlySpeed const& speed, double seconds);
/// Turns in place: the view follows the mouse, up to the poles.
Camera turned(Camera const& camera, double rightRadians, double upRadians);

/// Moves back or forth, and across, until the box just fits: it touches two opposite edges of the image, less
/// `margin` of their distance from its middle, [0, 1), or is a hundredth of its diagonal away (long boxes, wide
/// lenses). The planes of the lens move if they would cut the box. An empty box: the same camera.
Camera framed(Camera const& camera, Box const& box, double aspect, double margin = 0.05);
/// As framed(), of the view along an axis: from the front is (0, 0, -1), from above (0, -1, 0), seen with -Z up.
Camera framedAlong(Camera const& camera, double3 directionWorld, Box const& box, double aspect, double margin = 0.05);

/// The other kind of lens, with which what is at this distance has the same size.
Camera asParallel(Camera const& camera, double distanceMeters);
Camera asPerspective(Camera const& camera, double verticalFovDegrees, double distanceMeters);
/// A camera of a file, or a bookmark: where it is and its lens, with the exposure of the current one.
Camera withPlaceOf(Camera const& current, Camera const& other);

} // namespace filament_core::view
