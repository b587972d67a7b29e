// SPDX-License-Identifier: Apache-2.0
/// PictureRays: from pixels to the world and back, and where a ray meets the lines, planes and spheres that hands drag
/// along.
///   Pixels   from the left and the top of the view; (0, 0) is the upper left corner of its first pixel.
///   Limits   what a ray meets is at most kFarthest times as far away as the line or plane is from the eye, or as a
///            parallel image is high. Beyond the vanishing point of a line or the horizon of a plane, where a ray
///            meets nothing, the answer is that limit: no drag jumps to the other side.
///   Thread   any; pure functions.   Fails: never, for finite arguments.
#pragma once

#include <filament_core/Camera.h>

#include <optional>

namespace filament_core::view {

inline constexpr double kFarthest = 100;

/// What is seen, and in how many pixels.
struct PictureView {
    Camera camera{};
    uint2 size{ 1 }; ///< pixels, >= 1
    double aspect() const { return static_cast<double>(size.x) / size.y; }
};

struct PictureRay {
    double3 originWorld{ 0 };
    double3 direction{ 0, 0, -1 }; ///< of length 1
    double heightMeters = 0;       ///< of a parallel image, whose rays have no beginning; 0: from an eye
};

/// From the eye through a pixel; of a parallel lens along the view.
PictureRay rayThrough(PictureView const& view, double2 pixel);
/// Where a point is seen, in the image or outside of it. None: it is not in front of the eye.
std::optional<double2> pixelOf(PictureView const& view, double3 pointWorld);
double depthOf(PictureView const& view, double3 pointWorld); ///< along the view, metres
/// The height of a pixel at the depth of the point.
double metersPerPixel(PictureView const& view, double3 pointWorld);
/// From the point to the eye, of length 1.
double3 towardsEye(PictureView const& view, double3 pointWorld);

/// The place on the line origin + t * axis that is nearest to the ray. `axis` has length 1.
double alongLine(PictureRay const& ray, double3 originWorld, double3 axis);
/// Where the ray meets the plane through the point. `normal` has length 1.
double3 onPlane(PictureRay const& ray, double3 pointWorld, double3 normal);
/// A point of the sphere for every ray: its near side, or its far side. Rays that pass the sphere go to the other side,
/// as far behind the outline as they are beside it, so that a drag reaches all of it.
double3 onSphere(PictureRay const& ray, double3 centerWorld, double radiusMeters, bool isNearSide);

} // namespace filament_core::view
