// SPDX-License-Identifier: Apache-2.0
/// loadBoxes: boxes of a scene relative to a camera, for tests of eight at a time (Frustum.h).
#pragma once

#include "base/math/Frustum.h"
#include "filament_core/scene/BoundsColumns.h"

namespace filament_core::prepare {

inline Box8 loadBoxes(scene::BoundsColumns::Four const& low, scene::BoundsColumns::Four const& high,
                      double3 const& cameraWorld) {
    Box8 boxes;
    for (size_t axis = 0; axis < 3; ++axis) {
        const double camera = cameraWorld[static_cast<int>(axis)];
        boxes.center[axis] = { simd::loadRelative4(low.center[axis].data(), camera),
                               simd::loadRelative4(high.center[axis].data(), camera) };
        simd::load(boxes.halfExtent[axis].low, low.halfExtent[axis].data());
        simd::load(boxes.halfExtent[axis].high, high.halfExtent[axis].data());
    }
    return boxes;
}

} // namespace filament_core::prepare
