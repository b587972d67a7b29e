// SPDX-License-Identifier: Apache-2.0
/// NodePose: a transform in the form that animations use (glTF 2.0, section 3.5.3): scale, then rotation, then
/// translation.
///   Thread  any. Fails: never; a rotation of zero length counts as none.
#pragma once

#include "base/math/Math.h"

namespace filament_core::assets {

struct NodePose {
    double3 translation{ 0.0 };
    double4 rotation{ 0, 0, 0, 1 }; ///< quaternion x, y, z, w; any length but 0
    double3 scale{ 1.0 };
};

double4x4 matrixFrom(NodePose const& pose);

/// The pose whose matrix is nearest to an affine matrix: exact unless it shears. A mirror becomes a negative x scale.
NodePose poseFrom(double4x4 const& matrix);

/// From `a` (weight 0) to `b` (weight 1): rotations follow the shorter arc at constant speed.
NodePose blend(NodePose const& a, NodePose const& b, double weight);

/// Spherical interpolation of (nearly) unit quaternions x, y, z, w; exactly `a` at 0 and `b` or -b at 1.
double4 slerp(double4 const& a, double4 const& b, double weight);

} // namespace filament_core::assets
